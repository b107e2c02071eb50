#include "scene/live/rest_check.hpp"

#include "deform/grip_check.hpp"
#include "findings/solution.hpp"

namespace elastolab {

namespace {

/// An answer that has rested this long is worth checking.
constexpr double kRestSeconds = 0.7;

/// By methods that are not linear handles under a force are judged as if they were moved.
void correct_for(const std::vector<Grip>& grips, const GripStiffness* made, const Deformer& deformer,
                 const Eigen::VectorXd& values, Deformer::Answer& answer, Control& control) {
    if (grips.empty() || !deformer.linear()) return;
    const std::vector<GripPlace> at_rest(grips.size());
    if (made != nullptr && made->grips() == grips)
        return correct_check(deformer, values, {grips, at_rest, made->matrix()}, answer, control);
    const GripStiffness stiffness(deformer, values, grips, control);
    correct_check(deformer, values, {grips, at_rest, stiffness.matrix()}, answer, control);
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

void RestCheck::begin_at_rest(const std::shared_ptr<const Deformer>& deformer, const Eigen::VectorXd& values,
                              const std::vector<Grip>& grips, const std::shared_ptr<const GripStiffness>& stiffness) {
    if (begun_ || job_.running() || rest_.seconds() < kRestSeconds) return;
    begun_ = true;
    job_.start([deformer, values, grips, stiffness](Control& control) {
        Deformer::Answer answer = deformer->answer(values, {.residual = true, .check = true}, control);
        correct_for(grips, stiffness.get(), *deformer, values, answer, control);
        return findings_of_answer(*deformer, answer);
    });
}

}  // namespace elastolab
