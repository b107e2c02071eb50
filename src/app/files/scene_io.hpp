#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/control.hpp"
#include "scene/live/live_scene.hpp"

namespace elastolab {

/// What somebody asks for at the start, instead of what the scene says.
struct AskedFor {
    std::optional<MethodKind> method = {};
    std::optional<Field> field = {};   ///< that colours the body
    std::optional<int> cut_axis = {};  ///< 0, 1 or 2: cut open through its middle across this axis
};

/// A scene as it comes from a file.
struct LoadedScene {
    std::unique_ptr<LiveScene> scene;
    Eigen::Vector3d up_axis = Eigen::Vector3d::UnitZ();  ///< its axis that points up
    std::filesystem::path file;                          ///< the file it can be saved over; empty for a bare mesh
    std::string note = {};                               ///< for the user: why it begins with another method than usual
    bool recovered = false;                              ///< from a viewer that was killed: its changes are unsaved
    AskedFor asked = {};
};

/// Reads a scene file (.json), or a mesh, whose lowest part is held. The time grows with the mesh. Throws
/// SceneError, MeshError, Cancelled.
LoadedScene load_scene_or_mesh(const std::filesystem::path& file, Control& control);

/// Reads a scene that was kept for a viewer which did not end as it should; `origin`: the file that it belongs to.
LoadedScene load_autosaved(const std::filesystem::path& file, const std::filesystem::path& origin, Control& control);

/// The scene as it is to be kept, with this method and seen like that, whatever folder it is read from: the name of its
/// mesh is absolute.
Document movable_document(const LiveScene& scene, MethodKind method, const ViewPoint& camera, const Shown& shown);

/// Writes a movable_document() in such a way that it finds its mesh. Throws Error.
void write_scene(const std::filesystem::path& file, Document document);

/// The scene that the viewer begins with: the paper's cube of about 1000 vertices, its left face fixed.
Document default_document();
/// A bare mesh as a scene in which nothing is held.
Document document_for_mesh(const std::filesystem::path& mesh);

}  // namespace elastolab
