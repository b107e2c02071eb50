#include "scene/live/model_keeper.hpp"

#include <utility>

#include "methods/precompute.hpp"

namespace elastolab {

namespace {

bool same(const Method& a, const Method& b) {
    return same_answers(a, b) && a.mode == b.mode && a.update == b.update && a.hierarchical_from == b.hierarchical_from;
}

void drop(ModelJob& job) {
    job.cancel();
    job.poll();
}

}  // namespace

bool same_answers(const Method& a, const Method& b) {
    return a.kind == b.kind && a.tractions == b.tractions && a.elements == b.elements && a.growth == b.growth &&
           a.rims == b.rims && a.integral_tolerance == b.integral_tolerance;
}

void ModelKeeper::ask(const Body& body, const Method& method) {
    const bool same_surface = body.surface == body_.surface;
    if (asked_ && same_surface && body.material == body_.material && same(method, method_)) return;
    if (!same_surface) {  // nothing that is there can be shown on it
        model_.reset();
        completed_ = false;
    }
    body_ = body;
    method_ = method;
    asked_ = true;
    begin();
}

void ModelKeeper::clear() {
    // Called every frame while a method cannot take the body: what was cancelled is let go as soon as it has ended.
    drop(precompute_);
    drop(completion_);
    body_ = {};
    model_.reset();
    failure_.clear();
    asked_ = is_wanted_ = completed_ = false;
}

/// An inverse that was completed serves every choice but the mode and Poisson's ratio: it is kept, not computed twice.
Method ModelKeeper::method_to_compute() const {
    Method method = method_;
    if (model_ && completed_ && method.mode == Mode::on_demand && method.kind == model_->method().kind &&
        body_.material.poisson_ratio == model_->body().material.poisson_ratio)
        method.mode = model_->method().mode;
    return method;
}

void ModelKeeper::begin() {
    failure_.clear();
    completion_.cancel();
    completion_tried_.reset();
    is_wanted_ = false;
    precompute_.start([before = model_, body = body_, method = method_to_compute()](Control& control) {
        return before ? precompute_again(*before, body.material, method, control) : precompute(body, method, control);
    });
}

bool ModelKeeper::may_complete(Update update) const {
    if (!is_wanted() || completion_tried_ == update || precompute_.running()) return false;
    const MethodKind kind = model_->method().kind;
    if (!kind->full_serves_sets || !has(kind, Mode::full) || !has(kind, update)) return false;
    return !has_inverse() || model_->method().update != update;
}

void ModelKeeper::complete(Update update) {
    if (!may_complete(update)) return;
    completion_tried_ = update;
    Method method = model_->method();
    method.mode = Mode::full;
    method.update = update;
    completion_.start([before = model_, method](Control& control) {
        return precompute_again(*before, before->body().material, method, control);
    });
}

void ModelKeeper::postpone_completion() {
    if (!completion_.running()) return;
    completion_.cancel();
    completion_tried_.reset();
}

bool ModelKeeper::poll() {
    const Model* before = model_.get();
    switch (precompute_.poll()) {
        case JobEvent::finished:
            take(precompute_.take());
            break;
        case JobEvent::failed:
            failure_ = precompute_.failure();
            break;
        case JobEvent::cancelled:
        case JobEvent::none:
            break;
    }
    // A completion that fails, for want of memory, costs nothing: the model at hand answers as before.
    if (completion_.poll() == JobEvent::finished)
        if (std::shared_ptr<const Model> model = completion_.take(); is_wanted_) take(std::move(model));
    return model_.get() != before;
}

void ModelKeeper::take(std::shared_ptr<const Model> model) {
    model_ = std::move(model);
    is_wanted_ = true;
    completed_ = model_->method().mode != method_.mode;
}

void ModelKeeper::cancel() {
    precompute_.cancel();
    completion_.cancel();
}

void ModelKeeper::retry() {
    failure_.clear();
    if (!is_wanted_ && asked_ && !precompute_.running()) begin();
}

}  // namespace elastolab
