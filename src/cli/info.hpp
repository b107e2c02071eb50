#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "scene/setup.hpp"

namespace elastolab {

/// What one method in one mode would cost on a mesh; nothing when the mesh is not usable for it.
struct MethodCost {
    Method method;
    std::optional<Cost> cost;
};

/// What can be said about a mesh before anything is computed on it.
struct MeshInfo {
    SceneMesh mesh;
    std::vector<MethodCost> costs;  ///< every method in every mode that it has
};

MeshInfo inspect(SceneMesh mesh);

/// A table for people.
void print_info(std::ostream& out, const MeshInfo& info);
/// The same as JSON. A number that is not finite becomes null.
void write_info(std::ostream& out, const MeshInfo& info);

}  // namespace elastolab
