#pragma once

#include <filesystem>
#include <string>

#include "deform/model.hpp"
#include "mesh/checks/check.hpp"
#include "scene/document.hpp"

namespace elastolab {

/// The mesh of a scene, checked and repaired but not judged, and what to call it in messages.
struct SceneMesh {
    std::string name;
    CheckedMesh checked;
};

/// Loads a mesh file, relative names starting at the folder of `scene_file`, or makes a primitive.
/// Throws MeshError (a file that cannot be read), SceneError (a primitive that cannot be made), Cancelled.
SceneMesh load_scene_mesh(const MeshSource& source, const std::filesystem::path& scene_file, Control& control);

/// Whether a method of `kind` simulates a closed surface around this mesh (scene/proxy/proxy.hpp), not the mesh itself.
bool needs_proxy(const ProxyChoice& choice, const MeshReport& mesh, MethodKind kind);

/// Throws MeshError when a mesh is not usable for a method of `kind`.
void require_usable(const SceneMesh& mesh, MethodKind kind);
/// Throws SceneError when the material is not.
void require_material(const Material& material, MethodKind kind, const std::filesystem::path& scene_file);

}  // namespace elastolab
