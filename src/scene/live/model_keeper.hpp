#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "deform/model.hpp"
#include "scene/live/background_job.hpp"

namespace elastolab {

using ModelJob = BackgroundJob<std::shared_ptr<const Model>>;

/// Whether models of the same body by these differ in speed and memory alone, as by their mode.
bool same_answers(const Method& a, const Method& b);

/// Keeps the model of one body under one method, precomputed on a worker thread, and completes it by K and its inverse
/// when there is time. The last complete model stays until the next one is there. All members are for one thread.
class ModelKeeper {
public:
    /// `wake` is called by the workers when poll() will find something.
    explicit ModelKeeper(const std::function<void()>& wake) : precompute_(wake), completion_(wake) {}

    /// Asks for this body and method; a running precomputation of something else is cancelled. Nothing happens when
    /// it is the present one. Takes over from the model at hand what does not change.
    void ask(const Body& body, const Method& method);
    /// Forgets the body and the model. May be called again and again: that is how its workers come to rest.
    void clear();
    /// Takes over what the workers finished; true when model() has changed.
    bool poll();

    const Body& body() const { return body_; }  ///< last asked for
    const Method& method() const { return method_; }
    bool asked() const { return asked_; }
    const std::shared_ptr<const Model>& model() const { return model_; }  ///< null before the first
    bool is_wanted() const { return model_ && is_wanted_; }               ///< model() is of body() and method()
    bool has_inverse() const { return model_ && model_->method().mode != Mode::on_demand; }

    /// Computes K and its inverse for the present model (Mode::full) in the background; `update` is the rule by which
    /// it then answers. The present model answers until then.
    void complete(Update update);
    bool may_complete(Update update) const;  ///< whether complete() would do anything
    /// Stops the completion, which gives the processor to what is waited for; complete() starts it anew.
    void postpone_completion();

    void cancel();
    void retry();
    bool precomputing() const { return precompute_.running(); }
    bool completing() const { return completion_.running(); }
    bool working() const { return precompute_.working() || completion_.working(); }
    JobStatus precompute_status() const { return precompute_.status(); }
    JobStatus completion_status() const { return completion_.status(); }
    /// Why there is no model of body() and method(); empty when there is one or will be.
    const std::string& failure() const { return failure_; }

private:
    Method method_to_compute() const;
    void begin();
    void take(std::shared_ptr<const Model> model);

    Body body_;
    Method method_;
    bool asked_ = false, is_wanted_ = false;
    bool completed_ = false;  ///< model_ holds an inverse that nobody asked for
    std::optional<Update> completion_tried_;
    std::string failure_;
    std::shared_ptr<const Model> model_;
    // Last: their threads end before what they wake is destroyed.
    ModelJob precompute_, completion_;
};

}  // namespace elastolab
