#include "app/picture/shown_reactions.hpp"

#include <algorithm>

#include "app/picture/answer_fields.hpp"

namespace elastolab {

namespace {

/// Of a set: the fixed set first.
std::vector<int> constrained_vertices(const ConstrainedSet& set) {
    std::vector<int> all = set.fixed;
    all.insert(all.end(), set.handles.begin(), set.handles.end());
    return all;
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

/// What rounding has left of a force or a moment that vanishes, beside the largest of both, is shown as zero.
void clear_rounding(std::vector<ShownReaction>& all, double length) {
    constexpr double kRoundingPart = 1e-9;
    double largest = 0.0;  // [force]
    for (const ShownReaction& one : all)
        largest = std::max({largest, one.force.norm(), one.moment_about_middle().norm() / length});
    for (ShownReaction& one : all) {
        const Eigen::Vector3d moment = one.moment_about_middle();
        if (one.force.norm() <= kRoundingPart * largest) one.force.setZero();
        one.moment = one.middle.cross(one.force);
        if (moment.norm() > kRoundingPart * largest * length) one.moment += moment;
    }
}

}  // namespace

std::vector<ShownReaction> shown_reactions(const LiveScene& scene, const EmbeddedRunner& answer,
                                           const ReactionRunner& known, const Positions& positions) {
    const Constraints &computed = answer.constraints(), &shown = scene.constraints();
    if (known.vertices() != constrained_vertices(computed.set)) return {};  // the new set is on its way
    const Reactions& reactions = known.reactions();
    const Eigen::VectorXd& u = answer.displacement();
    const bool is_moved = has_large_displacements(answer) && u.size() == positions.size();
    const std::vector<int> shown_vertices = constrained_vertices(shown.set);
    const std::vector<ConstraintGroup> seen_groups = told_groups(shown);
    std::vector<ShownReaction> result;
    for (std::size_t g = 0; g < seen_groups.size(); ++g) {
        const ConstraintGroup& seen = seen_groups[g];
        const bool fixed = g < shown.fixed_sets.size();
        // An answer of an earlier set may have others, or the same in other places.
        const ConstraintGroup* group = find_group(fixed ? computed.fixed_sets : computed.groups, seen.name);
        if (group == nullptr || group->begin == group->end) continue;
        const int n = group->end - group->begin;
        const std::vector<int> vertices(shown_vertices.begin() + seen.begin, shown_vertices.begin() + seen.end);
        Eigen::Vector3d middle = scene.mesh().vertices(Eigen::all, vertices).rowwise().mean();
        if (is_moved) middle += u.reshaped(3, u.size() / 3)(Eigen::all, vertices).rowwise().mean();
        result.push_back({.name = seen.name,
                          .fixed = fixed,
                          .force = reactions.forces.middleCols(group->begin, n).rowwise().sum(),
                          .moment = reactions.moments.middleCols(group->begin, n).rowwise().sum(),
                          .place = positions(Eigen::all, vertices).rowwise().mean(),
                          .middle = middle});
    }
    clear_rounding(result, (scene.report().max_corner - scene.report().min_corner).norm());
    return result;
}

}  // namespace elastolab
