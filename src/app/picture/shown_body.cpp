#include "app/picture/shown_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "app/names.hpp"
#include "base/timer.hpp"
#include "deform/surface_stress.hpp"

namespace elastolab {

namespace {

using Columns = Eigen::Map<const Eigen::Matrix3Xd>;

Columns columns(const Eigen::VectorXd& u) { return {u.data(), 3, u.size() / 3}; }

/// Only answers to the same question differ by their methods.
bool comparable(const EmbeddedRunner& answer, const EmbeddedRunner* reference) {
    if (reference == nullptr || reference == &answer || !answer.ready() || !reference->ready()) return false;
    if (answer.displacement().size() != reference->displacement().size()) return false;
    const auto poisson_ratio = [](const EmbeddedRunner& of) {
        return of.runner().model()->body().material.poisson_ratio;
    };
    return poisson_ratio(answer) == poisson_ratio(*reference);
}

std::vector<float> magnitudes(const Eigen::Matrix3Xd& vectors) {
    std::vector<float> values(static_cast<std::size_t>(vectors.cols()));
    for (Eigen::Index i = 0; i < vectors.cols(); ++i)
        values[static_cast<std::size_t>(i)] = static_cast<float>(vectors.col(i).norm());
    return values;
}

std::vector<float> as_floats(const Eigen::VectorXd& numbers) {
    const Eigen::VectorXf floats = numbers.cast<float>();
    return {floats.begin(), floats.end()};
}

Eigen::MatrixXd as_row(const std::vector<float>& values) {
    return Eigen::Map<const Eigen::RowVectorXf>(values.data(), std::ssize(values)).cast<double>();
}

/// Rows of values at the simulated vertices, carried to the shown ones.
Eigen::MatrixXd shown_rows(const EmbeddedRunner& answer, const Eigen::MatrixXd& rows) {
    Eigen::MatrixXd shown(rows.rows(), answer.displacement().size() / 3);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        shown.row(i) = answer.shown_values(rows.row(i).transpose()).transpose();
    return shown;
}

/// That of the model that answered: the scene's may be newer than the displacements.
bool is_large(const EmbeddedRunner& answer) { return !answer.runner().deformer()->linear(); }

const Material& material_of(const EmbeddedRunner& answer) {
    return answer.runner().deformer()->model().body().material;
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

std::vector<int> joined(const std::vector<int>& a, const std::vector<int>& b) {
    std::vector<int> all = a;
    all.insert(all.end(), b.begin(), b.end());
    return all;
}

/// Whether an answer is one of the filled surface, so that it says where the filling is.
bool answers(const EmbeddedRunner& answer, const FillingShape& filling) {
    return answer.surface() == filling.surface().get() &&
           answer.runner().displacement().size() == filling.surface()->vertices.size();
}

/// Null where there is none of that name.
const ConstraintGroup* find_group(const std::vector<ConstraintGroup>& groups, const std::string& name) {
    const auto found =
        std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.name == name; });
    return found == groups.end() ? nullptr : &*found;
}

/// The groups whose reactions are told: every fixed set by itself, then the handles.
std::vector<ConstraintGroup> told_groups(const Constraints& constraints) {
    std::vector<ConstraintGroup> groups = constraints.fixed_sets;
    groups.insert(groups.end(), constraints.groups.begin() + (constraints.has_fixed() ? 1 : 0),
                  constraints.groups.end());
    return groups;
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
    update_difference(sources);
    update_values(sources, display.field);
    colour_filling(sources, display.field);
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
    const Columns u = columns(sources.answer.displacement());
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
    tractions_.resize(3, 0);
    load_tractions_.resize(3, 0);
    const EmbeddedRunner& answer = sources.answer;
    const ReactionRunner* known = sources.reactions;
    if (known == nullptr || known->surface() == nullptr || known->surface() != answer.surface()) return;
    const std::vector<int>& constrained = known->vertices();
    const Reactions& reactions = known->reactions();
    tractions_ = vertex_tractions(*answer.surface(), constrained, reactions.forces);
    const Constraints &computed = answer.constraints(), &shown = sources.scene.constraints();
    const Eigen::VectorXd& moved = answer.runner().displacement();
    load_tractions_ = load_tractions(
        *answer.surface(), computed.set.loads, computed.values.tail(std::ssize(computed.set.loads)),
        is_large(answer) && moved.size() == answer.surface()->vertices.size() ? moved : Eigen::VectorXd());
    if (constrained != joined(computed.set.fixed, computed.set.handles)) return;  // the new set is on its way
    const std::vector<int> shown_vertices = joined(shown.set.fixed, shown.set.handles);
    const std::vector<ConstraintGroup> seen_groups = told_groups(shown);
    for (std::size_t g = 0; g < seen_groups.size(); ++g) {
        const ConstraintGroup& seen = seen_groups[g];
        const bool fixed = g < shown.fixed_sets.size();
        // An answer of an earlier set may have others, or the same in other places.
        const ConstraintGroup* group = find_group(fixed ? computed.fixed_sets : computed.groups, seen.name);
        if (group == nullptr || group->begin == group->end) continue;
        const int n = group->end - group->begin;
        const std::vector<int> vertices(shown_vertices.begin() + seen.begin, shown_vertices.begin() + seen.end);
        Eigen::Vector3d middle = sources.scene.mesh().vertices(Eigen::all, vertices).rowwise().mean();
        if (is_large(answer) && answer.displacement().size() == positions_.size())
            middle += columns(answer.displacement())(Eigen::all, vertices).rowwise().mean();
        reactions_.push_back({.name = seen.name,
                              .fixed = fixed,
                              .force = reactions.forces.middleCols(group->begin, n).rowwise().sum(),
                              .moment = reactions.moments.middleCols(group->begin, n).rowwise().sum(),
                              .place = positions_(Eigen::all, vertices).rowwise().mean(),
                              .middle = middle});
    }
}

void ShownBody::update_difference(const Sources& sources) {
    difference_.reset();
    if (comparable(sources.answer, sources.reference))
        difference_ = difference_of(sources.answer.displacement(), sources.reference->displacement());
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

void ShownBody::update_values(const Sources& sources, Field field) {
    values_.clear();
    largest_magnitude_ = 0.0;
    const EmbeddedRunner& answer = sources.answer;
    if (field == Field::none || answer.displacement().size() != positions_.size()) return;
    const Eigen::VectorXd& u = answer.displacement();
    if (field == Field::displacement) values_ = magnitudes(columns(u));
    if (const auto axis = displacement_axis(field)) values_ = as_floats(columns(u).row(*axis).transpose());
    if (field == Field::difference) {
        if (comparable(answer, sources.reference))
            values_ = magnitudes(columns(u) - columns(sources.reference->displacement()));
        else
            values_.assign(static_cast<std::size_t>(positions_.cols()), 0.0f);
    }
    if (field == Field::traction || stress_of(field))
        if (const Eigen::VectorXd simulated = simulated_values(sources, field); simulated.size() > 0)
            values_ = as_floats(answer.shown_values(simulated));
    for (const float value : values_)
        largest_magnitude_ = std::max(largest_magnitude_, std::abs(static_cast<double>(value)));
}

/// The field at the vertices of the surface that is simulated; empty where it is not known there.
Eigen::VectorXd ShownBody::simulated_values(const Sources& sources, Field field) const {
    const EmbeddedRunner& answer = sources.answer;
    const Eigen::VectorXd& u = answer.runner().displacement();
    if (field == Field::displacement) return columns(u).colwise().norm();
    if (const auto axis = displacement_axis(field)) return columns(u).row(*axis);
    if (field == Field::traction && tractions_.cols() > 0) return tractions_.colwise().norm();
    if (const auto which = stress_of(field); which && tractions_.cols() > 0)
        return surface_stress_measure(*which, *answer.surface(), material_of(answer), u, tractions_, is_large(answer),
                                      load_tractions_);
    const bool differs = field == Field::difference && comparable(answer, sources.reference);
    if (!differs || sources.reference->surface() != answer.surface()) return {};
    return (columns(u) - columns(sources.reference->runner().displacement())).colwise().norm();
}

void ShownBody::colour_filling(const Sources& sources, Field field) {
    if (!filling_ || values_.empty()) return;
    const FillingShape& shape = *filling_->shape;
    const Eigen::VectorXd own = answers(sources.answer, shape) ? simulated_values(sources, field) : Eigen::VectorXd();
    const Eigen::MatrixXd values = own.size() > 0 ? shape.taken(own.transpose()) : shape.spread(as_row(values_));
    filling_->values = as_floats(values.row(0).transpose());
}

void ShownBody::update_seen() {
    seen_magnitudes_.clear();
    largest_of_part_.reset();
    largest_magnitude_ = 0.0;
    const auto see = [&](float value) {
        if (std::isfinite(value)) seen_magnitudes_.push_back(std::abs(value));
    };
    if (section_ && !section_->values.empty()) {
        std::vector<char> is_seen(section_->values.size(), 0);
        for (const int v : section_->shape->triangles().reshaped()) is_seen[static_cast<std::size_t>(v)] = 1;
        for (std::size_t v = 0; v < is_seen.size(); ++v)
            if (is_seen[v] != 0) see(section_->values[v]);
    } else {
        for (const float value : values_) see(value);
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

void ShownBody::update_probed(const Sources& sources) {
    shown_tractions_.resize(3, 0);
    shown_stresses_.resize(6, 0);
    const EmbeddedRunner& answer = sources.answer;
    // While the next reactions are computed the last ones are not of this answer.
    if (!sources.probed || sources.reactions == nullptr || sources.reactions->running()) return;
    if (tractions_.cols() == 0 || answer.displacement().size() != positions_.size()) return;
    shown_tractions_ = shown_rows(answer, tractions_);
    shown_stresses_ =
        shown_rows(answer, surface_stress(*answer.surface(), material_of(answer), answer.runner().displacement(),
                                          tractions_, is_large(answer), load_tractions_));
}

std::string field_title(Field field, MethodKind reference, const UnitNames& units) {
    static const std::map<Field, std::string> stresses = {{Field::von_mises, "von Mises stress"},
                                                          {Field::first_principal, "first principal stress"},
                                                          {Field::third_principal, "third principal stress"},
                                                          {Field::stress_xx, "stress xx"},
                                                          {Field::stress_yy, "stress yy"},
                                                          {Field::stress_zz, "stress zz"},
                                                          {Field::stress_xy, "stress xy"},
                                                          {Field::stress_yz, "stress yz"},
                                                          {Field::stress_xz, "stress xz"}};
    const std::string lengths = " [" + units.of_length() + "]", per_area = " [" + units.of_stress() + "]";
    if (const auto found = stresses.find(field); found != stresses.end()) return found->second + per_area;
    if (field == Field::displacement) return "displacement" + lengths;
    if (const auto axis = displacement_axis(field)) return std::string("displacement ") + "xyz"[*axis] + lengths;
    if (field == Field::difference) return "difference to " + std::string(title(reference)) + lengths;
    return field == Field::traction ? "traction" + per_area : "";
}

}  // namespace elastolab
