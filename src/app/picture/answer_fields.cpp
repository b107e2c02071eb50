#include "app/picture/answer_fields.hpp"

#include <cmath>

#include "deform/surface_stress.hpp"

namespace elastolab {

namespace {

using Columns = Eigen::Map<const Eigen::Matrix3Xd>;

Columns columns(const Eigen::VectorXd& u) { return {u.data(), 3, u.size() / 3}; }

std::vector<float> magnitudes(const Eigen::Matrix3Xd& vectors) {
    std::vector<float> values(static_cast<std::size_t>(vectors.cols()));
    for (Eigen::Index i = 0; i < vectors.cols(); ++i)
        values[static_cast<std::size_t>(i)] = static_cast<float>(vectors.col(i).norm());
    return values;
}

const Material& material_of(const EmbeddedRunner& answer) {
    return answer.runner().deformer()->model().body().material;
}

double ratio(double value, double to) { return to > 0.0 ? value / to : 0.0; }

}  // namespace

bool comparable(const EmbeddedRunner& answer, const EmbeddedRunner* reference) {
    if (reference == nullptr || reference == &answer || !answer.ready() || !reference->ready()) return false;
    if (answer.displacement().size() != reference->displacement().size()) return false;
    const auto poisson_ratio = [](const EmbeddedRunner& of) {
        return of.runner().model()->body().material.poisson_ratio;
    };
    return poisson_ratio(answer) == poisson_ratio(*reference);
}

std::optional<Difference> difference_between(const EmbeddedRunner& answer, const EmbeddedRunner* reference) {
    if (!comparable(answer, reference)) return std::nullopt;
    const Columns u = columns(answer.displacement()), to = columns(reference->displacement());
    const Eigen::RowVectorXd d = (u - to).colwise().norm(), size = to.colwise().norm();
    Difference result;
    result.max = d.maxCoeff(&result.worst_vertex);
    result.rms = d.norm() / std::sqrt(static_cast<double>(d.size()));
    result.relative_max = ratio(result.max, size.maxCoeff());
    result.relative_rms = ratio(d.norm(), size.norm());
    return result;
}

bool has_large_displacements(const EmbeddedRunner& answer) { return !answer.runner().deformer()->linear(); }

AnswerTractions answer_tractions(const EmbeddedRunner& answer, const ReactionRunner& reactions) {
    const SurfaceMesh& surface = *answer.surface();
    const Constraints& constraints = answer.constraints();
    const std::vector<UnitLoad>& loads = constraints.set.loads;
    const Eigen::VectorXd& moved = answer.runner().displacement();
    const bool is_moved = has_large_displacements(answer) && moved.size() == surface.vertices.size();
    return {vertex_tractions(surface, reactions.vertices(), reactions.reactions().forces),
            load_tractions(surface, loads, constraints.values.tail(std::ssize(loads)),
                           is_moved ? moved : Eigen::VectorXd())};
}

Eigen::VectorXd AnswerFields::simulated(Field field) const {
    const Eigen::VectorXd& u = answer_.runner().displacement();
    if (field == Field::displacement) return columns(u).colwise().norm();
    if (const auto axis = displacement_axis(field)) return columns(u).row(*axis);
    const bool has_tractions = tractions_.at_vertices.cols() > 0;
    if (field == Field::traction && has_tractions) return tractions_.at_vertices.colwise().norm();
    if (const auto which = stress_of(field); which && has_tractions)
        return surface_stress_measure(*which, *answer_.surface(), material_of(answer_), u, tractions_.at_vertices,
                                      has_large_displacements(answer_), tractions_.on_triangles);
    const bool differs = field == Field::difference && comparable(answer_, reference_);
    if (!differs || reference_->surface() != answer_.surface()) return {};
    return (columns(u) - columns(reference_->runner().displacement())).colwise().norm();
}

std::vector<float> AnswerFields::shown(Field field) const {
    const Eigen::VectorXd& u = answer_.displacement();
    if (field == Field::displacement) return magnitudes(columns(u));
    if (const auto axis = displacement_axis(field)) return as_floats(columns(u).row(*axis).transpose());
    if (field == Field::difference)
        return comparable(answer_, reference_) ? magnitudes(columns(u) - columns(reference_->displacement()))
                                               : std::vector<float>(static_cast<std::size_t>(u.size() / 3), 0.0f);
    if (field != Field::traction && !stress_of(field)) return {};
    const Eigen::VectorXd values = simulated(field);
    return values.size() > 0 ? as_floats(answer_.shown_values(values)) : std::vector<float>();
}

Eigen::MatrixXd AnswerFields::shown_stresses() const {
    return carried(surface_stress(*answer_.surface(), material_of(answer_), answer_.runner().displacement(),
                                  tractions_.at_vertices, has_large_displacements(answer_), tractions_.on_triangles));
}

/// Rows of values at the simulated vertices, carried to the shown ones.
Eigen::MatrixXd AnswerFields::carried(const Eigen::MatrixXd& rows) const {
    Eigen::MatrixXd shown(rows.rows(), answer_.displacement().size() / 3);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        shown.row(i) = answer_.shown_values(rows.row(i).transpose()).transpose();
    return shown;
}

std::vector<float> as_floats(const Eigen::VectorXd& numbers) {
    const Eigen::VectorXf floats = numbers.cast<float>();
    return {floats.begin(), floats.end()};
}

}  // namespace elastolab
