#include "scene/field_export.hpp"

#include <algorithm>
#include <utility>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "deform/interior_field.hpp"
#include "deform/surface_stress.hpp"
#include "deform/volume.hpp"
#include "elasticity/stress.hpp"
#include "mesh/output/field_files.hpp"
#include "scene/proxy/carried_constraints.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

using DisplacementColumns = Eigen::Map<const Eigen::Matrix3Xd>;

DisplacementColumns as_columns(const Eigen::VectorXd& u) { return {u.data(), 3, u.size() / 3}; }

/// Columns of values at the model's vertices, carried to the shown ones.
Eigen::MatrixXd as_shown(const SolvedBody& solved, const Eigen::MatrixXd& columns) {
    return solved.proxy ? carried_columns(*solved.proxy, columns) : columns;
}

SurfaceMesh moved_surface(const SolvedBody& solved) {
    SurfaceMesh mesh = *solved.shown;
    mesh.vertices += as_columns(solved.displacement);
    return mesh;
}

constexpr const char *kLength = "L", *kStress = "F/L^2";

FileFacts facts_of(const SolvedBody& solved) {
    const Model& model = solved.deformer->model();
    const Material& material = model.body().material;
    FileFacts facts{{"units", "L: the unit of length of the mesh; F: that of force, in which Young's modulus is F/L^2"},
                    {"unit_of_points", kLength},
                    {"method", std::string(name(model.method().kind))},
                    {"young_modulus", material.young_modulus},
                    {"unit_of_young_modulus", kStress},
                    {"poisson_ratio", material.poisson_ratio}};
    if (solved.proxy)
        facts.push_back(
            {"simulated_on", "a proxy of " + std::to_string(solved.proxy->surface->n_vertices()) + " vertices"});
    return facts;
}

/// Throws where a field is not finite: stresses that overflow, of a modulus near the end of the range of numbers.
std::vector<MeshField> finite(std::vector<MeshField> fields, const std::string& body) {
    for (const MeshField& field : fields)
        if (!field.values.allFinite())
            throw SolveError(body + ": the field " + field.name +
                             " is beyond double precision. Choose another unit of force, or smaller motions.");
    return fields;
}

Eigen::MatrixXd von_mises(const Eigen::MatrixXd& stresses) {
    Eigen::MatrixXd sizes(1, stresses.cols());
    for (Eigen::Index i = 0; i < stresses.cols(); ++i)
        sizes(0, i) = measure(StressMeasure::von_mises, stress_tensor(stresses.col(i)));
    return sizes;
}

void write_inside(std::ostream& out, const fs::path& name, const SolvedBody& solved, VtkPoints points,
                  Control& control) {
    const std::shared_ptr<const Model> model(solved.deformer, &solved.deformer->model());
    const std::shared_ptr<const Volume> volume = Volume::of(model, control);
    if (!volume)
        throw Error(one_line(name.string()) + ": " + std::string(elastolab::name(model->method().kind)) +
                    " has no tetrahedra inside. Choose .vtp, or a finite-element method.");
    const Positions& rest = volume->mesh().vertices;
    const InteriorValues values = solved.deformer->interior_field(solved.values, control)->at(rest, control);
    Eigen::Matrix3Xd u = values.displacements.reshaped(3, rest.cols());
    u.leftCols(solved.simulated_displacement.size() / 3) = as_columns(solved.simulated_displacement);
    const Eigen::MatrixXd stresses = values.stresses.reshaped(6, rest.cols()),
                          in_cells = volume->element_stresses(u, model->body().material, !solved.deformer->linear());
    const std::string& body = model->body().name;
    const std::vector<MeshField> at_nodes = finite(
        {{"displacement", u, kLength}, {"von_mises", von_mises(stresses), kStress}, {"stress", stresses, kStress}},
        body);
    const std::vector<MeshField> cells =
        finite({{"von_mises", von_mises(in_cells), kStress}, {"stress", in_cells, kStress}}, body);
    write_vtu(out, points == VtkPoints::moved ? Positions(rest + u) : rest, volume->elements(), at_nodes, cells,
              facts_of(solved), points);
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

Eigen::MatrixXd carried_columns(const Proxy& proxy, const Eigen::MatrixXd& columns) {
    Eigen::MatrixXd shown(columns.rows(), proxy.shown->n_vertices());
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
        shown.row(i) = carried_values(proxy, columns.row(i).transpose()).transpose();
    return shown;
}

Eigen::VectorXd stress_of(const SolvedBody& solved) {
    for (const MeshField& field : surface_fields(solved))
        if (field.name == "stress") return field.values.reshaped();
    return {};
}

std::vector<MeshField> surface_fields(const SolvedBody& solved) {
    const Body& body = solved.deformer->model().body();
    const Eigen::Matrix3Xd tractions = vertex_tractions(*body.surface, solved.constrained, solved.forces);
    const Eigen::VectorXd& u = solved.simulated_displacement;
    const bool large = !solved.deformer->linear();
    const std::vector<UnitLoad>& loads = solved.deformer->set().loads;
    const Eigen::Matrix3Xd of_loads =
        load_tractions(*body.surface, loads, solved.values.tail(std::ssize(loads)), large ? u : Eigen::VectorXd());
    Eigen::MatrixXd stress =
        as_shown(solved, surface_stress(*body.surface, body.material, u, tractions, large, of_loads));
    Eigen::MatrixXd size = von_mises(stress);
    return finite({{"displacement", as_columns(solved.displacement), kLength},
                   {"von_mises", std::move(size), kStress},
                   {"traction", as_shown(solved, tractions), kStress},
                   {"stress", std::move(stress), kStress}},
                  body.name);
}

void write_field_file(std::ostream& out, const fs::path& name, const SolvedBody& solved, Control& control,
                      VtkPoints points) {
    const std::string ending = lower_case(name.extension().string());
    if (ending == ".vtu") return write_inside(out, name, solved, points, control);
    if (!is_field_file(name))
        throw Error(one_line(name.string()) + ": fields are written as .ply, .vtp, .vtu or .csv. Choose one of these.");
    const std::vector<MeshField> fields = surface_fields(solved);
    control.checkpoint();
    if (ending == ".csv") return write_field_csv(out, solved.shown->vertices, fields);
    if (ending == ".vtp")
        return write_vtp(out, points == VtkPoints::moved ? moved_surface(solved) : *solved.shown, fields,
                         facts_of(solved), points);
    write_ply(out, moved_surface(solved), fields);
}

void save_field_file(const fs::path& file, const SolvedBody& solved, Control& control, VtkPoints points) {
    AtomicFile output(file);
    write_field_file(output.stream(), file, solved, control, points);
    output.commit();
}

}  // namespace elastolab
