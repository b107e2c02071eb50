#include "scene/live/rest_check.hpp"

#include <utility>

#include "base/memory.hpp"
#include "findings/solution.hpp"

namespace elastolab {

namespace {

/// The second answer of a check may take many times what is held.
struct MemoryReturn {
    ~MemoryReturn() { return_freed_memory(); }
};

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

void RestCheck::begin(const std::shared_ptr<const Deformer>& deformer, const Eigen::VectorXd& values,
                      const std::shared_ptr<const Equilibrium>& start, GripsInPlace grips) {
    begun_ = true;
    job_.start([deformer, values, start, grips = std::move(grips)](Control& control) {
        const MemoryReturn when_done_or_cancelled;
        Deformer::Answer answer =
            deformer->answer(values, {.residual = true, .check = true}, control, {.start = start});
        correct_check(*deformer, values, grips, answer, control);
        return findings_of_answer(*deformer, answer);
    });
}

}  // namespace elastolab
