#include "scene/live/rest_check.hpp"

#include "base/memory.hpp"
#include "deform/grip_check.hpp"
#include "findings/solution.hpp"

namespace elastolab {

namespace {

/// An answer that has rested this long is worth checking.
constexpr double kRestSeconds = 0.7;

/// The second answer of a check may take many times what is held.
struct MemoryReturn {
    ~MemoryReturn() { return_freed_memory(); }
};

/// By methods that are not linear handles under a force are judged as if they were moved.
void correct_for(const std::vector<Grip>& grips, const GripStiffness* made, const Deformer& deformer,
                 const Eigen::VectorXd& values, Deformer::Answer& answer, Control& control) {
    if (grips.empty() || !deformer.linear()) return;
    const bool is_made = made != nullptr && made->grips() == grips;
    correct_check(deformer, values, in_place(is_made ? *made : GripStiffness(deformer, values, grips, control)), answer,
                  control);
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
        const MemoryReturn when_done_or_cancelled;
        Deformer::Answer answer = deformer->answer(values, {.residual = true, .check = true}, control);
        correct_for(grips, stiffness.get(), *deformer, values, answer, control);
        return findings_of_answer(*deformer, answer);
    });
}

}  // namespace elastolab
