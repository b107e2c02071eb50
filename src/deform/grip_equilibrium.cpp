#include "deform/grip_equilibrium.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "deform/moved_grips.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

/// Forces that no motion answers, over all forces.
constexpr double kUnansweredForces = 1e-6;
/// Forces that are left, over all forces: wanted; good enough where rounding allows no less.
constexpr double kForcesBalance = 1e-8, kForcesNearlyBalance = 1e-6;
/// A state is better than another whose energy is higher by this part of it, or whose missing forces are larger.
constexpr double kLeastGain = 1e-9, kFalls = 0.9;
constexpr int kWholeSteps = 4;
constexpr double kShortestStep = 1e-3;
constexpr int kMostSolves = 120, kMostNewtonSolves = 25, kMostPushes = 3;
/// Forces that stretch the body more than this are none that a material bears: a mistake in the units. Linear theory
/// tells those that are far beyond, by a mean strain that leaves room for what bends first.
constexpr double kMostStretch = 100.0, kMostLinearStrain = 1000.0;
constexpr const char* kUnbearable =
    "handles under a force: they would stretch the body more than 100 times, which no material bears. Make the forces "
    "smaller, or check the units of forces, lengths and Young's modulus.";
/// Length of a push out of a state that is not stable, over that of the longest step.
constexpr double kPush = 0.1;

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// An equilibrium of the body with the grips at these places.
struct State {
    std::vector<GripPlace> places;
    VectorXd values;
    Deformer::Answer answer;
    VectorXd missing;  ///< force over moment of each grip: wanted less those that hold it there
    MatrixXd stiffness;
};

class Search {
public:
    Search(const Deformer& deformer, const std::vector<Grip>& grips, const std::vector<GripForce>& forces,
           Control& control)
        : deformer_(deformer),
          control_(control),
          grips_(deformer, grips, forces),
          forces_(forces),
          units_(grips_.units()),
          held_(grips_.body_is_held()),
          moments_(std::ranges::any_of(forces, [](const GripForce& its) { return !its.moment.isZero(0.0); })) {
        const Index n_fixed = std::ssize(deformer.set().fixed);
        for (Index i = 0; i < n_fixed + std::ssize(deformer.set().handles); ++i)
            if (std::ranges::none_of(grips,
                                     [&](const Grip& g) { return n_fixed + g.begin <= i && i < n_fixed + g.end; }))
                others_.push_back(i);
    }

    State at(std::vector<GripPlace> places, VectorXd values, const Approach& approach) {
        control_.checkpoint();
        ++solves_;
        State state{
            .places = std::move(places), .values = std::move(values), .answer = {}, .missing = {}, .stiffness = {}};
        grips_.put(state.places, state.values);
        state.answer = deformer_.answer(state.values, {.along = grips_.basis(state.places, state.values.size())},
                                        control_, approach);
        iterations_ += state.answer.facts->iterations;
        state.missing = grips_.wanted(state.places) - grips_.resultants(state.places, state.answer.reactions.forces);
        state.stiffness = grips_.stiffness(state.places, state.answer);
        return state;
    }

    /// From such a state on. By Newton's method where moments act, which keep their direction, so that they have no
    /// energy that would fall; where that fails or ends in a state that is not stable, downhill.
    State run(const State& first) {
        if (!moments_) return downhill(first);
        by_newton_ = true;
        std::optional<State> found = descended(first, kMostNewtonSolves);
        by_newton_ = false;
        return found && tangent(*found).stable() ? *std::move(found) : downhill(first);
    }
    /// Throws where something of the forces would move the grips without end.
    void require_answer(const State& state) const {
        const VectorXd all = units_.asDiagonal() * state.missing;
        if ((all - tangent(state).answered(state.missing)).norm() > kUnansweredForces * size_of(state))
            throw SolveError(kUnbalancedGrips);
    }
    /// Throws where by linear theory the forces strain the body beyond all measure.
    void require_bearable(const State& state) const {
        const GripTangent stiffness = tangent(state);
        const VectorXd forces = stiffness.answered(state.missing);
        const double work = (units_.cwiseInverse().asDiagonal() * forces).dot(stiffness.step(forces));
        const Body& body = deformer_.model().body();
        const double mean_strain = std::sqrt(work / (body.material.young_modulus * enclosed_volume(*body.surface)));
        if (!(mean_strain < kMostLinearStrain)) throw SolveError(kUnbearable);
    }
    int solves() const { return solves_; }
    int iterations() const { return iterations_; }
    GripTangent tangent(const State& state) const {
        return {state.stiffness, grips_.length(), deformer_.model().body().material.young_modulus, held_};
    }

private:
    State downhill(State state) {
        std::optional<State> found = descended(std::move(state), kMostSolves);
        if (!found)
            throw SolveError(
                "handles under a force: no motion of theirs was found that balances it. Make the forces smaller, or "
                "let them grow in steps.");
        return *std::move(found);
    }
    /// The equilibrium that is found in so many solves.
    std::optional<State> descended(State state, int most_solves) {
        const double most_stretch = kMostStretch * state.answer.facts->largest_stretch;
        const int last = solves_ + most_solves;
        int pushes = 0;
        while (solves_ < last) {
            if (state.answer.facts->largest_stretch > most_stretch) {
                if (by_newton_) break;  // it may lead anywhere
                throw SolveError(kUnbearable);
            }
            const GripTangent stiffness = tangent(state);
            if (balanced(state, stiffness, kForcesBalance)) {
                if (by_newton_ || stiffness.stable() || pushes++ == kMostPushes) return state;
                state = pushed(state, stiffness);
                continue;
            }
            std::optional<State> next = improved(state, stiffness, last);
            // Close to the answer, forces fall until they are those that the body's own equilibrium leaves.
            const bool falls = next && next->missing.norm() < 0.5 * state.missing.norm();
            if (!falls && balanced(state, stiffness, kForcesNearlyBalance)) return state;
            if (!next) break;
            state = *std::move(next);
        }
        return std::nullopt;
    }
    /// Of all forces: on the grips, and on what else is held or loaded, which may be all there is.
    double size_of(const State& state) const {
        const VectorXd wanted = grips_.wanted(state.places);
        double others = 0.0;
        for (const Resultant& load : state.answer.loads) others += load.force.norm();
        for (const Index i : others_) others += state.answer.reactions.forces.col(i).norm();
        return std::max(
            {(units_.asDiagonal() * wanted).norm(), (units_.asDiagonal() * (wanted - state.missing)).norm(), others});
    }
    bool balanced(const State& state, const GripTangent& stiffness, double tolerance) const {
        return stiffness.answered(state.missing).norm() <= tolerance * size_of(state);
    }
    std::optional<State> tried(const State& state, const VectorXd& step) {
        std::vector<GripPlace> places;
        for (std::size_t g = 0; g < state.places.size(); ++g)
            places.push_back(moved(state.places[g], step.segment<6>(6 * static_cast<Index>(g))));
        try {
            return at(std::move(places), state.values, {state.answer.equilibrium, {}});
        } catch (const NoEquilibriumError&) {
            return std::nullopt;
        }
    }

    /// Energy of the body less the work of all forces. That of a moment is taken as if the rotation kept its axis.
    double potential(const State& state) const {
        double work = state.answer.facts->work_of_loads;
        for (std::size_t g = 0; g < state.places.size(); ++g) {
            const GripPlace& place = state.places[g];
            const GripForce& its = forces_[g];
            work +=
                its.force.dot(place.shift) - 0.5 * its.spring * place.shift.squaredNorm() + its.moment.dot(place.turn);
        }
        return state.answer.facts->energy - work;
    }
    bool better(const State& next, const State& state, const GripTangent& stiffness) const {
        return potential(next) < potential(state) - kLeastGain * std::abs(potential(state)) ||
               stiffness.answered(next.missing).norm() < kFalls * stiffness.answered(state.missing).norm();
    }
    VectorXd step_from(const State& state, const GripTangent& stiffness) const {
        const VectorXd missing = stiffness.answered(state.missing);
        return by_newton_ && stiffness.has_falling_motion() ? stiffness.newton_step(missing) : stiffness.step(missing);
    }
    std::optional<State> stepped(const State& state, const VectorXd& step, double part = 1.0) {
        return tried(state, part * std::min(1.0, longest_step(state.places, grips_.length(), step)) * step);
    }
    /// A better state after a few whole steps, since what resists much more than the rest (a slender bar its stretch)
    /// is put right by the step after; else after one that is short enough. last: no more solves than that.
    std::optional<State> improved(const State& state, const GripTangent& stiffness, int last) {
        const VectorXd step = step_from(state, stiffness);
        std::optional<State> next = stepped(state, step);
        for (int i = 1; next && !better(*next, state, stiffness) && i < kWholeSteps; ++i)
            next = stepped(*next, step_from(*next, tangent(*next)));
        for (double part = 0.5; (!next || !better(*next, state, stiffness)) && part > kShortestStep; part *= 0.5) {
            if (solves_ >= last) return std::nullopt;
            next = stepped(state, step, part);
        }
        return next && better(*next, state, stiffness) ? std::move(next) : std::nullopt;
    }
    State pushed(const State& state, const GripTangent& stiffness) {
        const VectorXd soft = stiffness.softest();
        std::optional<State> next = tried(state, kPush * longest_step(state.places, grips_.length(), soft) * soft);
        return next ? *std::move(next) : state;
    }

    const Deformer& deformer_;
    Control& control_;
    MovedGrips grips_;
    const std::vector<GripForce>& forces_;
    VectorXd units_;
    std::vector<Index> others_;  ///< constrained vertices that are of no grip
    bool held_, moments_, by_newton_ = false;
    int solves_ = 0, iterations_ = 0;
};

}  // namespace

std::vector<GripPlace> GripEquilibrium::places_under(const std::vector<GripForce>& others) const {
    VectorXd more(6 * std::ssize(grips)), springs(std::ssize(grips));
    for (std::size_t g = 0; g < grips.size(); ++g) {
        const auto at = static_cast<Index>(g);
        springs[at] = others[g].spring - forces[g].spring;
        more.segment<6>(6 * at) << others[g].force - forces[g].force - springs[at] * places[g].shift,
            others[g].moment - forces[g].moment;
    }
    const GripTangent held = tangent.with_springs(springs);
    const VectorXd whole = held.step(held.answered(more));
    const VectorXd step = std::min(1.0, longest_step(places, tangent.length(), whole)) * whole;
    std::vector<GripPlace> found;
    for (std::size_t g = 0; g < grips.size(); ++g)
        found.push_back(moved(places[g], step.segment<6>(6 * static_cast<Index>(g))));
    return found;
}

GripEquilibrium find_grip_equilibrium(const Deformer& deformer, const VectorXd& values, const std::vector<Grip>& grips,
                                      const std::vector<GripForce>& forces, Control& control, const Approach& approach,
                                      const GripEquilibrium* before) {
    assert(!deformer.linear() && grips.size() == forces.size());
    Search search(deformer, grips, forces, control);
    const bool known = before != nullptr && before->grips == grips;
    State first = search.at(known ? before->places : std::vector<GripPlace>(grips.size()), values,
                            known ? Approach{before->equilibrium, {}} : approach);
    if (!known) {
        search.require_answer(first);
        search.require_bearable(first);
    }
    State state = search.run(first);
    GripTangent tangent = search.tangent(state);
    return {.grips = grips,
            .forces = forces,
            .places = std::move(state.places),
            .values = std::move(state.values),
            .equilibrium = std::move(state.answer.equilibrium),
            .tangent = std::move(tangent),
            .solves = search.solves(),
            .iterations = search.iterations()};
}

}  // namespace elastolab
