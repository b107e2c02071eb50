#include "scene/live/grip_placer.hpp"

#include "base/error.hpp"
#include "base/timer.hpp"
#include "scene/user_text.hpp"
#include "scene/wish.hpp"

namespace elastolab {

namespace {

/// A solve that takes no longer may be part of a frame.
constexpr double kFrameSeconds = 0.005;

}  // namespace

std::optional<std::vector<AffineMotion>> GripPlacer::place(const std::shared_ptr<const Deformer>& deformer,
                                                           Constraints constraints,
                                                           const std::shared_ptr<const GripStiffness>& made) {
    wait();
    if (deformer != deformer_) {
        clear();
        deformer_ = deformer;
        made_ = {made};
    }
    return deformer->linear() ? place_by_stiffness(constraints) : place_by_equilibria(constraints);
}

std::optional<std::vector<AffineMotion>> GripPlacer::place_by_stiffness(Constraints& constraints) {
    const std::vector<Grip> grips = constraints.grips();
    if (!holds(grips))
        make(constraints.values, grips);
    else if (!made_.stiffness->is_for(constraints.values))
        update(constraints.values);
    if (!failure_.empty() || !holds(grips)) return std::nullopt;
    try {
        return constraints.move_grips(*made_.stiffness, deformer_->model().body().surface->vertices);
    } catch (const SolveError& error) {  // nothing holds them
        failure_ = user_text(error);
        return std::nullopt;
    }
}

std::optional<std::vector<AffineMotion>> GripPlacer::place_by_equilibria(Constraints& constraints) {
    const Positions& vertices = deformer_->model().body().surface->vertices;
    for (const std::size_t h : constraints.gripped()) constraints.move(h, {}, vertices);  // wherever they are by now
    const std::vector<GripForce> forces = constraints.grip_forces();
    const GripEquilibrium* last = made_.equilibrium.get();
    if (last != nullptr && last->grips != constraints.grips()) last = nullptr;
    const bool exact = last != nullptr && last->forces == forces && made_.asked == constraints.values;
    if (exact)
        exact_ = last->equilibrium;
    else
        follow(constraints);
    if (!failure_.empty() || last == nullptr) return std::nullopt;
    return constraints.move_grips(exact ? last->places : last->places_under(forces), vertices);
}

GripsInPlace GripPlacer::in_place() const {
    if (!failure_.empty()) return {};
    if (made_.equilibrium) return elastolab::in_place(*made_.equilibrium);
    return made_.stiffness ? elastolab::in_place(*made_.stiffness) : GripsInPlace{};
}

void GripPlacer::follow(const Constraints& constraints) {
    const std::vector<Grip> grips = constraints.grips();
    const std::vector<GripForce> forces = constraints.grip_forces();
    const bool same = asked_grips_ == grips && asked_forces_ == forces && was_asked(constraints.values);
    if (same) failure_ = worker_failure_;
    if (job_.running() || !failure_.empty()) return;
    asked_grips_ = grips;
    asked_forces_ = forces;
    ask(constraints.values);
    const Positions rest = deformer_->model().body().surface->vertices(Eigen::all, constraints.set.handles);
    job_.start([deformer = deformer_, before = made_.equilibrium, values = constraints.values, grips, forces,
                approach = Approach{nullptr, way_to(wish_of(constraints), nullptr, rest).path}](Control& control) {
        return Made{.equilibrium = std::make_shared<const GripEquilibrium>(
                        find_grip_equilibrium(*deformer, values, grips, forces, control, approach, before.get())),
                    .asked = values};
    });
}

void GripPlacer::make(const Eigen::VectorXd& values, const std::vector<Grip>& grips) {
    if (asked_grips_ == grips && job_.running()) return;
    if (asked_grips_ == grips && was_asked(values)) failure_ = worker_failure_;
    if (!failure_.empty()) return;
    asked_grips_ = grips;
    ask(values);
    job_.start([deformer = deformer_, values, grips](Control& control) {
        const Stopwatch watch;
        auto stiffness = std::make_shared<const GripStiffness>(*deformer, values, grips, control);
        return Made{std::move(stiffness), watch.seconds() / static_cast<double>(6 * grips.size() + 1)};
    });
}

GripPlacer::Made GripPlacer::updated(GripStiffness stiffness, const Deformer& deformer, const Eigen::VectorXd& values,
                                     Control& control) {
    const Stopwatch watch;
    stiffness.set_others(deformer, values, control);
    const double seconds = watch.seconds();
    return {std::make_shared<const GripStiffness>(std::move(stiffness)), seconds};
}

bool GripPlacer::was_asked(const Eigen::VectorXd& values) const {
    return asked_.size() == values.size() && asked_ == values;
}

void GripPlacer::ask(const Eigen::VectorXd& values) {
    asked_ = values;
    worker_failure_.clear();
}

/// Values that go on changing are not waited for one by one: the newest is next when the worker is free.
void GripPlacer::update(const Eigen::VectorXd& values) {
    if (made_.solve_seconds <= kFrameSeconds) {
        job_.cancel();
        Control control;
        try {
            made_ = updated(*made_.stiffness, *deformer_, values, control);
        } catch (const SolveError& error) {
            failure_ = user_text(error);
        }
        return;
    }
    if (was_asked(values)) failure_ = worker_failure_;
    if (job_.running() || !failure_.empty()) return;
    asked_grips_ = made_.stiffness->grips();
    ask(values);
    job_.start([deformer = deformer_, stiffness = made_.stiffness, values](Control& control) {
        return updated(*stiffness, *deformer, values, control);
    });
}

bool GripPlacer::poll() {
    switch (job_.poll()) {
        case JobEvent::finished:
            made_ = job_.take();
            return true;
        case JobEvent::failed:
            worker_failure_ = job_.failure();
            return true;
        case JobEvent::cancelled:
            return true;
        case JobEvent::none:
            break;
    }
    return false;
}

void GripPlacer::clear() {
    job_.cancel();
    job_.poll();
    deformer_.reset();
    made_ = {};
    exact_.reset();
    asked_grips_.clear();
    asked_forces_.clear();
    asked_.resize(0);
    worker_failure_.clear();
    failure_.clear();
}

void GripPlacer::cancel() {
    if (!job_.running()) return;
    job_.cancel();
    worker_failure_ = "Placing the handles under a force was stopped. Retry, or change something.";
}

void GripPlacer::retry() { worker_failure_.clear(); }

void GripPlacer::begin_from_rest() {
    if (!deformer_ || deformer_->linear()) return;
    job_.cancel();
    made_ = {};
    exact_.reset();
    asked_forces_.clear();
    worker_failure_.clear();
}

}  // namespace elastolab
