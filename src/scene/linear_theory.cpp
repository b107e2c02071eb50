#include "scene/linear_theory.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"

namespace elastolab {

namespace {

/// Ten nodes up to so many vertices of the surface; beyond, four take less and tell as much.
constexpr int kTenNodes = 300;

Method finite_method(const SurfaceMesh& surface) {
    Method method{.kind = large_deformation_method()};
    method.elements = surface.n_vertices() <= kTenNodes ? ElementDegree::quadratic : ElementDegree::linear;
    return method;
}

/// Steps on the way from one of the values to the next, which are a quarter turn apart at most. A whole turn of a beam
/// takes 35 altogether; where loads crush a body, steps would go on and on.
constexpr int kMostSteps = 40;

double largest(const Eigen::VectorXd& u) {
    return u.size() == 0 ? 0.0 : u.reshaped(3, u.size() / 3).colwise().norm().maxCoeff();
}

}  // namespace

LinearTheoryGauge::LinearTheoryGauge(Body body, ConstrainedSet set, Control& control) {
    const double largest_ratio = large_deformation_method()->largest_poisson_ratio;
    body.material.poisson_ratio = std::min(body.material.poisson_ratio, largest_ratio);
    const Method method = finite_method(*body.surface);
    auto deformer = std::make_unique<Deformer>(precompute(body, method, control));
    deformer->constrain(std::move(set), control);
    deformer_ = std::move(deformer);
}

std::optional<double> LinearTheoryGauge::error(const Eigen::VectorXd& values, Control& control,
                                               const Approach& approach) const {
    constexpr double kTolerance = 1e-4;
    if (values.isZero(0.0) && approach.path.cols() == 0) return {};  // no motion, and no full turns either
    // The tangent at rest is linear theory.
    const DragResponse rest =
        deformer_->drag_response(Eigen::VectorXd::Zero(values.size()), values, control, kTolerance);
    try {
        Approach bounded = approach;
        bounded.most_steps = std::min(approach.most_steps, kMostSteps);
        const Eigen::VectorXd finite = deformer_->displace(values, control, kTolerance, bounded);
        const double size = largest(finite);
        if (!(size > 0.0)) return {};
        return largest(finite - rest.X.col(0)) / size;
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
