#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>

#include "scene/live/live_scene.hpp"

namespace elastolab {

/// A scene as it comes from a file.
struct LoadedScene {
    std::unique_ptr<LiveScene> scene;
    Eigen::Vector3d up_axis = Eigen::Vector3d::UnitZ();  ///< which axis it has upward
    std::filesystem::path file;                          ///< that it can be saved over; empty for a bare mesh
};

/// Reads a scene file (.json), or a mesh, whose lowest part is held. Takes as long as the mesh is large. Throws
/// SceneError, MeshError, Cancelled.
LoadedScene load_scene_or_mesh(const std::filesystem::path& file, Control& control);

/// Writes the scene, with this method and seen from there, in such a way that it finds its mesh. Throws Error.
void write_scene(const std::filesystem::path& file, const LiveScene& scene, MethodKind method, const ViewPoint& camera);

/// Writes the mesh of the scene, moved by `displacement` (3*n_vertices [L]; empty: at rest). Throws Error.
void write_deformed_mesh(const std::filesystem::path& file, const LiveScene& scene,
                         const Eigen::VectorXd& displacement);

/// The scene that the viewer begins with: the paper's cube of about 1000 vertices, its left face fixed.
Document default_document();
/// A bare mesh as a scene in which nothing is held.
Document document_for_mesh(const std::filesystem::path& mesh);

}  // namespace elastolab
