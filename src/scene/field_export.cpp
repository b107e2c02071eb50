#include "scene/field_export.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/LU>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "deform/surface_stress.hpp"
#include "deform/volume.hpp"
#include "elasticity/neo_hookean.hpp"
#include "elasticity/stress.hpp"
#include "mesh/output/field_files.hpp"
#include "scene/proxy/carried_constraints.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

using DisplacementColumns = Eigen::Map<const Eigen::Matrix3Xd>;

DisplacementColumns as_columns(const Eigen::VectorXd& u) { return {u.data(), 3, u.size() / 3}; }

/// Rows of values at the model's vertices, carried to the shown ones.
Eigen::MatrixXd as_shown(const SolvedBody& solved, const Eigen::MatrixXd& rows) {
    if (!solved.proxy) return rows;
    Eigen::MatrixXd shown(rows.rows(), solved.shown->n_vertices());
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        shown.row(i) = carried_values(*solved.proxy, rows.row(i).transpose()).transpose();
    return shown;
}

SurfaceMesh moved_surface(const SolvedBody& solved) {
    SurfaceMesh mesh = *solved.shown;
    mesh.vertices += as_columns(solved.displacement);
    return mesh;
}

Eigen::Matrix3d corner_differences(const Eigen::Ref<const Eigen::Matrix3Xd>& at, const Eigen::Vector4i& corners) {
    Eigen::Matrix3d differences;
    for (int i = 0; i < 3; ++i) differences.col(i) = at.col(corners[i + 1]) - at.col(corners[0]);
    return differences;
}

std::vector<MeshField> cell_stresses(const TetMesh& rest, const Eigen::Ref<const Eigen::Matrix3Xd>& u,
                                     const Material& material, bool large) {
    Eigen::MatrixXd stress(6, rest.n_tetrahedra()), size(1, rest.n_tetrahedra());
    for (Eigen::Index t = 0; t < rest.tetrahedra.cols(); ++t) {
        const Eigen::Vector4i corners = rest.tetrahedra.col(t);
        const Eigen::Matrix3d gradient =
            corner_differences(u, corners) * corner_differences(rest.vertices, corners).inverse();
        stress.col(t) = stress_of(gradient, material, large);
        size(0, t) = measure(StressMeasure::von_mises, stress_tensor(stress.col(t)));
    }
    return {{"stress", std::move(stress)}, {"von_mises", std::move(size)}};
}

void write_inside(std::ostream& out, const fs::path& name, const SolvedBody& solved, Control& control) {
    const std::shared_ptr<const Volume> volume = Volume::of(solved.model, control);
    if (!volume)
        throw Error(one_line(name.string()) + ": " + std::string(elastolab::name(solved.model->method().kind)) +
                    " has no tetrahedra inside. Choose .vtp, or a finite-element method.");
    const Eigen::VectorXd u = volume->displace(solved.simulated_displacement);
    const std::vector<MeshField> cells = cell_stresses(volume->mesh(), as_columns(u), solved.model->body().material,
                                                       !solved.model->method().kind->linear);
    TetMesh moved = volume->mesh();
    moved.vertices += as_columns(u);
    const std::vector<MeshField> points = {{"displacement", as_columns(u)}};
    write_vtu(out, moved, points, cells);
}

}  // namespace

const std::vector<std::string>& field_endings() {
    static const std::vector<std::string> endings = {".ply", ".vtp", ".vtu", ".csv"};
    return endings;
}

bool is_field_file(const fs::path& file) {
    return std::find(field_endings().begin(), field_endings().end(), lower_case(file.extension().string())) !=
           field_endings().end();
}

std::vector<MeshField> surface_fields(const SolvedBody& solved) {
    const Body& body = solved.model->body();
    const Eigen::Matrix3Xd tractions = vertex_tractions(*body.surface, solved.constrained, solved.forces);
    const Eigen::VectorXd& u = solved.simulated_displacement;
    const bool large = !solved.model->method().kind->linear;
    const Eigen::VectorXd size =
        surface_stress_measure(StressMeasure::von_mises, *body.surface, body.material, u, tractions, large);
    return {{"displacement", as_columns(solved.displacement)},
            {"von_mises", as_shown(solved, size.transpose())},
            {"traction", as_shown(solved, tractions)},
            {"stress", as_shown(solved, surface_stress(*body.surface, body.material, u, tractions, large))}};
}

void write_field_file(std::ostream& out, const fs::path& name, const SolvedBody& solved, Control& control) {
    const std::string ending = lower_case(name.extension().string());
    if (ending == ".vtu") return write_inside(out, name, solved, control);
    if (!is_field_file(name))
        throw Error(one_line(name.string()) + ": fields are written as .ply, .vtp, .vtu or .csv. Choose one of these.");
    const std::vector<MeshField> fields = surface_fields(solved);
    control.checkpoint();
    if (ending == ".csv") return write_field_csv(out, solved.shown->vertices, fields);
    if (ending == ".vtp") return write_vtp(out, moved_surface(solved), fields);
    write_ply(out, moved_surface(solved), fields);
}

void save_field_file(const fs::path& file, const SolvedBody& solved, Control& control) {
    AtomicFile output(file);
    write_field_file(output.stream(), file, solved, control);
    output.commit();
}

}  // namespace elastolab
