#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "mesh/output/field_files.hpp"
#include "scene/solve.hpp"

namespace elastolab {

/// Where solve writes; an empty path is an output that is not wanted.
struct OutputPaths {
    std::filesystem::path displacements, fields, mesh, forces, report, figure;
    std::filesystem::path matrices;              ///< a folder, made when it is missing
    VtkPoints mesh_points = VtkPoints::at_rest;  ///< of `mesh`, where that is one of VTK's files

    bool any() const;
};

/// Refuses what can be known to fail before anything is computed. `inputs` are files that must not be overwritten.
/// Throws UsageError (the same file twice, an input, an unknown extension) or Error (a place that cannot be written).
void require_writable(const OutputPaths& paths, const std::vector<std::filesystem::path>& inputs);

/// Throws UsageError when two outputs are the same file, or one is an input. Empty paths are none.
void require_distinct(const std::vector<std::filesystem::path>& outputs,
                      const std::vector<std::filesystem::path>& inputs);

/// What a scene is read from: its file, and that of its mesh where it has one.
std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& scene_file, const MeshSource& mesh);

/// Throws UsageError when meshes are not written under this extension.
void require_mesh_extension(const std::filesystem::path& mesh);

/// Throws UsageError when this is a file of tetrahedra (.vtu) and the method has none.
void require_inside(MethodKind method, const std::filesystem::path& mesh);

/// Throws UsageError where a figure is among the outputs (.html, .glb) that cannot be made (figure_refusal).
void require_figure(MethodKind method, const Document& scene, const OutputPaths& paths);

/// Writes all outputs, then puts them in their places together: when one fails, none is there. Solves for what figures
/// and fields need besides. Throws Error, Cancelled.
void write_outputs(const OutputPaths& paths, const Solution& solution, Control& control);

}  // namespace elastolab
