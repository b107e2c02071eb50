#pragma once

#include <string>
#include <vector>

#include "mesh/surface_mesh.hpp"
#include "scene/document.hpp"

namespace elastolab {

/// Vertices of `mesh` that a selector names, each once: a vertex selector in its own order, the others ascending, a
/// list in the order of its members.
/// Throws SceneError, beginning with `where` ("scene.json: /fixed") and the place inside the selector, when a vertex
/// number is out of range or listed twice, or when the selector or a member of it selects nothing.
std::vector<int> select_vertices(const SurfaceMesh& mesh, const Selector& selector, const std::string& where);

}  // namespace elastolab
