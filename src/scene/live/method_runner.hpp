#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "scene/live/background_job.hpp"
#include "scene/live/drag_solver.hpp"
#include "scene/live/rest_check.hpp"
#include "scene/setup.hpp"

namespace elastolab {

/// How a frame gets its displacements.
enum class FrameRule {
    drag_columns,  ///< three columns of the moving handle, computed when it is grabbed
    displace       ///< the method's update rule, every frame
};

/// One method's answer to a scene that is being edited: precomputes on a worker thread, prepares changed constrained
/// sets on another, and gives the displacements of every frame at once. The last complete answer stays until the next
/// one is there. All members are for one thread, which calls poll() once per frame.
class MethodRunner {
public:
    enum class State {
        idle,          ///< no body yet, or the precomputation was cancelled before there was any model
        precomputing,  ///< no model of this body, material and method yet
        preparing,     ///< the model is there; the constrained set, or a motion that takes long, is being prepared
        ready,         ///< displacements are those of the scene
        failed         ///< see failure(); the last complete answer stays
    };

    /// `wake` is called by the workers when poll() will find something.
    explicit MethodRunner(std::function<void()> wake);
    ~MethodRunner();

    /// Asks for this body and method; a running precomputation of something else is cancelled. Nothing happens when
    /// it is the present one. Takes over from the model at hand what does not change.
    void set_body(const Body& body, const Method& method);
    /// Forgets the body and all that belongs to it. May be called again and again: that is how its workers come to
    /// rest.
    void clear();
    /// Of the body last set; null before.
    const SurfaceMesh* surface() const { return body_.surface.get(); }
    /// Asks for the displacements under these constraints, which belong to the body last set.
    void set_constraints(const Constraints& constraints);
    void set_frame_rule(FrameRule rule);
    /// Seconds that poll() may solve for a new motion itself, judged by the last time; longer solves go to the worker,
    /// and the answer before stays meanwhile.
    void set_solve_budget(double seconds) { solve_budget_ = seconds; }
    /// Prepares a constrained set that may be asked for soon, when there is nothing else to do.
    void prefetch(const ConstrainedSet& set);
    /// Computes K and its inverse for the present model (Mode::full) in the background, when there is nothing else to
    /// do and it is not there yet; `update` is the rule by which it then answers. The present model answers until then.
    void complete(Update update);
    bool may_complete(Update update) const;  ///< whether complete() would do anything
    /// Stops the completion, which gives the processor to what is waited for; complete() starts it anew.
    void postpone_completion();

    /// Once the answer has rested for a while: estimates in the background how far it can be trusted (residual, and
    /// what the coarseness of the mesh does). What is found is in check_warnings() until the answer changes.
    void check_at_rest();
    bool unchecked() const { return state() == State::ready && has_motion() && !check_.done(); }
    const std::vector<std::string>& check_warnings() const { return check_.warnings(); }

    /// Takes over the models that the workers finished, and does nothing with them yet.
    void take_models();
    /// Takes over what the workers finished, starts what is due and brings the displacements up to date.
    void poll();

    /// Stops the precomputation, the completion or the preparation that runs. What is there stays; what was stopped
    /// begins again with retry() or with the next change.
    void cancel();
    void retry();
    bool stopping() const {
        return precompute_.working() || completion_.working() || prepare_.working() || check_.working();
    }

    State state() const;
    /// Why the present scene has no answer; empty when it has one or will have.
    const std::string& failure() const;
    /// 3*n_vertices [L]; zero until the first answer. version() grows with every change.
    const Eigen::VectorXd& displacement() const { return displacement_; }
    std::uint64_t version() const { return version_; }
    /// Whether displacement() is of the body last set (its vertices, at least) and not just zero.
    bool has_answer() const { return deformer_ != nullptr; }
    /// The model that answers now; null before the first.
    const std::shared_ptr<const Model>& model() const { return model_; }
    const Method& method() const { return method_; }
    /// What answers now (null before the first), for reactions and quality.
    const std::shared_ptr<const Deformer>& deformer() const { return deformer_; }
    const Eigen::VectorXd& values() const { return values_; }  ///< those that displacement() belongs to

    bool precomputing() const { return precompute_.running(); }
    bool preparing() const { return prepare_.running(); }
    bool completing() const { return completion_.running(); }
    bool has_inverse() const { return model_ && model_->method().mode != Mode::on_demand; }
    /// Of what runs now, what is waited for first.
    JobStatus status() const;
    /// Seconds that the last preparation of a constrained set took.
    double prepare_seconds() const { return prepare_.last_seconds(); }

private:
    /// A constrained set, and its drag solver when frames use one.
    struct Prepared {
        std::shared_ptr<const Deformer> deformer;
        std::optional<DragSolver> drag;
        double solve_seconds = 0.0;  ///< that the drag solver took
    };
    using PrepareJob = BackgroundJob<Prepared>;

    void forget_answers();
    void begin_precompute();
    void take_model(std::shared_ptr<const Model> model);
    void poll_preparation();
    bool set_is_current() const;
    Method method_to_compute() const;
    void use_or_prepare();
    void prepare(const ConstrainedSet& set, Eigen::VectorXd values, std::vector<int> ends);
    void prepare_prefetched(const ConstrainedSet& set);
    bool takes_long() const;
    void solve_on_worker();
    /// Whether the worker solves for a motion within the present set.
    bool solving() const { return prepare_.running() && set_is_current() && same_as_wanted(preparing_set_); }
    bool same_as_wanted(const ConstrainedSet& set) const;
    void update_displacement();
    void drag();
    void take_values();
    bool has_motion() const { return values_.size() > 0 && !values_.isZero(0.0); }

    Body body_;
    Method method_;
    bool body_wanted_ = false;      ///< set_body was called
    bool model_is_wanted_ = false;  ///< model_ is of body_ and method_ (possibly completed)
    bool completed_ = false;        ///< model_ holds an inverse that nobody asked for
    std::optional<Update> completion_tried_;
    ConstrainedSet wanted_set_;
    Eigen::VectorXd wanted_values_;
    std::vector<int> handle_ends_;
    FrameRule rule_ = FrameRule::drag_columns;
    std::optional<ConstrainedSet> prefetch_;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const Deformer> deformer_;
    Prepared spare_;  ///< of the same model: prefetched, or the one used before
    ConstrainedSet preparing_set_;
    // Each stands until its own stage succeeds or is asked for something else.
    std::string precompute_failure_;  ///< of body_ and method_
    std::string set_failure_;         ///< wanted_set_ cannot be prepared, or was stopped
    std::string displace_failure_;    ///< of values_

    std::optional<DragSolver> drag_;
    double solve_budget_ = 0.03, solve_seconds_ = 0.0;
    Eigen::VectorXd values_, displacement_;
    std::uint64_t version_ = 0;

    // Last: their threads end before what they wake goes.
    PrecomputeJob precompute_, completion_;
    PrepareJob prepare_;
    RestCheck check_;
};

}  // namespace elastolab
