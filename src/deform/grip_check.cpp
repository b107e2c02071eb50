#include "deform/grip_check.hpp"

#include <algorithm>
#include <Eigen/Geometry>

#include "base/error.hpp"
#include "deform/loose_motions.hpp"
#include "deform/moved_grips.hpp"
#include "deform/node_rows.hpp"
#include "deform/patch_reactions.hpp"
#include "elasticity/rotation.hpp"
#include "mesh/triangles_across.hpp"

namespace elastolab {

namespace {

/// Of what reactions lack of balance by collocation, what is told of the displacements of handles under a force at
/// least, beyond half the largest reaction: the second answer is one to the same motion, and tells nothing of a
/// stiffness that is wrong by a multiple. Bars and plates of 10 to 50 times their thickness, which lack 0.8 to 1, are
/// off by 0.1 to 1; a bar of 4 times that lacks 0.3 and is off by 0.01.
constexpr double kShareOfImbalance = 0.6, kHarmlessImbalance = 0.5;
/// From here on next to nothing of the reactions is right. Of slender bodies nothing of the stiffness is, either: bars
/// turned by a moment lack all of it and are off by 0.36 to 0.92, a rod of 80 times its thickness under a force lacks
/// 0.993 and is off by 2.6; a ball lacks as much and is off by 0.16 to 0.45.
constexpr double kWrongImbalance = 0.97, kWhollyWrong = 0.9, kSlender = 8.0;

/// The same where moments alone act: forces that nothing balances bend the body as the moments do. Bars of 2 to 10
/// times their thickness are off by 0.37 to 0.53 of what they lack.
constexpr double kShareUnderMoments = 0.45;
/// Forces times the size of the body, over moments, that count as none.
constexpr double kNoForces = 0.01;

bool is_slender(const SurfaceMesh& surface) {
    const Eigen::Vector3d size = surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff();
    return size.norm() > kSlender * thickness(surface);
}

double error_of(double imbalance, const SurfaceMesh& surface) {
    const double error = kShareOfImbalance * (imbalance - kHarmlessImbalance);
    if (imbalance < kWrongImbalance || !is_slender(surface)) return error;
    const double part = (std::min(imbalance, 1.0) - kWrongImbalance) / (1.0 - kWrongImbalance);
    return (1.0 - part) * error + part * kWhollyWrong;
}

struct Change {
    Eigen::VectorXd displacements;
    Reactions reactions;
};

/// Along a change of the values: of a linear method the answer to it, else the derivative at the equilibrium.
Change change_along(const Deformer& deformer, const Eigen::VectorXd& values, const Eigen::VectorXd& along,
                    const Deformer::Answer& answer, Control& control) {
    if (deformer.linear()) {
        Deformer::Answer change = deformer.answer(along, {}, control);
        return {std::move(change.displacements), std::move(change.reactions)};
    }
    const Approach here{.start = answer.equilibrium};
    Change change{deformer.drag_response(values, along, control, kSolveTolerance, here).X.col(0), {}};
    change.reactions.forces = deformer.answer(values, {.along = along}, control, here).force_changes.front();
    // Moments are of forces at present positions, which change as well.
    change.reactions.moments = change.reactions.forces;
    const Positions& rest = deformer.model().body().surface->vertices;
    const std::vector<int> constrained = joined(deformer.set().fixed, deformer.set().handles);
    for (Eigen::Index i = 0; i < change.reactions.moments.cols(); ++i) {
        const int v = constrained[static_cast<std::size_t>(i)];
        const Eigen::Vector3d at = rest.col(v) + answer.displacements.segment<3>(3 * v),
                              moves = change.displacements.segment<3>(3 * v), force = answer.reactions.forces.col(i),
                              more = change.reactions.forces.col(i);
        change.reactions.moments.col(i) = at.cross(more) + moves.cross(force);
    }
    return change;
}

/// What of a stiffness at rest is of motions that deform the body: by collocation, whose forces do not balance, there
/// is more.
Eigen::MatrixXd deforming(const Deformer& deformer, const GripsInPlace& grips, const GripArms& arms) {
    const Eigen::VectorXd unit = arms.units();
    const Eigen::MatrixXd loose = loose_motions(deformer, grips.grips, arms).motions;
    Eigen::MatrixXd scaled = unit.asDiagonal() * arms.working(grips.stiffness) * unit.asDiagonal();
    scaled -= loose * (loose.transpose() * scaled);
    scaled -= (scaled * loose) * loose.transpose();
    return unit.cwiseInverse().asDiagonal() * scaled * unit.cwiseInverse().asDiagonal();
}

/// Arms of grips that have moved.
GripArms at(GripArms arms, const std::vector<GripPlace>& places) {
    for (std::size_t g = 0; g < places.size(); ++g) {
        const Eigen::Matrix3d turn = rotation_by(places[g].turn);
        arms.middles[g] += places[g].shift;
        arms.arms[g] = turn * arms.arms[g];
        for (const Eigen::Index row : {6 * static_cast<Eigen::Index>(g), 6 * static_cast<Eigen::Index>(g) + 3})
            arms.inert.middleRows<3>(row) = (turn * arms.inert.middleRows<3>(row)).eval();
    }
    return arms;
}

/// Without what works in motions that nothing but the grips holds. Both answers balance, so that this is what their
/// iterations leave, and only loads that keep their direction resist it: little, where they are small.
Eigen::VectorXd balanced(const Deformer& deformer, const GripsInPlace& grips, const GripArms& arms,
                         const Eigen::VectorXd& forces) {
    const Eigen::MatrixXd loose = loose_motions(deformer, grips.grips, arms).motions;
    const Eigen::VectorXd unit = arms.units(), scaled = unit.cwiseProduct(forces);
    return (scaled - loose * (loose.transpose() * scaled)).cwiseQuotient(unit);
}

/// The motion of the grips that takes back the error of their forces.
Eigen::VectorXd motion_for(const Deformer& deformer, const GripsInPlace& grips, const Eigen::Matrix3Xd& force_error,
                           Eigen::Index n_values) {
    const std::vector<GripForce> none(grips.grips.size());
    const MovedGrips moved(deformer, grips.grips, none);
    const GripArms arms = at(GripArms(deformer, grips.grips), grips.places);
    const GripTangent tangent(deformer.linear() ? deforming(deformer, grips, arms) : arms.working(grips.stiffness),
                              moved.length(), deformer.model().body().material.young_modulus, moved.body_is_held());
    Eigen::VectorXd lacking = -moved.resultants(grips.places, force_error);
    if (!deformer.linear()) lacking = balanced(deformer, grips, arms, lacking);
    const Eigen::VectorXd step = tangent.step(tangent.answered(lacking));
    const double part = deformer.linear() ? 1.0 : std::min(1.0, longest_step(grips.places, moved.length(), step));
    return moved.basis(grips.places, n_values) * (part * step);
}

/// The vertices of handles that are under no force.
std::vector<int> without(const std::vector<Grip>& grips, const std::vector<int>& handles) {
    std::vector<int> moved;
    for (int i = 0; i < static_cast<int>(std::ssize(handles)); ++i)
        if (std::none_of(grips.begin(), grips.end(), [i](const Grip& grip) { return i >= grip.begin && i < grip.end; }))
            moved.push_back(handles[static_cast<std::size_t>(i)]);
    return moved;
}

/// What reactions and loads lack of balance, over the largest reaction. Of methods whose forces do not balance that is
/// an error of the reactions, which no motion of the grips takes back.
double imbalance_of(const Deformer& deformer, const Eigen::VectorXd& values, const Reactions& reactions) {
    const SurfaceMesh& surface = *deformer.model().body().surface;
    const ConstrainedSet& set = deformer.set();
    Reactions sum{reactions.forces.rowwise().sum(), reactions.moments.rowwise().sum()};
    for (std::size_t i = 0; i < set.loads.size(); ++i) {
        const Resultant load = resultant(surface, set.loads[i]);
        const double factor = values[values.size() - std::ssize(set.loads) + static_cast<Eigen::Index>(i)];
        sum.forces += factor * load.force;
        sum.moments += factor * load.moment;
    }
    const double largest =
        largest_patch_reaction(surface, constrained_patches(surface, set.fixed, set.handles), reactions);
    return largest > 0.0 ? largest_patch_reaction(surface, ConstrainedPatches{std::vector<int>{0}}, sum) / largest
                         : 0.0;
}

/// Whether all handles are under moments, and nothing else acts.
bool moments_alone(const Deformer& deformer, const std::vector<Grip>& grips, const Reactions& reactions) {
    const ConstrainedSet& set = deformer.set();
    const SurfaceMesh& surface = *deformer.model().body().surface;
    if (!set.loads.empty() || !without(grips, set.handles).empty()) return false;
    double forces = 0.0, moments = 0.0;
    for (const Grip& grip : grips) {
        const Eigen::Index begin = std::ssize(set.fixed) + grip.begin, n = grip.end - grip.begin;
        const Eigen::Vector3d force = reactions.forces.middleCols(begin, n).rowwise().sum();
        const Eigen::Vector3d moment = reactions.moments.middleCols(begin, n).rowwise().sum();
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (int i = grip.begin; i < grip.end; ++i)
            middle += surface.vertices.col(set.handles[static_cast<std::size_t>(i)]) / static_cast<double>(n);
        forces += force.norm();
        moments += (moment - middle.cross(force)).norm();
    }
    return forces * size_of(surface) <= kNoForces * moments;
}

void correct(DiscretisationCheck& check, const Deformer& deformer, const Eigen::VectorXd& values,
             const GripsInPlace& grips, const Deformer::Answer& answer, Control& control) {
    const Eigen::VectorXd along = motion_for(deformer, grips, check.reaction_error.forces, values.size());
    const Change change = change_along(deformer, values, along, answer, control);
    check.displacement_error += change.displacements;
    check.reaction_error.forces += change.reactions.forces;
    check.reaction_error.moments += change.reactions.moments;
    Eigen::Index moving_most = 0, worst = 0;
    const double size = largest_motion(answer.displacements, moving_most),
                 off = largest_motion(check.displacement_error, worst);
    if (!(size > 0.0)) return;
    check.relative_error = off / size;
    check.vertex = static_cast<int>(worst);
    const Body& body = deformer.model().body();
    const ConstrainedSet& set = deformer.set();
    if (deformer.model().method().kind->balances_forces &&
        is_statically_determinate(*body.surface, set.fixed, without(grips.grips, set.handles))) {
        check.relative_force_error = 0.0;
        return;
    }
    const double load_forces = gross_force(*body.surface, set.loads, values.tail(std::ssize(set.loads)));
    check.relative_force_error = relative_reaction_error(body, set, answer.reactions, check.reaction_error, load_forces,
                                                         size, check.relative_error);
    if (deformer.model().method().kind->balances_forces) return;
    const double imbalance = imbalance_of(deformer, values, answer.reactions);
    check.relative_force_error = std::max(check.relative_force_error, imbalance);
    check.relative_error = std::max(check.relative_error, error_of(imbalance, *body.surface));
    if (moments_alone(deformer, grips.grips, answer.reactions))
        check.relative_error = std::max(check.relative_error, kShareUnderMoments * imbalance);
}

}  // namespace

GripsInPlace in_place(const GripStiffness& stiffness) {
    return {stiffness.grips(), std::vector<GripPlace>(stiffness.grips().size()), stiffness.matrix()};
}

GripsInPlace in_place(const GripEquilibrium& equilibrium) {
    return {equilibrium.grips, equilibrium.places, equilibrium.tangent.stiffness()};
}

void correct_check(const Deformer& deformer, const Eigen::VectorXd& values, const GripsInPlace& grips,
                   Deformer::Answer& answer, Control& control) {
    if (grips.grips.empty() || !answer.check || answer.check->reaction_error.forces.cols() == 0) return;
    try {
        correct(*answer.check, deformer, values, grips, answer, control);
    } catch (const SolveError&) {
        answer.check.reset();
    }
}

}  // namespace elastolab
