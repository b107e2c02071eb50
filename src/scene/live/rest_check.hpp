#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "base/timer.hpp"
#include "deform/deformer.hpp"
#include "deform/finding.hpp"
#include "deform/grip.hpp"
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
    /// Begins when the answer has rested long enough and was not checked yet. `values`: 3*n_handle_vertices [L], those
    /// of the answer, as Deformer::displace takes them.
    /// grips: its handles under a force; stiffness: of grips, of these or not, or null.
    void begin_at_rest(const std::shared_ptr<const Deformer>& deformer, const Eigen::VectorXd& values,
                       const std::vector<Grip>& grips, const std::shared_ptr<const GripStiffness>& stiffness);
    /// Whether nothing more will be found of this answer.
    bool done() const { return begun_ && !job_.running(); }
    /// What the person should know before believing the answer.
    const Findings& findings() const { return findings_; }

    void cancel() { job_.cancel(); }
    bool working() const { return job_.working(); }

private:
    Stopwatch rest_;  ///< since the answer changed
    bool begun_ = false;
    Findings findings_;
    BackgroundJob<Findings> job_;
};

}  // namespace elastolab
