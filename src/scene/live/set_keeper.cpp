#include "scene/live/set_keeper.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "findings/solution.hpp"

namespace elastolab {

namespace {

bool same(const ConstrainedSet& a, const ConstrainedSet& b) { return a.base == b.base && a.handles == b.handles; }

/// Where the vertices of each handle end in the list of all handles' vertices.
std::vector<int> ends_of_handles(const Constraints& constraints) {
    std::vector<int> ends;
    const auto n_base = static_cast<int>(constraints.set.base.size());
    for (const ConstraintGroup& group : constraints.groups)
        if (group.end > n_base) ends.push_back(group.end - n_base);
    return ends;
}

double first_tolerance(const Deformer& deformer) { return deformer.iterates() ? kFirstTolerance : kSolveTolerance; }

/// Where no columns are kept, a grab would integrate and take seconds: the worker solves, not the watcher.
void solve_ahead(PreparedSet& prepared, const std::vector<int>& ends, const Eigen::VectorXd& values, Control& control) {
    const Stopwatch watch;
    try {
        DragSolver drag(prepared.deformer, ends);
        drag.prepare(values, first_tolerance(*prepared.deformer), control);
        prepared.drag = std::move(drag);
    } catch (const SolveError&) {
        // These values have no solution; the frame that asks for them says so, if they are still wanted then.
    }
    prepared.solve_seconds = watch.seconds();
}

/// The same for frames that update as a whole.
void update_ahead(PreparedSet& prepared, const Eigen::VectorXd& values, Control& control) {
    const Stopwatch watch;
    try {
        prepared.whole = {values, prepared.deformer->displace(values, control)};
    } catch (const SolveError&) {
    }
    prepared.solve_seconds = watch.seconds();
}

}  // namespace

void SetKeeper::want(const Constraints& constraints) {
    if (!same(constraints.set, wanted_set_)) {
        wanted_set_ = constraints.set;
        failure_.clear();
    }
    handle_ends_ = ends_of_handles(constraints);
    if (wanted_values_.size() != constraints.values.size() || wanted_values_ != constraints.values) may_refine_ = true;
    wanted_values_ = constraints.values;
}

bool SetKeeper::set_frame_rule(FrameRule rule) {
    if (rule == rule_) return false;
    rule_ = rule;
    for (PreparedSet* set : {&current_, &spare_}) {
        set->drag.reset();
        set->whole.reset();
        set->solve_seconds = PreparedSet{}.solve_seconds;  // a solve by the other rule takes another time
    }
    return true;
}

void SetKeeper::set_model(std::shared_ptr<const Model> model) {
    model_ = std::move(model);
    failure_.clear();
    spare_ = {};
    job_.cancel();
}

void SetKeeper::clear() {
    job_.cancel();
    job_.poll();
    model_.reset();
    prefetch_.reset();  // of another body
    current_ = {};
    spare_ = {};
    failure_.clear();
    motion_failure_.clear();
}

bool SetKeeper::same_as_wanted(const ConstrainedSet& set) const { return same(set, wanted_set_); }

bool SetKeeper::answers() const { return current_.deformer && same_as_wanted(current_.deformer->set()); }

bool SetKeeper::is_current() const { return answers() && &current_.deformer->model() == model_.get(); }

SetKeeper::Event SetKeeper::poll() {
    const Event event = take_finished();
    const Event used = model_ ? use_or_prepare() : Event::none;
    return used != Event::none ? used : event;
}

SetKeeper::Event SetKeeper::take_finished() {
    switch (job_.poll()) {
        case JobEvent::finished: {
            PreparedSet prepared = job_.take();
            if (prepared.deformer == current_.deformer && refining_) {
                current_.drag = std::move(prepared.drag);
                return Event::refined;
            }
            if (prepared.deformer == current_.deformer) {
                current_.drag = std::move(prepared.drag);
                current_.whole = std::move(prepared.whole);
                current_.solve_seconds = prepared.solve_seconds;
                return Event::motion_solved;
            }
            if (&prepared.deformer->model() == model_.get()) spare_ = std::move(prepared);
            return Event::none;
        }
        case JobEvent::failed:
            return take_failure();
        case JobEvent::cancelled:
        case JobEvent::none:
            break;
    }
    return Event::none;
}

SetKeeper::Event SetKeeper::take_failure() {
    if (!same_as_wanted(preparing_set_)) return Event::none;  // a prefetch: nobody asked for it yet
    if (!is_current()) {
        failure_ = job_.failure();
        return Event::none;
    }
    if (refining_) may_refine_ = false;
    if (solving_values_ != wanted_values_) return Event::none;  // the motion went on: that is tried next
    motion_failure_ = job_.failure();
    current_.drag.reset();
    return Event::motion_failed;
}

SetKeeper::Event SetKeeper::use_or_prepare() {
    Event event = Event::none;
    if (!is_current() && spare_.deformer && same_as_wanted(spare_.deformer->set())) {
        const bool keep = current_.deformer && &current_.deformer->model() == model_.get();
        std::swap(current_, spare_);
        spare_.drag.reset();
        if (!keep) spare_ = {};
        failure_.clear();
        event = Event::another_set;
    }
    if (!is_current()) {
        if (failure_.empty() && !(job_.running() && same_as_wanted(preparing_set_)))
            prepare(wanted_set_, wanted_values_, handle_ends_);
    } else if (may_refine_ && !job_.running() && current_.drag && current_.drag->tolerance() > kSolveTolerance) {
        refine_on_worker();
    } else if (prefetch_ && !job_.running()) {
        if (!same_as_wanted(*prefetch_) && !(spare_.deformer && same(spare_.deformer->set(), *prefetch_)))
            prepare_prefetched(*prefetch_);
        prefetch_.reset();
    }
    return event;
}

/// A prefetched set mostly has one more handle, at rest until it is pulled.
void SetKeeper::prepare_prefetched(const ConstrainedSet& set) {
    const auto n = static_cast<int>(set.handles.size());
    std::vector<int> ends = handle_ends_;
    while (!ends.empty() && ends.back() >= n) ends.pop_back();
    if (n > 0) ends.push_back(n);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * n);
    const Eigen::Index n_known = std::min(values.size(), wanted_values_.size());
    values.head(n_known) = wanted_values_.head(n_known);
    prepare(set, std::move(values), std::move(ends));
}

void SetKeeper::prepare(const ConstrainedSet& set, Eigen::VectorXd values, std::vector<int> ends) {
    preparing_set_ = set;
    refining_ = false;
    const bool drags = rule_ == FrameRule::drag_columns;
    job_.start([model = model_, set, drags, values = std::move(values), ends = std::move(ends)](Control& control) {
        auto deformer = std::make_shared<Deformer>(model);
        control.begin_stage("constrain");
        deformer->constrain(set, control);
        control.checkpoint();
        PreparedSet prepared{.deformer = std::move(deformer)};
        prepared.findings = findings_of_set(*prepared.deformer);
        prepared.memory_bytes = prepared.deformer->predict_memory(set) + prepared.deformer->predict_check_memory(set);
        control.begin_stage("solve");
        if (drags)
            solve_ahead(prepared, ends, values, control);
        else
            update_ahead(prepared, values, control);
        return prepared;
    });
}

/// The motion goes on meanwhile: the columns that the worker brings serve its continuation.
void SetKeeper::solve_on_worker() {
    if (!is_current() || solving()) return;
    preparing_set_ = wanted_set_;
    refining_ = false;
    solving_values_ = wanted_values_;
    motion_failure_.clear();
    if (rule_ == FrameRule::displace) return update_on_worker();
    DragSolver drag = current_.drag ? *current_.drag : DragSolver(current_.deformer, handle_ends_);
    job_.start(
        [deformer = current_.deformer, drag = std::move(drag), values = wanted_values_](Control& control) mutable {
            control.begin_stage("solve");
            const Stopwatch watch;
            drag.prepare(values, first_tolerance(*deformer), control);
            return PreparedSet{.deformer = deformer, .drag = std::move(drag), .solve_seconds = watch.seconds()};
        });
}

void SetKeeper::update_on_worker() {
    job_.start([deformer = current_.deformer, values = wanted_values_](Control& control) {
        control.begin_stage("solve");
        const Stopwatch watch;
        PreparedSet solved{.deformer = deformer};
        solved.whole = {values, deformer->displace(values, control)};
        solved.solve_seconds = watch.seconds();
        return solved;
    });
}

void SetKeeper::refine_on_worker() {
    preparing_set_ = wanted_set_;
    refining_ = true;
    solving_values_ = wanted_values_;
    job_.start([deformer = current_.deformer, drag = *current_.drag](Control& control) mutable {
        control.begin_stage("refine");
        drag.refine(control);
        return PreparedSet{.deformer = deformer, .drag = std::move(drag)};
    });
}

SetKeeper::Event SetKeeper::cancel() {
    if (!job_.running()) return Event::none;
    job_.cancel();
    if (refining_) {
        may_refine_ = false;
        return Event::none;
    }
    if (!same_as_wanted(preparing_set_)) return Event::none;  // a prefetch
    if (is_current()) {
        motion_failure_ = "Computing this motion was stopped. Retry, or pull again.";
        return Event::motion_failed;
    }
    failure_ = "The preparation of this constrained set was stopped. Retry, or change the set.";
    return Event::none;
}

}  // namespace elastolab
