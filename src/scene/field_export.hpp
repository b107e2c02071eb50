#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "deform/deformer.hpp"
#include "mesh/output/field_files.hpp"
#include "mesh/output/mesh_field.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// A solution whose fields are known at every vertex: what is written to files.
struct SolvedBody {
    std::shared_ptr<const SurfaceMesh> shown;  ///< that of the scene; results are at its vertices
    std::shared_ptr<const Proxy> proxy;        ///< what was simulated in its place; null: shown itself
    std::shared_ptr<const Deformer> deformer;  ///< of the simulated surface
    Eigen::VectorXd values;                    ///< prescribed there
    Eigen::VectorXd displacement;              ///< of the shown vertices, 3*n [L]
    Eigen::VectorXd simulated_displacement;    ///< of the vertices of the model's surface, 3*n [L]
    std::vector<int> constrained;              ///< vertices of the model's surface
    Eigen::Matrix3Xd forces;                   ///< reactions at these, 3 x n [force]
};

/// At the shown vertices: displacement [L], traction, stress (six components) and von Mises stress [force / L^2], as
/// deform/surface_stress.hpp has them.
std::vector<MeshField> surface_fields(const SolvedBody& solved);

/// Its stress alone, 6*n of the shown vertices (StressNumbers, deform/surface_stress.hpp).
Eigen::VectorXd stress_of(const SolvedBody& solved);

/// Columns of values at a proxy's vertices, carried to the shown ones as displacements are.
Eigen::MatrixXd carried_columns(const Proxy& proxy, const Eigen::MatrixXd& columns);

/// The endings of files of fields: a surface with them (.ply, .vtp), a body with its inside (.vtu), or a table of the
/// vertices at rest (.csv). Small letters.
const std::vector<std::string>& field_endings();
bool is_field_file(const std::filesystem::path& file);

/// Writes a file of fields, by the ending of `name`. PLY: the moved surface. VTK's files (.vtp, .vtu): the body at rest
/// with `displacement` as the active vector, or where `points` ask for it moved. .vtu: of the simulated body, linear or
/// ten-node tetrahedra with displacement, stress and von Mises stress at the nodes, and the stresses in the middle of
/// each element. Throws Error where the method has no inside, or for another ending; Cancelled.
void write_field_file(std::ostream& out, const std::filesystem::path& name, const SolvedBody& solved, Control& control,
                      VtkPoints points = VtkPoints::at_rest);

/// The same to a file, which is replaced once the new one is complete. Throws Error.
void save_field_file(const std::filesystem::path& file, const SolvedBody& solved, Control& control,
                     VtkPoints points = VtkPoints::at_rest);

}  // namespace elastolab
