#include "app/picture/reaction_runner.hpp"

#include <utility>

#include "base/error.hpp"
#include "base/timer.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

ReactionRunner::Result ReactionRunner::solve(const Deformer& deformer, const Eigen::VectorXd& values,
                                             Control& control) {
    const Stopwatch watch;
    Result result;
    result.surface = deformer.model().body().surface;
    result.vertices = deformer.set().fixed;
    result.vertices.insert(result.vertices.end(), deformer.set().handles.begin(), deformer.set().handles.end());
    result.reactions = deformer.answer(values, {}, control).reactions;
    if (!result.reactions.forces.allFinite() || !result.reactions.moments.allFinite())
        throw SolveError(deformer.model().body().name +
                         ": the reactions are beyond double precision. Use a smaller motion or Young's modulus.");
    result.seconds = watch.seconds();
    return result;
}

void ReactionRunner::take(Result result) {
    latest_ = std::move(result);
    solve_seconds_ = latest_.seconds;
    failure_.clear();
    ++revision_;
}

void ReactionRunner::fail(std::string why) {
    latest_ = {};
    failure_ = std::move(why);
    ++revision_;
}

void ReactionRunner::forget() {
    if (latest_.surface) ++revision_;
    latest_ = {};
    failure_.clear();
}

void ReactionRunner::rest() {
    job_.cancel();
    job_.poll();  // lets go of what was cancelled, once it has ended
    forget();
    deformer_.reset();
}

void ReactionRunner::poll() {
    switch (job_.poll()) {
        case JobEvent::finished:
            take(job_.take());
            break;
        case JobEvent::failed:
            fail(job_.failure());
            break;
        case JobEvent::cancelled:
        case JobEvent::none:
            break;
    }
}

void ReactionRunner::update(const MethodRunner& runner) {
    poll();
    if (latest_.surface && latest_.surface.get() != runner.surface()) forget();
    if (runner.following()) return;
    if (runner.converging()) return;  // by the iteration that these need too, which keeps its solutions
    const std::shared_ptr<const Deformer>& deformer = runner.deformer();
    if (!deformer) return forget();  // what is known is of another that answered in its place
    if (runner.values().size() != deformer->set().n_values()) return;
    const bool same_set = deformer_.lock() == deformer;
    if (same_set && version_ == runner.version()) return;
    // A solve that runs is not stopped for the next motion: while a body is dragged none would ever end.
    if (job_.running() && same_set) return;
    deformer_ = deformer;
    version_ = runner.version();
    if (same_set && deformer->linear() && solve_seconds_ <= solve_budget_) {
        try {
            Control control;
            take(solve(*deformer, runner.values(), control));
        } catch (const std::exception& error) {
            fail(user_text(error));
        }
        return;
    }
    if (!same_set) solve_seconds_ = 2.0 * solve_budget_;  // not known yet
    job_.start([deformer, values = runner.values()](Control& control) {
        control.begin_stage("reactions");
        return solve(*deformer, values, control);
    });
}

}  // namespace elastolab
