#include "scene/live/rest_check.hpp"

#include "findings/solution.hpp"

namespace elastolab {

namespace {

/// An answer that has rested this long is worth checking.
constexpr double kRestSeconds = 0.7;
Findings findings_at_rest(const Deformer& deformer, const Eigen::VectorXd& values, Control& control) {
    return findings_of_answer(deformer, deformer.answer(values, {.residual = true, .check = true}, control));
}

}  // namespace

void RestCheck::restart() {
    job_.cancel();
    findings_.clear();
    begun_ = false;
    rest_ = {};
}

void RestCheck::poll() {
    if (job_.poll() == JobEvent::finished) findings_ = job_.take();
}

void RestCheck::begin_at_rest(const std::shared_ptr<const Deformer>& deformer, const Eigen::VectorXd& values) {
    if (begun_ || job_.running() || rest_.seconds() < kRestSeconds) return;
    begun_ = true;
    job_.start([deformer, values](Control& control) { return findings_at_rest(*deformer, values, control); });
}

}  // namespace elastolab
