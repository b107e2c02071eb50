#include "scene/live/rest_check.hpp"

#include "base/text.hpp"

namespace elastolab {

namespace {

/// An answer that rests so long is worth checking.
constexpr double kRestSeconds = 0.7;
/// Relative residual from which on an answer is not what the equations say; rounding leaves 1e-10 at most.
constexpr double kWrongResidual = 1e-6;

std::vector<std::string> findings(const Deformer& deformer, const Eigen::VectorXd& values, Control& control) {
    std::vector<std::string> warnings;
    const auto check = deformer.discretisation_check(values, control);
    if (check && !check->warning.empty()) warnings.push_back(check->warning);
    if (const double residual = deformer.residual(values, control); !(residual < kWrongResidual))
        warnings.push_back(deformer.model().body().name + ": the solution leaves a relative residual of " +
                           readable_number(residual) + ", so it is wrong. Fix more vertices, or use another method.");
    return warnings;
}

}  // namespace

void RestCheck::restart() {
    job_.cancel();
    warnings_.clear();
    begun_ = false;
    rest_ = {};
}

void RestCheck::poll() {
    if (job_.poll() == JobEvent::finished) warnings_ = job_.take();
}

void RestCheck::begin_at_rest(const std::shared_ptr<const Deformer>& deformer, const Eigen::VectorXd& values) {
    if (begun_ || job_.running() || rest_.seconds() < kRestSeconds) return;
    begun_ = true;
    job_.start([deformer, values](Control& control) { return findings(*deformer, values, control); });
}

}  // namespace elastolab
