// The part of NonlinearSolver that goes from one equilibrium to another.
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "fem/nonlinear/free_turns.hpp"
#include "fem/nonlinear/solver.hpp"

namespace elastolab {

namespace {

/// Angle of a step that the tangent predicts well [rad].
constexpr double kStepAngle = std::numbers::pi / 6.0;
constexpr int kMostIterations = 40, kMostPassing = 30;
/// Where loads alone change: a slender body that buckles turns by a little in each.
constexpr int kMostUnderLoads = 120;
/// Steps shorter than this part of the way are given up.
constexpr double kShortestPart = 1.0 / 512.0;
/// The same where loads alone change, between an equilibrium and loads for which none is found: the limit is told.
constexpr double kShortestOfLoads = 1.0 / 64.0;
/// A step of the loads that stretches the body so many times as much as it was runs away, or is one for shorter steps.
constexpr double kMostMoreStretch = 10.0;
/// Where an equilibrium is not compressed further than this, what fails next to it is not that it is crushed.
constexpr double kNotCrushed = 0.5;
/// Residual of the linear systems that predict a step.
constexpr double kPrediction = 0.1;
/// Smallest ratio of volumes that a predicted state may have: those below are far from any equilibrium.
constexpr double kCrushed = 0.05;
constexpr int kPushes = 3;
/// Of a push along which the energy falls; and iterations from there.
constexpr int kMostDoublings = 20, kMostPushed = 240;
/// Part of the displacements by which an equilibrium may differ from the one nearest to rest.
constexpr double kNoTurn = 1e-9;

/// For which no equilibrium was found, and up to where there was one; the place completes the last sentence.
std::string without_equilibrium(const NewtonState& failed, bool loaded, bool from_rest) {
    if (!failed.share)
        return std::string("no equilibrium was found for these motions") + (loaded ? " and loads" : "") +
               ". The body is crushed most near";
    std::string text = "no equilibrium was found for these loads.";
    const int percent = static_cast<int>(100.0 * *failed.share);
    if (percent > 0)
        text += " An equilibrium was found up to " + std::to_string(percent) + " % of " +
                (from_rest ? "the loads." : "their change.");
    return text + (failed.least_J < kNotCrushed ? " The body is crushed most near" : " The body gives way near");
}

}  // namespace

/// The best that warping leads to; not converged where it does not.
NewtonState NonlinearSolver::warped(const MotionPath& path, const Eigen::VectorXd& factors, double tolerance,
                                    int most_steps, NewtonWork& work, Control& control) const {
    const Eigen::VectorXd u =
        rest(work, control)->displace(of_all_nodes(path.logarithm()), of_all_nodes(path.at(1.0)), work, control);
    if (!(newton_.energy(u, work, control).least_J > kCrushed)) return {};
    keep(nullptr);
    return newton_.run(u, factors, tolerance, kMostIterations, work, control, nullptr, most_steps);
}

/// Tangent answer to a load, roughly; where the factor there is does not do, `at` gets one of its own.
Eigen::VectorXd NonlinearSolver::tangent_answer(NewtonState& at, const Eigen::VectorXd& load, int& iterations,
                                                NewtonWork& work, Control& control) const {
    if (at.factor && at.stable)
        if (const NearSolution near =
                newton_.solve_near(at.u, at.factors, *at.factor, load, kPrediction, kFewIterations, work, control);
            near.converged && !near.indefinite)
            return near.X.col(0);
    if (!at.factor || at.stable) {
        keep(nullptr);  // not two at once
        at.factor.reset();
        at.factor = newton_.factor_at(at.u, at.factors, work, at.stable, control);
        if (!at.factor) throw SolveError(kNoTangent);
        ++iterations;
    }
    return at.factor->solve(load);
}

/// Where the equilibrium will be for these displacements of the constrained nodes: the tangent's answer to the
/// velocities of their screws tells how everything turns and strains.
Eigen::VectorXd NonlinearSolver::predicted(NewtonState& at, const Eigen::VectorXd& prescribed,
                                           const Eigen::VectorXd& factors, int& iterations, NewtonWork& work,
                                           Control& control) const {
    const FreeTangent& tangent = newton_.tangent();
    const MotionPath path(rest_positions_, patches_, of_prescribed(at.u), prescribed);
    const Eigen::VectorXd velocities = of_all_nodes(path.logarithm());
    const Eigen::VectorXd load =
        tangent.free_rows(newton_.force_change(at.u, at.factors, velocities, factors - at.factors, work, control));
    const Eigen::VectorXd change = velocities - tangent.all_rows(tangent_answer(at, load, iterations, work, control));
    const Eigen::VectorXd goal = of_all_nodes(prescribed);
    Eigen::VectorXd warped = rest(work, control)->warped(at.u, change, goal, work, control);
    if (std::isfinite(newton_.energy(warped, work, control).energy)) return warped;
    return goal + tangent.all_rows(tangent.free_rows(at.u + change));
}

/// From one equilibrium to the next by predicted steps, which are halved where they fail.
NewtonState NonlinearSolver::followed(const NonlinearState& from, const MotionPath& path,
                                      const Eigen::VectorXd& factors, double tolerance, int most_steps,
                                      NewtonWork& work, Control& control) const {
    NewtonState at = from.with_factor();
    at.iterations = 0;
    double part = 0.0, failed_at = 2.0,
           length = 1.0 / std::max(1.0, std::ceil(path.largest_angle() / kStepAngle - 1e-6));
    NewtonState failed;
    int iterations = 0;
    const Eigen::VectorXd before = at.factors;
    const bool loads_only = of_prescribed(at.u) == path.at(1.0);
    const double shortest = loads_only ? kShortestOfLoads : kShortestPart;
    while (part < 1.0 && length >= shortest && iterations < most_steps) {
        control.checkpoint();
        const double next = part + length > 1.0 - 1e-9 ? 1.0 : part + length;
        const Eigen::VectorXd next_factors = next < 1.0 ? before + next * (factors - before) : factors;
        Eigen::VectorXd u = predicted(at, path.at(next), next_factors, iterations, work, control);
        BodyEnergy energy = newton_.energy(u, work, control);
        const auto is_crushed = [&] { return !(energy.least_J > kCrushed * std::min(1.0, at.least_J)); };
        if (is_crushed() && loads_only) {  // next to where the body buckles, its tangent predicts no end of motion
            u = at.u;
            energy = newton_.energy(u, work, control);
        }
        if (is_crushed()) {
            failed.crushed = energy.element;
            length = 0.5 * (next - part);
            continue;
        }
        const double wanted = next < 1.0 ? std::max(kPassing, tolerance) : tolerance;
        const bool stable = at.stable;
        keep(nullptr);  // a factor less at the same time; where the step fails, it is made again
        const int left = std::max(1, most_steps - iterations);
        const int most = loads_only ? kMostUnderLoads : next < 1.0 ? kMostPassing : kMostIterations;
        const double most_stretch = loads_only ? kMostMoreStretch * elements().largest_stretch(at.u, control)
                                               : std::numeric_limits<double>::infinity();
        NewtonState reached = newton_.run(u, next_factors, wanted, most, work, control,
                                          std::exchange(at.factor, nullptr), left, most_stretch);
        if (reached.iterations == 0) reached.stable = stable;
        const int still_left = left - reached.iterations;
        if (reached.converged && leaves(reached, work, control))
            reached = stabilised(std::move(reached), wanted, still_left, work, control);
        iterations += reached.iterations;
        if (!reached.converged) {
            failed.crushed = reached.crushed;
            failed_at = next;
            length = 0.5 * (next - part);
            continue;
        }
        at = std::move(reached);
        keep(at.factor);
        part = next;
        length = std::min(2.0 * length, 1.0);
        // Loads that failed already most likely fail again, at many times the cost of loads that are borne.
        if (loads_only && failed_at > part) length = std::min(length, 0.5 * (failed_at - part));
        if (part < 1.0 && path.largest_angle() > 0.0) length = std::min(length, kStepAngle / path.largest_angle());
    }
    at.iterations = iterations;
    if (part < 1.0) {
        if (failed.crushed < 0) failed.crushed = at.crushed;  // the steps were used up
        failed.iterations = iterations;
        failed.u = at.u;
        failed.least_J = at.least_J;
        if (loads_only) failed.share = part;
        return failed;
    }
    return at;
}

NonlinearSolver::StatePtr NonlinearSolver::advance(const NonlinearState& from, const Eigen::VectorXd& values, bool far,
                                                   double tolerance, int most_steps, NewtonWork& work,
                                                   Control& control) const {
    const Eigen::VectorXd present = of_prescribed(from.newton().u), prescribed = displacements_of(values),
                          factors = factors_of(values);
    if (present == prescribed && from.newton().factors == factors && from.newton().residual <= tolerance)
        return std::make_shared<const NonlinearState>(from.with_factor(), [&] {
            EquilibriumFacts facts = from.facts();
            facts.iterations = 0;
            return facts;
        }());
    require_faces(prescribed);
    const MotionPath path(rest_positions_, patches_, present, prescribed);
    NewtonState state;
    int iterations = 0;
    if (far && path.largest_angle() > 0.5 * kStepAngle) {
        state = warped(path, factors, tolerance, most_steps, work, control);
        iterations = state.iterations;
    }
    if (!state.converged) {
        state = followed(from, path, factors, tolerance, most_steps, work, control);
        state.iterations += iterations;
    }
    if (!state.converged) {
        const Eigen::Vector4i corners = elements().elements().col(std::max(state.crushed, 0)).head<4>();
        throw NoEquilibriumError(
            without_equilibrium(state, newton_.loads().size() > 0, from.newton().factors.isZero(0.0)),
            elements().positions()(Eigen::all, corners).rowwise().mean());
    }
    const int left = most_steps - state.iterations;
    // By a factor from rest alone, a body may come to a state that it would leave.
    if (far && state.factor && state.factor_residual > kClose) state.stable = false;  // until judge_at_its_end()
    return settled(std::move(state), tolerance, left, work, control);
}

/// Whether the equilibrium is left at the least push.
bool NonlinearSolver::leaves(const NewtonState& state, NewtonWork& work, Control& control) const {
    if (state.stable || !state.factor) return !state.stable;
    return !newton_.loads().follow() || newton_.leaves(state, work, control);
}

/// As far along a push as the energy falls: steps of Newton's method turn slender bodies by a little each.
Eigen::VectorXd NonlinearSolver::pushed_far(const NewtonState& state, const Eigen::VectorXd& push, NewtonWork& work,
                                            Control& control) const {
    const Eigen::VectorXd goal = of_all_nodes(of_prescribed(state.u));
    Eigen::VectorXd best = push, change = push - state.u;
    double least = newton_.rise(state, push, newton_.energy(push, work, control).energy);
    for (int doubling = 0; doubling < kMostDoublings; ++doubling) {
        change *= 2.0;
        const Eigen::VectorXd u = rest(work, control)->warped(state.u, change, goal, work, control);
        const double energy = newton_.energy(u, work, control).energy;
        if (!std::isfinite(energy) || !(newton_.rise(state, u, energy) < least)) break;
        least = newton_.rise(state, u, energy);
        best = u;
    }
    return best;
}

NewtonState NonlinearSolver::stabilised(NewtonState state, double tolerance, int most_steps, NewtonWork& work,
                                        Control& control) const {
    for (int push = 0; push < kPushes && !state.stable && state.factor && most_steps > 0; ++push) {
        Eigen::VectorXd u = newton_.pushed(state, work, control);
        if (u == state.u) break;
        u = pushed_far(state, u, work, control);
        NewtonState left = newton_.run(u, state.factors, tolerance, kMostPushed, work, control, nullptr, most_steps);
        state.iterations += left.iterations;  // in vain or not
        most_steps -= left.iterations;
        if (!left.converged || !(newton_.rise(state, left.u, left.energy) < 0.0)) break;
        left.iterations = state.iterations;
        state = std::move(left);
    }
    return state;
}

void NonlinearSolver::judge_at_its_end(NewtonState& state, NewtonWork& work, Control& control) const {
    if (state.stable || !state.factor || state.factor_residual <= state.residual) return;
    keep(nullptr);  // not two at once
    state.factor.reset();
    state.factor = newton_.factor_at(state.u, state.factors, work, state.stable, control);
    state.factor_residual = state.residual;
}

void NonlinearSolver::keep(std::shared_ptr<const SparseCholesky> factor) const {
    const std::scoped_lock lock(kept_mutex_);
    kept_ = std::move(factor);
}

/// Newton's method stays within what is resisted only to first order, and so may turn a body about the rest.
NewtonState NonlinearSolver::turned_to_rest(NewtonState state, double tolerance, NewtonWork& work,
                                            Control& control) const {
    const Eigen::VectorXd dead = newton_.loads().dead_forces(state.factors);
    const Eigen::VectorXd u =
        elastolab::turned_to_rest(elements().positions(), state.u, dead.reshaped(3, elements().n_nodes()));
    if ((u - state.u).norm() < kNoTurn * u.norm()) return state;
    NewtonState turned = newton_.run(u, state.factors, tolerance, kMostIterations, work, control);
    if (!turned.converged || turned.iterations > 0) return state;
    turned.iterations = state.iterations;
    turned.stable = state.stable;
    return turned;
}

NonlinearSolver::StatePtr NonlinearSolver::settled(NewtonState state, double tolerance, int most_steps,
                                                   NewtonWork& work, Control& control) const {
    judge_at_its_end(state, work, control);
    bool stable = !leaves(state, work, control);
    if (!stable) {
        state = stabilised(std::move(state), tolerance, most_steps, work, control);
        stable = !leaves(state, work, control);
    }
    if (nodes_.nodes.empty()) state = turned_to_rest(std::move(state), tolerance, work, control);
    keep(state.factor);
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(state.u.size());
    EquilibriumFacts facts{.iterations = state.iterations,
                           .energy = state.energy,
                           .work_of_loads = newton_.loads().work(rest, state.u, state.factors),
                           .largest_stretch = elements().largest_stretch(state.u, control),
                           .stable = stable};
    return std::make_shared<const NonlinearState>(std::move(state), facts);
}

}  // namespace elastolab
