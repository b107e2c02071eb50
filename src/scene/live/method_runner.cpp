#include "scene/live/method_runner.hpp"

#include <utility>

#include "base/timer.hpp"
#include "findings/solution.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace {

constexpr double kFollowing = 1.0;  ///< tolerance of what is extrapolated: none is promised

}  // namespace

void MethodRunner::set_body(const Body& body, const Method& method) {
    if (body.surface.get() != surface()) forget_answer();
    models_.ask(body, method);
}

void MethodRunner::clear() {
    const bool had_body = models_.asked();
    models_.clear();
    sets_.clear();
    check_.cancel();
    check_.poll();
    if (had_body) forget_answer();
}

/// A new mesh: nothing that is there can be shown on it.
void MethodRunner::forget_answer() {
    sets_.clear();
    displacement_.resize(0);
    values_.resize(0);
    up_to_date_ = solved_ = following_ = false;
    failure_.clear();
    ++version_;
}

void MethodRunner::set_frame_rule(FrameRule rule) {
    if (sets_.set_frame_rule(rule)) up_to_date_ = false;
}

void MethodRunner::take_models() {
    if (models_.poll()) sets_.set_model(models_.model());
}

void MethodRunner::poll() {
    take_models();
    handle(sets_.poll());
    // A model of an earlier material or mode answers until the next one is prepared.
    if (sets_.answers()) update_displacement();
}

void MethodRunner::handle(SetKeeper::Event event) {
    switch (event) {
        case SetKeeper::Event::another_set:
            up_to_date_ = false;
            if (!deformer()->linear()) solved_ = false;  // by this set
            break;
        case SetKeeper::Event::converged:
            up_to_date_ = false;
            break;
        case SetKeeper::Event::motion_failed:
            failure_ = sets_.motion_failure();
            if (deformer()->linear())
                take_values(sets_.wanted_values(), false);
            else
                fall_back();
            break;
        case SetKeeper::Event::motion_solved:
            if (deformer()->linear()) break;
            failure_.clear();
            up_to_date_ = false;
            break;
        case SetKeeper::Event::none:
            break;
    }
}

bool MethodRunner::takes_long() const {
    const PreparedSet& set = sets_.current();
    return set.solve_seconds > solve_budget_ && !(set.drag && set.drag->has(sets_.wanted_values()));
}

/// What was stopped or failed, and was left for another motion, is tried again when it is wanted again.
bool MethodRunner::was_tried(const Eigen::VectorXd& wanted) const {
    const bool ended = up_to_date_ && (solved_ || !failure_.empty());
    return ended && values_.size() == wanted.size() && values_ == wanted;
}

void MethodRunner::update_displacement() {
    if (!deformer()->linear()) return follow();
    const Eigen::VectorXd& wanted = sets_.wanted_values();
    take_whole_update();
    if (was_tried(wanted)) return;
    if (takes_long()) {
        failure_.clear();
        return sets_.solve_on_worker();
    }
    try {
        if (sets_.frame_rule() == FrameRule::drag_columns)
            drag();
        else
            update_whole();
        failure_.clear();
        take_values(wanted, true);
    } catch (const std::exception& error) {
        failure_ = user_text(error);
        sets_.current().drag.reset();
        take_values(wanted, false);
    }
}

/// What the worker has solved for is shown, though the motion may have gone on since.
void MethodRunner::take_whole_update() {
    std::optional<WholeUpdate> solved = std::exchange(sets_.current().whole, std::nullopt);
    if (!solved || solved->values.size() != sets_.wanted_values().size()) return;
    displacement_ = std::move(solved->displacement);
    failure_.clear();
    take_values(std::move(solved->values), true);
}

void MethodRunner::update_whole() {
    PreparedSet& set = sets_.current();
    const Stopwatch watch;
    displacement_ = set.deformer->displace(sets_.wanted_values());
    set.solve_seconds = watch.seconds();
}

void MethodRunner::drag() {
    PreparedSet& set = sets_.current();
    if (!set.drag) set.drag.emplace(set.deformer, sets_.handle_ends());
    const bool solves = !set.drag->has(sets_.wanted_values());
    const Stopwatch watch;
    set.drag->displace(sets_.wanted_values(), displacement_);
    if (solves) set.solve_seconds = watch.seconds();
}

/// A method that is not linear: each frame shows what the tangent says, until the worker has the equilibrium. After a
/// motion that had none, it would lead away from what is known.
void MethodRunner::follow() {
    if (sets_.grip_places() == GripPlaces::unknown) return;
    PreparedSet& set = sets_.current();
    const bool exact = sets_.is_exact();
    if (!exact) sets_.solve_on_worker();
    if (up_to_date_ && following_ != exact && same(seen_, sets_.wanted())) return;
    if (!exact && (sets_.crushed() || !set.drag || !set.drag->has(sets_.wanted_values()))) return;
    try {
        set.drag->displace(sets_.wanted_values(), displacement_);
    } catch (const std::exception& error) {  // loads that do not balance: the last answer stays
        failure_ = user_text(error);
        following_ = up_to_date_ = false;
        return;
    }
    following_ = !exact;
    if (exact) {
        failure_.clear();
        set.crushed.reset();
    }
    take_values(sets_.wanted_values(), true);
}

/// The last equilibrium, whatever is wanted.
void MethodRunner::fall_back() {
    const PreparedSet& set = sets_.current();
    following_ = false;
    if (!set.drag || !set.at) return take_values(sets_.wanted_values(), false);
    displacement_ = set.drag->at_start();
    take_values(set.at->values, true);
    seen_ = *set.at;
}

void MethodRunner::take_values(Eigen::VectorXd values, bool solved) {
    values_ = std::move(values);
    seen_ = sets_.wanted();
    const std::optional<DragSolver>& columns = sets_.current().drag;
    const bool by_columns = columns && (sets_.frame_rule() == FrameRule::drag_columns || !deformer()->linear());
    tolerance_ = by_columns ? columns->tolerance() : kSolveTolerance;
    if (following_) tolerance_ = kFollowing;
    up_to_date_ = true;
    solved_ = solved;
    ++version_;
    check_.restart();
}

std::shared_ptr<const Equilibrium> MethodRunner::equilibrium() const {
    const std::optional<DragSolver>& drag = sets_.current().drag;
    return drag && solved_ && !following() ? drag->equilibrium() : nullptr;
}

void MethodRunner::check_at_rest(const std::function<GripsInPlace()>& grips) {
    check_.poll();
    if (unchecked() && converged() && check_.due()) check_.begin(deformer(), values_, equilibrium(), grips());
}

Findings MethodRunner::findings() const {
    Findings all = model() ? findings_of_model(*model()) : Findings{};
    const Findings& of_set = sets_.current().findings;
    all.insert(all.end(), of_set.begin(), of_set.end());
    all.insert(all.end(), check_.findings().begin(), check_.findings().end());
    return all;
}

void MethodRunner::cancel() {
    check_.cancel();
    models_.cancel();
    handle(sets_.cancel());
}

void MethodRunner::retry() {
    sets_.retry();
    if (!failure_.empty()) up_to_date_ = false;
    failure_.clear();
    models_.retry();
}

void MethodRunner::begin_from_rest() {
    if (!deformer() || deformer()->linear()) return;
    sets_.begin_from_rest();
    failure_.clear();
    up_to_date_ = false;
    following_ = true;  // what is shown stays until the equilibrium is there
    tolerance_ = kFollowing;
    ++version_;
}

const std::string& MethodRunner::failure() const {
    static const std::string none;
    if (!models_.failure().empty()) return models_.failure();
    if (!sets_.failure().empty()) return sets_.failure();
    return sets_.is_current() ? failure_ : none;
}

MethodRunner::State MethodRunner::state() const {
    if (models_.precomputing()) return State::precomputing;
    if (!failure().empty() && !sets_.solving()) return State::failed;  // else another motion is tried
    if (!models_.is_wanted()) return State::idle;
    if (!sets_.is_current() || sets_.solving() || !is_placed() || following_) return State::preparing;
    return deformer()->linear() || (solved_ && shows_wanted()) ? State::ready : State::preparing;
}

/// The first equilibrium of a method that is not linear may come long after its constrained set.
bool MethodRunner::has_answer() const {
    return deformer() && (deformer()->linear() || displacement_.size() > 0 || !failure_.empty());
}

bool MethodRunner::answers() const {
    if (sets_.grip_places() == GripPlaces::unknown) return false;
    if (following() && sets_.may_hold_off() && sets_.is_slow()) return false;
    return solved_ && shows_wanted() && sets_.answers() && values_.size() == sets_.wanted_values().size() &&
           values_ == sets_.wanted_values() && model_fits();
}

/// Displacements depend on Young's modulus where a force has a part in them.
bool MethodRunner::model_fits() const {
    const bool by_forces = !deformer()->set().loads.empty() || grips() != nullptr;
    Material wanted = models_.body().material;
    if (!by_forces) wanted.young_modulus = deformer()->model().body().material.young_modulus;
    return is_of(wanted, models_.method());
}

bool MethodRunner::is_of(const Material& material, const Method& method) const {
    return deformer() && deformer()->model().body().material == material &&
           same_answers(deformer()->model().method(), method);
}

JobStatus MethodRunner::status() const {
    if (models_.precomputing()) return models_.precompute_status();
    return models_.completing() && state() != State::preparing ? models_.completion_status() : sets_.status();
}

}  // namespace elastolab
