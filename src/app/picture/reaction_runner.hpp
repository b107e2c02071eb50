#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "scene/live/background_job.hpp"
#include "scene/live/method_runner.hpp"

namespace elastolab {

/// Reactions of one method's answer, for forces, tractions and stresses that are shown: computed once for each answer,
/// on a worker where a solve takes longer than a frame can wait. The last ones stay until the next are there; of what
/// is only extrapolated there are none. Never throws for a motion without a solution. Owned by one thread.
class ReactionRunner {
public:
    /// `wake` is called by the worker when update() will find something.
    explicit ReactionRunner(std::function<void()> wake) : job_(std::move(wake)) {}

    /// Seconds that update() may solve itself, judged by the last time with the same constrained set; the first solve
    /// of a set is always the worker's.
    void set_solve_budget(double seconds) { solve_budget_ = seconds; }
    /// Takes over what the worker finished and begins what is due. Once per frame while reactions are shown.
    void update(const MethodRunner& runner);
    /// Reactions are not shown any more.
    void rest();

    /// The surface that the latest reactions are of; null when there are none.
    const SurfaceMesh* surface() const { return latest_.surface.get(); }
    /// Its constrained vertices, the fixed set first, and the reactions there.
    const std::vector<int>& vertices() const { return latest_.vertices; }
    const Reactions& reactions() const { return latest_.reactions; }
    /// Grows whenever these change.
    std::uint64_t revision() const { return revision_; }
    /// Why the present answer has none, for the user; empty when it has or will have.
    const std::string& failure() const { return failure_; }

    bool running() const { return job_.running(); }
    void cancel() { job_.cancel(); }
    bool working() const { return job_.working(); }

private:
    struct Result {
        std::shared_ptr<const SurfaceMesh> surface;
        std::vector<int> vertices;
        Reactions reactions;
        double seconds = 0.0;  ///< that the solve took
    };
    static Result solve(const Deformer& deformer, const Eigen::VectorXd& values, Control& control);
    void take(Result result);
    void fail(std::string why);
    void poll();
    void forget();

    // The answer whose reactions were asked for last.
    std::weak_ptr<const Deformer> deformer_;
    std::uint64_t version_ = 0;

    double solve_budget_ = 0.005, solve_seconds_ = 0.0;  ///< of deformer_
    Result latest_;
    std::string failure_;
    std::uint64_t revision_ = 0;
    BackgroundJob<Result> job_;
};

}  // namespace elastolab
