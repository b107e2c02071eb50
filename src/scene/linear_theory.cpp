#include "scene/linear_theory.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "deform/grip_equilibrium.hpp"
#include "deform/patch_reactions.hpp"
#include "mesh/solids.hpp"
#include "mesh/triangles_across.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"

namespace elastolab {

namespace {

/// Ten nodes up to so many vertices of the surface; beyond, four take less and tell as much, but for thin bodies, which
/// they hold so stiff that hardly anything turns. Of those, ten take little.
constexpr int kTenNodes = 300;

Method finite_method(const SurfaceMesh& surface) {
    Method method{.kind = large_deformation_method()};
    const bool ten_nodes = surface.n_vertices() <= kTenNodes || triangles_across(surface) < kFewTrianglesAcross;
    method.elements = ten_nodes ? ElementDegree::quadratic : ElementDegree::linear;
    return method;
}

/// Steps on the way from one of the values to the next, which are a quarter turn apart at most. A whole turn of a beam
/// takes 35 altogether; where loads crush a body, steps would go on and on.
constexpr int kMostSteps = 40;

/// Of the answers that are compared.
constexpr double kTolerance = 1e-4;
/// Part of all values and forces that is small enough for linear theory to hold to a thousandth of its error, and large
/// enough to be solved for.
constexpr double kSmallPart = 1e-3;

bool is_stable(const Equilibrium& found) {
    return std::ranges::all_of(found.solids, [](const auto& solid) { return !solid || solid->facts().stable; });
}

/// Each is filled with tetrahedra by a process of its own, which takes some hundredths of a second.
void require_few_solids(const SurfaceMesh& surface) {
    if (split_solids(surface).size() > kMostGaugedSolids)
        throw SolveError("linear theory is not gauged for so many solids. Delete those that do not move.");
}

double largest(const Eigen::VectorXd& u) {
    return u.size() == 0 ? 0.0 : u.reshaped(3, u.size() / 3).colwise().norm().maxCoeff();
}

}  // namespace

HandleForces in_proportion(HandleForces by_force, double moved, const SurfaceMesh& surface) {
    return moved < size_of(surface) ? std::move(by_force) : HandleForces{};
}

LinearTheoryGauge::LinearTheoryGauge(Body body, ConstrainedSet set, Control& control) {
    require_few_solids(*body.surface);
    const double largest_ratio = large_deformation_method()->largest_poisson_ratio;
    body.material.poisson_ratio = std::min(body.material.poisson_ratio, largest_ratio);
    const Method method = finite_method(*body.surface);
    auto deformer = std::make_unique<Deformer>(precompute(body, method, control));
    deformer->constrain(std::move(set), control);
    deformer_ = std::move(deformer);
}

/// The answer to so much of the values and forces.
LinearTheoryGauge::Finite LinearTheoryGauge::finite(double part, const Eigen::VectorXd& values, Control& control,
                                                    const Approach& approach, const HandleForces& by_force) const {
    if (by_force.grips.empty()) {
        DragResponse found =
            deformer_->drag_response(part * values, Eigen::MatrixXd(values.size(), 0), control, kTolerance, approach);
        return {std::move(found.rest), is_stable(*found.equilibrium)};
    }
    std::vector<GripForce> forces = by_force.forces;
    for (GripForce& force : forces) {
        force.force *= part;
        force.moment *= part;
    }
    const GripEquilibrium found =
        find_grip_equilibrium(*deformer_, part * values, by_force.grips, forces, control, approach);
    return {deformer_->displace(found.values, control, kTolerance, {found.equilibrium, {}})};
}

std::optional<double> LinearTheoryGauge::error(const Eigen::VectorXd& values, Control& control,
                                               const Approach& approach, const HandleForces& by_force) const {
    // No motion, and no full turns either.
    if (by_force.grips.empty() && values.isZero(0.0) && approach.path.cols() == 0) return {};
    Eigen::VectorXd linear;
    if (by_force.grips.empty())  // the tangent at rest is linear theory
        linear = deformer_->drag_response(Eigen::VectorXd::Zero(values.size()), values, control, kTolerance).X.col(0);
    else
        linear = finite(kSmallPart, values, control, {}, by_force).u / kSmallPart;
    try {
        Approach bounded = approach;
        bounded.most_steps = std::min(approach.most_steps, kMostSteps);
        const Finite whole = finite(1.0, values, control, bounded, by_force);
        const double size = largest(whole.u);
        if (!(size > 0.0)) return {};
        const double error = largest(whole.u - linear) / size;
        // A body that would buckle is where linear theory has it until the least push.
        return whole.stable || error >= kSilentLinearTheory ? error : std::numeric_limits<double>::infinity();
    } catch (const NoEquilibriumError&) {
        return std::numeric_limits<double>::infinity();
    }
}

bool is_too_incompressible_for_turns(double poisson_ratio) {
    return poisson_ratio > large_deformation_method()->largest_poisson_ratio;
}

Findings findings_of_linear_theory(MethodKind method, double error, double poisson_ratio) {
    if (!(error >= kSilentLinearTheory)) return {};
    return {{.kind = FindingKind::linear_theory,
             .value = error,
             .method = method,
             .first = is_too_incompressible_for_turns(poisson_ratio) ? 1 : 0}};
}

}  // namespace elastolab
