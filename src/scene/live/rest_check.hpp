#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "base/timer.hpp"
#include "deform/deformer.hpp"
#include "deform/finding.hpp"
#include "deform/grip_check.hpp"
#include "scene/live/background_job.hpp"

namespace elastolab {

/// Estimates in the background how far an answer can be trusted, once it has rested for a while: its residual, and what
/// the coarseness of the mesh does. All members are for one thread.
class RestCheck {
public:
    /// `wake` is called by the worker when poll() will find something.
    explicit RestCheck(std::function<void()> wake) : job_(std::move(wake)) {}

    /// The answer has changed: what was found of the previous one is forgotten.
    void restart();
    /// Takes over what was found. Once per frame.
    void poll();
    /// Whether the answer has rested long enough and was not checked yet.
    bool due() const { return !begun_ && !job_.running() && rest_.seconds() >= kRestSeconds; }
    /// `values`: 3*n_handle_vertices [L], those of the answer, as Deformer::displace takes them.
    /// start: the equilibrium that the answer is, of a method that is not linear. grips: its handles under a force.
    void begin(const std::shared_ptr<const Deformer>& deformer, const Eigen::VectorXd& values,
               const std::shared_ptr<const Equilibrium>& start, GripsInPlace grips);
    /// Whether nothing more will be found of this answer.
    bool done() const { return begun_ && !job_.running(); }
    /// What the person should know before believing the answer.
    const Findings& findings() const { return findings_; }

    void cancel() { job_.cancel(); }
    bool working() const { return job_.working(); }

private:
    static constexpr double kRestSeconds = 0.7;
    Stopwatch rest_;  ///< since the answer changed
    bool begun_ = false;
    Findings findings_;
    BackgroundJob<Findings> job_;
};

}  // namespace elastolab
