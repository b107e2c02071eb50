#include "app/picture/shown_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/timer.hpp"

namespace elastolab {

namespace {

Eigen::MatrixXd as_row(const std::vector<float>& values) {
    return Eigen::Map<const Eigen::RowVectorXf>(values.data(), std::ssize(values)).cast<double>();
}

/// Whether an answer is one of the filled surface, so that it says where the filling is.
bool answers(const EmbeddedRunner& answer, const FillingShape& filling) {
    return answer.surface() == filling.surface().get() &&
           answer.runner().displacement().size() == filling.surface()->vertices.size();
}

}  // namespace

ShownBody::Key ShownBody::key_of(const Sources& sources, const DisplaySettings& display) {
    const bool differs = comparable(sources.answer, sources.reference);
    return {.mesh = &sources.scene.mesh(),
            .version = sources.answer.version(),
            .reference_version = differs ? sources.reference->version() : 0,
            .answer = &sources.answer,
            .reference = differs ? sources.reference : nullptr,
            .filling = sources.filling,
            .field = display.field,
            .scale = display.deformation_scale,
            .reactions = sources.reactions,
            .reaction_revision = sources.reactions ? sources.reactions->revision() : 0,
            .scene_revision = sources.reactions ? sources.scene.revision() : 0,
            .section = sources.section,
            .inside_revision = sources.inside ? sources.inside->revision() : 0,
            .probed = sources.probed};
}

bool ShownBody::update(const Sources& sources, const DisplaySettings& display) {
    const Key key = key_of(sources, display);
    if (key == key_ && positions_.cols() == sources.scene.mesh().n_vertices()) return false;
    key_ = key;
    static std::uint64_t last_revision = 0;  // one thread owns all of them
    revision_ = ++last_revision;
    update_positions(sources, display.deformation_scale);
    update_filling(sources, display.deformation_scale);
    update_reactions(sources);
    difference_ = difference_between(sources.answer, sources.reference);
    update_values(sources, display.field);
    update_probed(sources);
    const Stopwatch watch;
    update_section(sources, display);
    section_seconds_ = watch.seconds();
    update_seen();
    return true;
}

void ShownBody::update_positions(const Sources& sources, double scale) {
    positions_ = sources.scene.mesh().vertices;
    max_displacement_ = 0.0;
    if (sources.answer.displacement().size() != positions_.size()) return;
    const Eigen::Map<const Eigen::Matrix3Xd> u(sources.answer.displacement().data(), 3, positions_.cols());
    positions_ += scale * u;
    max_displacement_ = std::sqrt(u.colwise().squaredNorm().maxCoeff());
}

/// While a preview answers, which has another surface, the filling follows the rims of the holes.
void ShownBody::update_filling(const Sources& sources, double scale) {
    if (!sources.filling) return filling_.reset();
    const FillingShape& shape = *sources.filling;
    const Eigen::VectorXd& u = sources.answer.runner().displacement();
    filling_ = ShownFilling{
        sources.filling, answers(sources.answer, shape) ? shape.displaced(u, scale) : shape.following(positions_), {}};
}

void ShownBody::update_reactions(const Sources& sources) {
    reactions_.clear();
    tractions_ = {};
    const ReactionRunner* known = sources.reactions;
    if (known == nullptr || known->surface() == nullptr || known->surface() != sources.answer.surface()) return;
    if (!sources.answer.has_answer()) return;  // they are of what answered in its place
    tractions_ = answer_tractions(sources.answer, *known);
    reactions_ = shown_reactions(sources.scene, sources.answer, *known, positions_);
}

void ShownBody::update_values(const Sources& sources, Field field) {
    values_.clear();
    largest_magnitude_ = 0.0;
    if (sources.answer.displacement().size() != positions_.size()) return;
    const AnswerFields fields(sources.answer, sources.reference, tractions_);
    values_ = fields.shown(field);
    for (const float value : values_)
        largest_magnitude_ = std::max(largest_magnitude_, std::abs(static_cast<double>(value)));
    if (filling_ && !values_.empty()) colour_filling(sources.answer, fields, field);
}

/// By the values at the simulated vertices, where these are of the filled surface and known.
void ShownBody::colour_filling(const EmbeddedRunner& answer, const AnswerFields& fields, Field field) {
    const FillingShape& shape = *filling_->shape;
    const Eigen::VectorXd own = answers(answer, shape) ? fields.simulated(field) : Eigen::VectorXd();
    const Eigen::MatrixXd values = own.size() > 0 ? shape.taken(own.transpose()) : shape.spread(as_row(values_));
    filling_->values = as_floats(values.row(0).transpose());
}

void ShownBody::update_probed(const Sources& sources) {
    probed_tractions_.resize(3, 0);
    probed_stresses_.resize(6, 0);
    // While the next reactions are computed the last ones are not of this answer.
    if (!sources.probed || sources.reactions == nullptr || sources.reactions->running()) return;
    if (tractions_.at_vertices.cols() == 0 || sources.answer.displacement().size() != positions_.size()) return;
    const AnswerFields fields(sources.answer, sources.reference, tractions_);
    probed_tractions_ = fields.shown_tractions();
    probed_stresses_ = fields.shown_stresses();
}

void ShownBody::update_section(const Sources& sources, const DisplaySettings& display) {
    section_.reset();
    if (!sources.section || sources.section->is_empty()) return;  // all cut away: the whole body says more
    const SectionShape& shape = *sources.section;
    const SectionRunner* inside = sources.inside && sources.inside->ready() ? sources.inside : nullptr;
    const Positions whole = filling_ ? Positions(filling_->shape->joined(positions_, filling_->positions)) : positions_;
    Positions within = shape.inside();
    if (inside && inside->is_current())
        within += display.deformation_scale * inside->displacements();
    else
        within += shape.spread_from_rim(whole - shape.surface()->vertices);
    section_ = ShownSection{sources.section, shape.joined(whole, within), {}};
    if (!values_.empty()) colour_section(inside, display.field);
}

void ShownBody::colour_section(const SectionRunner* inside, Field field) {
    const SectionShape& shape = *section_->shape;
    Eigen::MatrixXd surface = as_row(values_);
    if (filling_) surface = filling_->shape->joined(surface, as_row(filling_->values));
    Eigen::MatrixXd within = Eigen::MatrixXd::Constant(1, shape.n_inside(), std::numeric_limits<double>::quiet_NaN());
    if (largest_magnitude_ == 0.0) within.setZero();  // at rest
    if (inside && field == Field::displacement) within = inside->displacements().colwise().norm();
    if (const auto axis = displacement_axis(field); inside && axis) within = inside->displacements().row(*axis);
    if (const auto which = stress_of(field); inside && which) {
        const Eigen::Matrix<double, 6, -1> stresses = inside->stresses();
        for (Eigen::Index i = 0; i < within.cols(); ++i) within(0, i) = measure(*which, stress_tensor(stresses.col(i)));
    }
    section_->values = as_floats(shape.joined(surface, within).row(0).transpose());
}

void ShownBody::update_seen() {
    seen_magnitudes_.clear();
    largest_of_part_.reset();
    largest_magnitude_ = 0.0;
    largest_seen_.reset();
    smallest_seen_.reset();
    const auto see = [&](float value, const auto& place) {
        if (!std::isfinite(value)) return;
        seen_magnitudes_.push_back(std::abs(value));
        if (!largest_seen_ || value > largest_seen_->value) largest_seen_ = SeenValue{value, place};
        if (!smallest_seen_ || value < smallest_seen_->value) smallest_seen_ = SeenValue{value, place};
    };
    if (section_ && !section_->values.empty()) {
        std::vector<char> is_seen(section_->values.size(), 0);
        for (const int v : section_->shape->triangles().reshaped()) is_seen[static_cast<std::size_t>(v)] = 1;
        for (std::size_t v = 0; v < is_seen.size(); ++v)
            if (is_seen[v] != 0) see(section_->values[v], section_->positions.col(static_cast<Eigen::Index>(v)));
    } else {
        for (std::size_t v = 0; v < values_.size(); ++v) see(values_[v], positions_.col(static_cast<Eigen::Index>(v)));
    }
    for (const float value : seen_magnitudes_) largest_magnitude_ = std::max(largest_magnitude_, double{value});
}

double ShownBody::largest_magnitude(double part) const {
    if (part >= 1.0 || seen_magnitudes_.empty()) return largest_magnitude_;
    if (largest_of_part_ && largest_of_part_->first == part) return largest_of_part_->second;
    const auto place =
        seen_magnitudes_.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(seen_magnitudes_.size() - 1));
    std::nth_element(seen_magnitudes_.begin(), place, seen_magnitudes_.end());
    const double found = *place > 0.0f ? double{*place} : largest_magnitude_;
    largest_of_part_.emplace(part, found);
    return found;
}

bool ShownBody::is_cut_away(int vertex) const {
    if (!section_) return false;
    const Plane& plane = section_->shape->plane();
    return plane.normal.dot(section_->shape->surface()->vertices.col(vertex)) > plane.offset;
}

}  // namespace elastolab
