#include "app/picture/shown_body.hpp"

#include <cmath>

#include "app/names.hpp"
#include "deform/surface_stress.hpp"

namespace elastolab {

namespace {

using Columns = Eigen::Map<const Eigen::Matrix3Xd>;

Columns columns(const Eigen::VectorXd& u) { return {u.data(), 3, u.size() / 3}; }

/// Only answers to the same question differ by their methods.
bool comparable(const MethodRunner& runner, const MethodRunner* reference) {
    constexpr auto kReady = MethodRunner::State::ready;
    if (reference == nullptr || reference == &runner) return false;
    if (runner.state() != kReady || reference->state() != kReady || runner.surface() != reference->surface())
        return false;
    const auto poisson_ratio = [](const MethodRunner& of) { return of.model()->body().material.poisson_ratio; };
    return poisson_ratio(runner) == poisson_ratio(*reference) && runner.values().size() == reference->values().size() &&
           runner.values() == reference->values();
}

std::vector<float> magnitudes(const Eigen::Matrix3Xd& vectors) {
    std::vector<float> values(static_cast<std::size_t>(vectors.cols()));
    for (Eigen::Index i = 0; i < vectors.cols(); ++i)
        values[static_cast<std::size_t>(i)] = static_cast<float>(vectors.col(i).norm());
    return values;
}

double ratio(double value, double to) { return to > 0.0 ? value / to : 0.0; }

Difference difference_of(const Eigen::VectorXd& u, const Eigen::VectorXd& reference) {
    const Eigen::RowVectorXd d = (columns(u) - columns(reference)).colwise().norm();
    const Eigen::RowVectorXd size = columns(reference).colwise().norm();
    Difference result;
    result.max = d.maxCoeff(&result.worst_vertex);
    result.rms = d.norm() / std::sqrt(static_cast<double>(d.size()));
    result.relative_max = ratio(result.max, size.maxCoeff());
    result.relative_rms = ratio(d.norm(), size.norm());
    return result;
}

SectionPlane plane_of(const MeshReport& report, const DisplaySettings& display) {
    const double low = report.min_corner[display.section_axis], high = report.max_corner[display.section_axis];
    return {display.section_axis, low + display.section_place * (high - low), display.section_flip};
}

}  // namespace

bool ShownBody::update(const LiveScene& scene, const MethodRunner& runner, const MethodRunner* reference,
                       const Volume* volume, const DisplaySettings& display) {
    const bool differs = comparable(runner, reference);
    const Key key{.mesh = &scene.mesh(),
                  .version = runner.version(),
                  .reference_version = differs ? reference->version() : 0,
                  .reference = differs ? reference : nullptr,
                  .field = display.field,
                  .scale = display.deformation_scale,
                  .arrows = display.arrows,
                  .volume = volume,
                  .plane = plane_of(scene.report(), display)};
    if (key == key_ && positions_.cols() == scene.mesh().n_vertices()) return false;
    key_ = key;
    static std::uint64_t last_revision = 0;  // one thread owns all of them
    revision_ = ++last_revision;
    update_positions(scene, runner, display.deformation_scale);
    const bool needs_tractions = display.field == Field::traction || display.field == Field::von_mises;
    update_reactions(scene, runner, display.arrows || needs_tractions);
    update_difference(scene, runner, reference);
    update_values(scene, runner, reference, display.field);
    update_section(runner, volume, display);
    return true;
}

void ShownBody::update_positions(const LiveScene& scene, const MethodRunner& runner, double scale) {
    positions_ = scene.mesh().vertices;
    max_displacement_ = 0.0;
    if (runner.displacement().size() != positions_.size()) return;
    const Columns u = columns(runner.displacement());
    positions_ += scale * u;
    max_displacement_ = std::sqrt(u.colwise().squaredNorm().maxCoeff());
}

void ShownBody::update_reactions(const LiveScene& scene, const MethodRunner& runner, bool wanted) {
    reactions_.clear();
    tractions_ = Eigen::Matrix3Xd::Zero(3, scene.mesh().n_vertices());
    if (!wanted || !runner.deformer()) return;
    const ConstrainedSet& set = runner.deformer()->set();
    const ConstrainedSet& present = scene.constraints().set;
    if (set.base != present.base || set.handles != present.handles) return;  // the new set is on its way
    const Reactions reactions = runner.deformer()->reactions(runner.values());
    std::vector<int> constrained = set.base;
    constrained.insert(constrained.end(), set.handles.begin(), set.handles.end());
    tractions_ = vertex_tractions(scene.mesh(), constrained, reactions.forces);
    for (const ConstraintGroup& group : scene.constraints().groups) {
        const int n = group.end - group.begin;
        const std::vector<int> vertices(constrained.begin() + group.begin, constrained.begin() + group.end);
        reactions_.push_back({.name = group.name,
                              .force = reactions.forces.middleCols(group.begin, n).rowwise().sum(),
                              .moment = reactions.moments.middleCols(group.begin, n).rowwise().sum(),
                              .place = positions_(Eigen::all, vertices).rowwise().mean()});
    }
}

void ShownBody::update_difference(const LiveScene&, const MethodRunner& runner, const MethodRunner* reference) {
    difference_.reset();
    if (comparable(runner, reference)) difference_ = difference_of(runner.displacement(), reference->displacement());
}

void ShownBody::update_section(const MethodRunner& runner, const Volume* volume, const DisplaySettings& display) {
    if (volume == nullptr || runner.displacement().size() != positions_.size()) {
        section_.reset();
        return;
    }
    const TetMesh& mesh = volume->mesh();
    if (!section_ || section_->plane != key_.plane || section_->rest.cols() != mesh.vertices.cols())
        section_ = ShownSection{key_.plane, cut_faces(mesh, key_.plane), mesh.vertices, {}, {}};
    if (section_->triangles.cols() == 0) {  // all cut away: the whole body says more
        section_.reset();
        return;
    }
    const Eigen::VectorXd u = volume->displace(runner.displacement());
    section_->positions = mesh.vertices + display.deformation_scale * columns(u);
    section_->values.clear();
    if (display.field == Field::displacement) section_->values = magnitudes(columns(u));
}

void ShownBody::update_values(const LiveScene& scene, const MethodRunner& runner, const MethodRunner* reference,
                              Field field) {
    values_.clear();
    max_value_ = 0.0;
    if (field == Field::none || runner.displacement().size() != positions_.size()) return;
    const Eigen::VectorXd& u = runner.displacement();
    if (field == Field::displacement) values_ = magnitudes(columns(u));
    if (field == Field::traction) values_ = magnitudes(tractions_);
    if (field == Field::difference) {
        if (comparable(runner, reference))
            values_ = magnitudes(columns(u) - columns(reference->displacement()));
        else
            values_.assign(static_cast<std::size_t>(positions_.cols()), 0.0f);
    }
    if (field == Field::von_mises) {
        const Eigen::VectorXd stress = surface_von_mises(scene.mesh(), scene.document().material, u, tractions_);
        values_.assign(stress.begin(), stress.end());
    }
    for (const float value : values_) max_value_ = std::max(max_value_, static_cast<double>(value));
}

std::string field_title(Field field, MethodKind reference) {
    switch (field) {
        case Field::none:
            return "";
        case Field::displacement:
            return "displacement [mesh units]";
        case Field::difference:
            return "difference to " + std::string(title(reference)) + " [mesh units]";
        case Field::traction:
            return "traction [force / unit\u00b2]";
        case Field::von_mises:
            return "von Mises stress [force / unit\u00b2]";
    }
    return "";
}

}  // namespace elastolab
