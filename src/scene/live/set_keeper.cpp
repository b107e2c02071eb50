#include "scene/live/set_keeper.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "findings/solution.hpp"
#include "scene/motion.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace {

/// What a motion of a method that is not linear must have rested before it is worth an equilibrium that takes long, and
/// how long one that nobody waits for any more may take, where no other answers meanwhile.
constexpr double kPauseSeconds = 0.2, kPatienceSeconds = 2.0;
/// Equilibria that take no longer need no turns on the way.
constexpr double kQuickSeconds = 0.1;

Positions handle_positions(const Deformer& deformer) {
    return deformer.model().body().surface->vertices(Eigen::all, deformer.set().handles);
}

double first_tolerance(const Deformer& deformer) {
    return deformer.iterates() || !deformer.linear() ? kFirstTolerance : kSolveTolerance;
}

/// Where no columns are kept, a grab would integrate and take seconds: the worker solves, not the watcher.
/// start: an equilibrium close to the wish; null: from rest.
void solve_ahead(PreparedSet& prepared, const Wish& wish, const std::shared_ptr<const Equilibrium>& start,
                 Control& control) {
    const Stopwatch watch;
    const auto solved = [&](const Approach& approach) {
        try {
            DragSolver drag(prepared.deformer, wish.ends);
            drag.prepare(wish.values, first_tolerance(*prepared.deformer), control, approach);
            prepared.drag = std::move(drag);
            prepared.at = std::make_shared<const Wish>(wish);
            return true;
        } catch (const SolveError&) {
            // These values have no solution; the frame that asks for them says so, if they are still wanted then.
            return false;
        }
    };
    if (!start || !solved({start, {}})) {
        Approach from_rest;
        if (!prepared.deformer->linear())
            from_rest.path = way_to(wish, nullptr, handle_positions(*prepared.deformer)).path;
        solved(from_rest);
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
    if (constraints.set != wanted_set_) {
        wanted_set_ = constraints.set;
        failure_.clear();
    }
    wanted_grips_ = constraints.grips();
    Wish wish = wish_of(constraints);
    if (!same(wish, wanted_)) {
        may_converge_ = true;
        rest_ = {};
    }
    wanted_ = std::move(wish);
}

void SetKeeper::set_grip_places(GripPlaces places, std::shared_ptr<const Equilibrium> found) {
    grip_places_ = places;
    found_ = std::move(found);
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
    may_serve_sets_ = true;
    job_.cancel();
}

void SetKeeper::clear() {
    job_.cancel();
    job_.poll();
    model_.reset();
    prefetch_.reset();  // of another body
    current_ = {};
    spare_ = {};
    found_.reset();
    failure_.clear();
    motion_failure_.clear();
}

bool SetKeeper::same_as_wanted(const ConstrainedSet& set) const { return set == wanted_set_; }

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
            if (!prepared.deformer) return Event::none;
            if (prepared.deformer == current_.deformer && converging_) {
                current_.drag = std::move(prepared.drag);
                return Event::converged;
            }
            if (prepared.deformer == current_.deformer) return take_solution(std::move(prepared));
            if (&prepared.deformer->model() == model_.get()) spare_ = std::move(prepared);
            return Event::none;
        }
        case JobEvent::failed:
            return take_failure();
        case JobEvent::cancelled:
            if (solving_.values.size() > 0)
                current_.solve_seconds = std::max(current_.solve_seconds, job_.last_seconds());
            break;
        case JobEvent::none:
            break;
    }
    return Event::none;
}

SetKeeper::Event SetKeeper::take_solution(PreparedSet prepared) {
    current_.solve_seconds = prepared.solve_seconds;
    current_.crushed = std::move(prepared.crushed);
    if (current_.crushed) {
        failed_ = solving_;
        motion_failure_ = current_.crushed->message;
        return Event::motion_failed;
    }
    is_anew_ = false;
    current_.drag = std::move(prepared.drag);
    current_.whole = std::move(prepared.whole);
    current_.at = std::move(prepared.at);
    return Event::motion_solved;
}

SetKeeper::Event SetKeeper::take_failure() {
    if (!same_as_wanted(preparing_set_)) return Event::none;  // a prefetch: nobody asked for it yet
    if (!is_current()) {
        failure_ = job_.failure();
        return Event::none;
    }
    if (converging_) may_converge_ = false;
    if (!same(solving_, wanted_)) return Event::none;  // the motion went on: that is tried next
    motion_failure_ = job_.failure();
    failed_ = solving_;
    if (is_linear()) current_.drag.reset();
    return Event::motion_failed;
}

SetKeeper::Event SetKeeper::use_or_prepare() {
    Event event = Event::none;
    if (!is_current() && spare_.deformer && same_as_wanted(spare_.deformer->set())) {
        const bool keep = current_.deformer && &current_.deformer->model() == model_.get();
        std::swap(current_, spare_);
        spare_.drag.reset();
        if (!keep) spare_ = {};
        found_.reset();
        failure_.clear();
        event = Event::another_set;
    }
    if (!is_current()) {
        if (failure_.empty() && !(job_.running() && same_as_wanted(preparing_set_))) prepare(wanted_set_, wanted_);
    } else if (is_overtaken()) {
        job_.cancel();
    } else if (may_converge_ && grip_places_ == GripPlaces::in_equilibrium && !job_.running() && current_.drag &&
               current_.drag->tolerance() > kSolveTolerance && (is_exact() || failed_)) {
        converge_on_worker();
    } else if (prefetch_ && !job_.running()) {
        if (!same_as_wanted(*prefetch_) && !(spare_.deformer && spare_.deformer->set() == *prefetch_))
            prepare_prefetched(*prefetch_);
        prefetch_.reset();
    } else if (may_serve_sets_ && !job_.running() && !model_->serves_sets()) {
        serve_further_sets();
    }
    return event;
}

void SetKeeper::prefetch(const ConstrainedSet& set, const Eigen::VectorXd& displacement) {
    prefetch_ = set;
    prefetch_moved_ = Positions::Zero(3, std::ssize(set.handles));
    if (model_ && displacement.size() == 3 * model_->body().surface->n_vertices())
        prefetch_moved_ = displacement.reshaped(3, displacement.size() / 3)(Eigen::all, set.handles);
}

/// Of a method that is not linear, where a body begins that is held or moved at more vertices than before: as it is.
std::shared_ptr<const Equilibrium> SetKeeper::start_for(const ConstrainedSet& set) const {
    if (!current_.deformer || &current_.deformer->model() != model_.get() || is_linear() || !current_.drag) return {};
    const ConstrainedSet& now = current_.deformer->set();
    const bool adds = set.fixed == now.fixed && set.loads == now.loads && set.handles.size() > now.handles.size() &&
                      std::equal(now.handles.begin(), now.handles.end(), set.handles.begin());
    const std::shared_ptr<const Equilibrium>& equilibrium = current_.drag->equilibrium();
    return adds && equilibrium ? for_another_set(*equilibrium) : nullptr;
}

/// A prefetched set mostly has one more handle, where it is until it is pulled.
void SetKeeper::prepare_prefetched(const ConstrainedSet& set) {
    const auto n = static_cast<int>(set.handles.size());
    Wish wish{.values = Eigen::VectorXd::Zero(set.n_values()), .motions = wanted_.motions, .ends = wanted_.ends};
    while (!wish.ends.empty() && wish.ends.back() >= n) wish.ends.pop_back();
    if (n > 0) wish.ends.push_back(n);
    if (!wish.motions.empty()) wish.motions.resize(wish.ends.size());
    const Eigen::Index n_loads = std::ssize(set.loads), n_loads_before = std::ssize(wanted_set_.loads);
    const Eigen::Index n_known = std::min(wish.values.size() - n_loads, wanted_.values.size() - n_loads_before);
    wish.values.head(n_known) = wanted_.values.head(n_known);
    if (const Eigen::Index known = n_known / 3; known < n) {
        const std::vector<int> added(set.handles.begin() + known, set.handles.end());
        const Positions rest = model_->body().surface->vertices(Eigen::all, added);
        const Motion motion = motion_to(rest, rest + prefetch_moved_.rightCols(n - known));
        wish.values.segment(3 * known, 3 * (n - known)) = displacements(motion, rest).reshaped();
    }
    // A handle may cover a load, which then acts no more.
    if (n_loads == n_loads_before) wish.values.tail(n_loads) = wanted_.values.tail(n_loads);
    prepare(set, std::move(wish));
}

void SetKeeper::prepare(const ConstrainedSet& set, Wish wish) {
    preparing_set_ = set;
    converging_ = false;
    solving_ = {};
    failed_.reset();
    is_anew_ = false;
    const bool linear = model_->method().kind->linear, drags = rule_ == FrameRule::drag_columns || !linear;
    // An equilibrium with handles under a force where the scene has them would be none of theirs.
    const bool solves = linear || !same_as_wanted(set) || grip_places_ != GripPlaces::unknown;
    std::vector<Grip> grips = same_as_wanted(set) && linear ? wanted_grips_ : std::vector<Grip>();
    job_.start([model = model_, set, drags, solves, wish = std::move(wish), grips = std::move(grips),
                start = start_for(set)](Control& control) {
        auto deformer = std::make_shared<Deformer>(model);
        control.begin_stage("constrain");
        deformer->constrain(set, control);
        control.checkpoint();
        PreparedSet prepared{.deformer = std::move(deformer)};
        prepared.findings = findings_of_set(*prepared.deformer);
        prepared.memory_bytes = prepared.deformer->predict_memory(set) + prepared.deformer->predict_check_memory(set);
        if (!solves) return prepared;
        control.begin_stage("solve");
        if (!grips.empty())
            prepared.grips = std::make_shared<const GripStiffness>(*prepared.deformer, wish.values, grips, control);
        if (drags)
            solve_ahead(prepared, wish, start, control);
        else
            update_ahead(prepared, wish.values, control);
        return prepared;
    });
}

bool SetKeeper::is_slow() const {
    const double running = solving() ? job_.status().seconds : 0.0;
    return std::max(current_.solve_seconds, running) > kFollowSeconds;
}

bool SetKeeper::is_exact() const {
    if (!is_current() || !current_.drag || !current_.drag->is_exact(wanted_.values)) return false;
    return is_linear() || (current_.at && same(*current_.at, wanted_));
}

/// Of a method that is not linear: what is wanted is there, as after an undo, and the worker is still at what was
/// wanted before.
bool SetKeeper::is_overtaken() const {
    return job_.running() && !converging_ && !is_linear() && is_exact() && solving_.values.size() > 0 &&
           !same(solving_, wanted_);
}

/// Whether it is time to solve for what is wanted now.
bool SetKeeper::may_solve_now() {
    if (is_linear()) return !solving();
    if (failed_ && same(*failed_, wanted_)) return false;
    if (solving() && same(solving_, wanted_)) return false;
    if (may_hold_off_ && is_slow() && current_.drag) {  // the first answer of a set is not held off
        if (solving()) job_.cancel();
        return rest_.seconds() >= kPauseSeconds;
    }
    return !solving() || job_.status().seconds > kPatienceSeconds;
}

/// Of a method that is not linear: from the equilibrium at hand, that of the handles under a force, or from rest.
Approach SetKeeper::approach_to(const Wish& wish) const {
    if (is_linear()) return {};
    const bool has_start = current_.drag && current_.at && current_.drag->equilibrium();
    if (!has_start && found_) return {found_, {}};
    Way way = way_to(wish, has_start ? current_.at.get() : nullptr, handle_positions(*current_.deformer));
    // What is remembered of these values may be what is not wanted; over a path it is not asked.
    if (is_anew_ && way.from_rest && way.path.cols() == 0) way.path = Eigen::MatrixXd::Zero(wish.values.size(), 1);
    return {way.from_rest ? nullptr : current_.drag->equilibrium(), std::move(way.path)};
}

/// What the worker is to pass next on the way to what is wanted; nothing where it goes there at once.
std::optional<Wish> SetKeeper::next_step() const {
    const bool follows = !is_linear() && !may_hold_off_ && current_.solve_seconds > kQuickSeconds;
    if (!follows || !current_.at || !current_.drag || !current_.drag->equilibrium()) return std::nullopt;
    return step_towards(wanted_, *current_.at, kFollowTurn, handle_positions(*current_.deformer));
}

/// The motion goes on meanwhile: the columns that the worker brings serve its continuation.
void SetKeeper::solve_on_worker() {
    if (!is_current() || !may_solve_now()) return;
    preparing_set_ = wanted_set_;
    converging_ = false;
    solving_ = wanted_;
    failed_.reset();
    motion_failure_.clear();
    if (rule_ == FrameRule::displace && is_linear()) return update_on_worker();
    DragSolver drag = current_.drag ? *current_.drag : DragSolver(current_.deformer, wanted_.ends);
    const std::optional<Wish> step = next_step();
    const double tolerance = step ? kPassingTolerance : first_tolerance(*current_.deformer);
    const Wish next = step.value_or(wanted_);
    job_.start([deformer = current_.deformer, drag = std::move(drag), approach = approach_to(next), wish = next,
                tolerance](Control& control) mutable {
        control.begin_stage("solve");
        const Stopwatch watch;
        PreparedSet solved{.deformer = deformer, .at = std::make_shared<const Wish>(wish)};
        try {
            drag.prepare(wish.values, tolerance, control, approach);
        } catch (const NoEquilibriumError& error) {
            solved.crushed = Crushed{user_text(error), error.place()};
        }
        solved.drag = std::move(drag);
        solved.solve_seconds = watch.seconds();
        return solved;
    });
}

void SetKeeper::begin_from_rest() {
    job_.cancel();
    current_.drag.reset();
    current_.at.reset();
    current_.crushed.reset();
    found_.reset();
    failed_.reset();
    motion_failure_.clear();
    is_anew_ = true;
}

void SetKeeper::update_on_worker() {
    job_.start([deformer = current_.deformer, values = wanted_.values](Control& control) {
        control.begin_stage("solve");
        const Stopwatch watch;
        PreparedSet solved{.deformer = deformer};
        solved.whole = {values, deformer->displace(values, control)};
        solved.solve_seconds = watch.seconds();
        return solved;
    });
}

void SetKeeper::converge_on_worker() {
    preparing_set_ = wanted_set_;
    converging_ = true;
    solving_ = wanted_;
    job_.start([deformer = current_.deformer, drag = *current_.drag](Control& control) mutable {
        control.begin_stage("converge");
        drag.converge(control);
        return PreparedSet{.deformer = deformer, .drag = std::move(drag)};
    });
}

/// The first set was answered by itself, the sooner: what further ones take over is made while it serves.
void SetKeeper::serve_further_sets() {
    may_serve_sets_ = false;
    preparing_set_ = {};
    converging_ = false;
    solving_ = {};
    job_.start([model = model_, set = wanted_set_](Control& control) {
        control.begin_stage("constrain");
        Deformer(model).constrain(set, control);  // its columns stay with the model
        return PreparedSet{};
    });
}

SetKeeper::Event SetKeeper::cancel() {
    if (!job_.running()) return Event::none;
    job_.cancel();
    if (converging_) {
        may_converge_ = false;
        return Event::none;
    }
    if (!same_as_wanted(preparing_set_)) return Event::none;  // a prefetch
    if (is_current()) {
        motion_failure_ = "Computing this motion was stopped. Retry, or pull again.";
        failed_ = wanted_;
        return Event::motion_failed;
    }
    failure_ = "The preparation of this constrained set was stopped. Retry, or change the set.";
    return Event::none;
}

}  // namespace elastolab
