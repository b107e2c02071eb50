#include "scene/live/method_runner.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"

namespace elastolab {

namespace {

bool same(const Material& a, const Material& b) {
    return a.young_modulus == b.young_modulus && a.poisson_ratio == b.poisson_ratio;
}

bool same(const Method& a, const Method& b) {
    return a.kind == b.kind && a.mode == b.mode && a.tractions == b.tractions && a.update == b.update &&
           a.integral_tolerance == b.integral_tolerance && a.keep_integrals == b.keep_integrals;
}

bool same(const ConstrainedSet& a, const ConstrainedSet& b) { return a.base == b.base && a.handles == b.handles; }

template <class Result>
void drop(BackgroundJob<Result>& job) {
    job.cancel();
    job.poll();
}

std::vector<int> handle_ends(const Constraints& constraints) {
    std::vector<int> ends;
    const auto n_base = static_cast<int>(constraints.set.base.size());
    for (const ConstraintGroup& group : constraints.groups)
        if (group.end > n_base) ends.push_back(group.end - n_base);
    return ends;
}

}  // namespace

MethodRunner::MethodRunner(std::function<void()> wake)
    : precompute_(wake), completion_(wake), prepare_(wake), check_(wake) {}
MethodRunner::~MethodRunner() = default;

void MethodRunner::set_body(const Body& body, const Method& method) {
    const bool same_surface = body.surface == body_.surface;
    if (body_wanted_ && same_surface && same(body.material, body_.material) && same(method, method_)) return;
    if (!same_surface) forget_answers();
    body_ = body;
    method_ = method;
    body_wanted_ = true;
    begin_precompute();
}

void MethodRunner::clear() {
    // Called every frame while a method cannot take the body: what was cancelled is let go as soon as it has ended.
    drop(precompute_);
    drop(completion_);
    drop(prepare_);
    check_.cancel();
    check_.poll();
    if (!body_wanted_) return;
    forget_answers();
    body_ = {};
    precompute_failure_.clear();
    body_wanted_ = model_is_wanted_ = false;
}

/// A new mesh: nothing that is there can be shown on it.
void MethodRunner::forget_answers() {
    model_.reset();
    deformer_.reset();
    spare_ = {};
    drag_.reset();
    displacement_.resize(0);
    set_failure_.clear();
    displace_failure_.clear();
    completed_ = false;
    ++version_;
}

/// An inverse that was completed serves every choice but the mode and Poisson's ratio: it is kept, not computed twice.
Method MethodRunner::method_to_compute() const {
    Method method = method_;
    if (model_ && completed_ && method.mode == Mode::on_demand && method.kind == model_->method().kind &&
        body_.material.poisson_ratio == model_->body().material.poisson_ratio)
        method.mode = model_->method().mode;
    return method;
}

void MethodRunner::begin_precompute() {
    precompute_failure_.clear();
    completion_.cancel();
    completion_tried_.reset();
    model_is_wanted_ = false;
    precompute_.start([before = model_, body = body_, method = method_to_compute()](Control& control) {
        return before ? precompute_again(*before, body.material, method, control) : precompute(body, method, control);
    });
}

void MethodRunner::set_constraints(const Constraints& constraints) {
    if (!same(constraints.set, wanted_set_)) {
        wanted_set_ = constraints.set;
        set_failure_.clear();
    }
    handle_ends_ = handle_ends(constraints);
    wanted_values_ = constraints.values;
}

void MethodRunner::set_frame_rule(FrameRule rule) {
    if (rule == rule_) return;
    rule_ = rule;
    drag_.reset();
    spare_.drag.reset();
    values_.resize(0);
}

void MethodRunner::prefetch(const ConstrainedSet& set) { prefetch_ = set; }

bool MethodRunner::may_complete(Update update) const {
    if (!model_ || !model_is_wanted_ || completion_tried_ == update || precompute_.running()) return false;
    return !has_inverse() || model_->method().update != update;
}

void MethodRunner::complete(Update update) {
    if (!may_complete(update)) return;
    completion_tried_ = update;
    Method method = model_->method();
    method.mode = Mode::full;
    method.update = update;
    completion_.start([before = model_, method](Control& control) {
        return precompute_again(*before, before->body().material, method, control);
    });
}

void MethodRunner::postpone_completion() {
    if (!completion_.running()) return;
    completion_.cancel();
    completion_tried_.reset();
}

void MethodRunner::poll() {
    take_models();
    poll_preparation();
    if (model_) use_or_prepare();
    // A model of an earlier material or mode answers until the next one is prepared.
    if (deformer_ && same(deformer_->set(), wanted_set_)) update_displacement();
}

void MethodRunner::take_models() {
    switch (precompute_.poll()) {
        case JobEvent::finished:
            take_model(precompute_.take());
            break;
        case JobEvent::failed:
            precompute_failure_ = precompute_.failure();
            break;
        case JobEvent::cancelled:
        case JobEvent::none:
            break;
    }
    // A completion that fails, for want of memory, costs nothing: the model at hand answers as before.
    if (completion_.poll() == JobEvent::finished)
        if (std::shared_ptr<const Model> model = completion_.take(); model_is_wanted_) take_model(std::move(model));
}

void MethodRunner::take_model(std::shared_ptr<const Model> model) {
    model_ = std::move(model);
    model_is_wanted_ = true;
    completed_ = model_->method().mode != method_.mode;
    set_failure_.clear();
    spare_ = {};
    prepare_.cancel();
}

void MethodRunner::poll_preparation() {
    switch (prepare_.poll()) {
        case JobEvent::finished: {
            Prepared prepared = prepare_.take();
            if (prepared.deformer == deformer_) {
                drag_ = std::move(prepared.drag);
                solve_seconds_ = prepared.solve_seconds;
            } else if (&prepared.deformer->model() == model_.get()) {
                spare_ = std::move(prepared);
            }
            break;
        }
        case JobEvent::failed:
            if (!same_as_wanted(preparing_set_)) break;  // a prefetch: nobody asked for it yet
            if (set_is_current()) {
                displace_failure_ = prepare_.failure();
                drag_.reset();
                take_values();
            } else {
                set_failure_ = prepare_.failure();
            }
            break;
        case JobEvent::cancelled:
        case JobEvent::none:
            break;
    }
}

bool MethodRunner::same_as_wanted(const ConstrainedSet& set) const { return same(set, wanted_set_); }

bool MethodRunner::set_is_current() const {
    return deformer_ && &deformer_->model() == model_.get() && same(deformer_->set(), wanted_set_);
}

void MethodRunner::use_or_prepare() {
    if (!set_is_current() && spare_.deformer && same(spare_.deformer->set(), wanted_set_)) {
        const bool keep = deformer_ && &deformer_->model() == model_.get();
        std::swap(deformer_, spare_.deformer);
        drag_ = std::exchange(spare_.drag, std::nullopt);
        std::swap(solve_seconds_, spare_.solve_seconds);
        if (!keep) spare_ = {};
        values_.resize(0);
        set_failure_.clear();
    }
    if (!set_is_current()) {
        if (set_failure_.empty() && !(prepare_.running() && same(preparing_set_, wanted_set_)))
            prepare(wanted_set_, wanted_values_, handle_ends_);
    } else if (prefetch_ && !prepare_.running()) {
        if (!same(*prefetch_, wanted_set_) && !(spare_.deformer && same(spare_.deformer->set(), *prefetch_)))
            prepare_prefetched(*prefetch_);
        prefetch_.reset();
    }
}

/// What is prefetched is mostly one more handle, that rests until it is pulled.
void MethodRunner::prepare_prefetched(const ConstrainedSet& set) {
    const auto n = static_cast<int>(set.handles.size());
    std::vector<int> ends = handle_ends_;
    while (!ends.empty() && ends.back() >= n) ends.pop_back();
    if (n > 0) ends.push_back(n);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * n);
    const Eigen::Index n_known = std::min(values.size(), wanted_values_.size());
    values.head(n_known) = wanted_values_.head(n_known);
    prepare(set, std::move(values), std::move(ends));
}

/// Whoever watches does not solve: where no columns are kept, a grab would integrate and take seconds.
void MethodRunner::prepare(const ConstrainedSet& set, Eigen::VectorXd values, std::vector<int> ends) {
    preparing_set_ = set;
    const bool drags = rule_ == FrameRule::drag_columns;
    prepare_.start([model = model_, set, drags, values = std::move(values), ends = std::move(ends)](Control& control) {
        auto deformer = std::make_shared<Deformer>(model);
        control.begin_stage("constrain");
        deformer->constrain(set, control);
        control.checkpoint();
        Prepared prepared{std::move(deformer), std::nullopt};
        if (!drags) return prepared;
        control.begin_stage("solve");
        const Stopwatch watch;
        try {
            DragSolver drag(prepared.deformer, ends);
            drag.prepare(values);
            prepared.drag = std::move(drag);
        } catch (const SolveError&) {
            // Whether values without a solution are wanted then, and who is told, is for the frame.
        }
        prepared.solve_seconds = watch.seconds();
        return prepared;
    });
}

bool MethodRunner::takes_long() const {
    return rule_ == FrameRule::drag_columns && solve_seconds_ > solve_budget_ && !(drag_ && drag_->has(wanted_values_));
}

/// The motion goes on meanwhile: the columns that the worker brings serve what comes of it then.
void MethodRunner::solve_on_worker() {
    if (!set_is_current() || solving()) return;
    preparing_set_ = wanted_set_;
    displace_failure_.clear();
    DragSolver drag = drag_ ? *drag_ : DragSolver(deformer_, handle_ends_);
    prepare_.start([deformer = deformer_, drag = std::move(drag), values = wanted_values_](Control& control) mutable {
        control.begin_stage("solve");
        const Stopwatch watch;
        drag.prepare(values);
        return Prepared{deformer, std::move(drag), watch.seconds()};
    });
}

void MethodRunner::update_displacement() {
    if (values_.size() == wanted_values_.size() && values_ == wanted_values_ && displacement_.size() > 0) return;
    if (takes_long()) return solve_on_worker();
    try {
        if (rule_ == FrameRule::drag_columns)
            drag();
        else
            displacement_ = deformer_->displace(wanted_values_);
        displace_failure_.clear();
    } catch (const std::exception& error) {
        displace_failure_ = user_text(error);
        drag_.reset();
    }
    take_values();
}

void MethodRunner::drag() {
    if (!drag_) drag_.emplace(deformer_, handle_ends_);
    const bool solves = !drag_->has(wanted_values_);
    const Stopwatch watch;
    drag_->displace(wanted_values_, displacement_);
    if (solves) solve_seconds_ = watch.seconds();
}

void MethodRunner::take_values() {
    values_ = wanted_values_;
    ++version_;
    check_.restart();
}

void MethodRunner::check_at_rest() {
    check_.poll();
    if (unchecked()) check_.begin_at_rest(deformer_, values_);
}

void MethodRunner::cancel() {
    check_.cancel();
    precompute_.cancel();
    completion_.cancel();
    if (!prepare_.running()) return;
    prepare_.cancel();
    if (!same_as_wanted(preparing_set_)) return;  // a prefetch
    if (set_is_current()) {
        displace_failure_ = "The answer to this motion was stopped. Retry, or pull on.";
        take_values();
    } else {
        set_failure_ = "The preparation of this constrained set was stopped. Retry, or change the set.";
    }
}

void MethodRunner::retry() {
    precompute_failure_.clear();
    set_failure_.clear();
    if (!displace_failure_.empty()) values_.resize(0);
    displace_failure_.clear();
    if (!model_is_wanted_ && body_wanted_ && !precompute_.running()) begin_precompute();
}

const std::string& MethodRunner::failure() const {
    static const std::string none;
    if (!precompute_failure_.empty()) return precompute_failure_;
    if (!set_failure_.empty()) return set_failure_;
    return set_is_current() ? displace_failure_ : none;
}

MethodRunner::State MethodRunner::state() const {
    if (precompute_.running()) return State::precomputing;
    if (!failure().empty()) return State::failed;
    if (!model_ || !model_is_wanted_) return State::idle;
    return set_is_current() && !solving() ? State::ready : State::preparing;
}

JobStatus MethodRunner::status() const {
    if (precompute_.running()) return precompute_.status();
    return completion_.running() && state() != State::preparing ? completion_.status() : prepare_.status();
}

}  // namespace elastolab
