#include "fem/nonlinear/newton_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace elastolab {

namespace {

/// Residual below which energies cannot tell better from worse.
constexpr double kRoundedEnergy = 1e-6;
/// Part of the decrease that the slope promises, which a step must bring.
constexpr double kArmijo = 1e-4;
constexpr double kShortestStep = 1e-8;
constexpr int kMostLonger = 20;  // doublings
/// Projected tangents, which a body takes that buckles, converge slowly: so many times as many iterations are allowed.
constexpr int kMoreWhereProjected = 4;
/// Steps under pressures that follow the surface.
constexpr double kStepTolerance = 1e-4;
constexpr int kMostStepIterations = 40;
/// Steps by a factor that is there: the part of the residual that they leave at most; the iterations for it, beyond
/// which a factor of its own is cheaper, and those beyond which the next step has one.
constexpr double kNearTolerance = 0.3;
constexpr int kMostNearIterations = 10, kManyNearIterations = 6;
/// Steps in a row that only go downhill, since the tangent is not positive definite where they begin.
constexpr int kMostDownhill = 2;
/// Whole steps instead of parts of them: so many more that put them right, also where energies cannot tell; and the
/// part of one that is tried next.
constexpr int kMostRighting = 4, kMostRightingOfRounded = 8;
constexpr double kShortLeap = 0.25;

}  // namespace

NewtonRun::NewtonRun(const Newton& newton, Eigen::VectorXd u, const Eigen::VectorXd& factors, double tolerance,
                     NewtonWork& work, Control& control, std::shared_ptr<const SparseCholesky> before)
    : newton_(newton), tolerance_(tolerance), work_(work), control_(control) {
    state_.u = std::move(u);
    state_.factor = std::move(before);
    state_.factor_residual = 1.0;
    state_.factors = factors;
    energy_ = newton.energy(state_.u, work, control);
    state_.energy = energy_.energy;
    forces_ = newton.forces(state_.u, factors, work, control);
    size_ = state_.u.lpNorm<Eigen::Infinity>();
    state_.residual = newton.residual(size_, forces_, state_.u, factors);
    first_ = std::log(std::max(state_.residual, tolerance));
}

double NewtonRun::progress() const {
    const double last = std::log(tolerance_);
    return first_ > last ? 1.0 - (std::log(state_.residual) - last) / (first_ - last) : 0.0;
}

bool NewtonRun::may_use_factor() const {
    if (!state_.factor || !state_.stable || stale_) return false;
    return state_.residual > kClose || state_.factor_residual <= kClose;
}

std::optional<Eigen::VectorXd> NewtonRun::near_step(const Eigen::VectorXd& gradient) {
    if (!may_use_factor()) return std::nullopt;
    // As close as the step itself will come: residuals fall by their squares.
    const double tolerance = std::min(kNearTolerance, 0.3 * std::max(state_.residual, tolerance_ / state_.residual));
    const NearSolution near = newton_.solve_near(state_.u, state_.factors, *state_.factor, gradient, tolerance,
                                                 kMostNearIterations, work_, control_);
    n_downhill_ = near.indefinite ? n_downhill_ + 1 : 0;
    stale_ = near.iterations > kManyNearIterations || n_downhill_ >= kMostDownhill;
    const bool serves = near.converged || (near.indefinite && near.iterations > 0);
    if (!serves) return std::nullopt;
    return -near.X.col(0);
}

std::optional<Eigen::VectorXd> NewtonRun::own_step(const Eigen::VectorXd& gradient) {
    state_.factor.reset();  // not two at once
    double* lift = state_.residual <= kClose && !newton_.loads().follow() ? &lift_ : nullptr;
    state_.factor = newton_.factor_at(state_.u, state_.factors, work_, state_.stable, control_, lift);
    if (!state_.factor) return std::nullopt;
    state_.factor_residual = state_.residual;
    stale_ = false;
    if (newton_.loads().follow())
        if (const std::optional<Eigen::MatrixXd> whole =
                newton_.solve_tangent(state_.u, state_.factors, *state_.factor, gradient, kStepTolerance,
                                      kMostStepIterations, work_, control_))
            return -whole->col(0);
    return -state_.factor->solve(gradient);
}

double NewtonRun::lengthened(const Eigen::VectorXd& step, double rise) const {
    double length = 1.0;
    for (int doubling = 0; doubling < kMostLonger; ++doubling, length *= 2.0) {
        const Eigen::VectorXd to = state_.u + 2.0 * length * step;
        const double energy = newton_.energy(to, work_, control_).energy;
        if (!std::isfinite(energy) || !(newton_.rise(state_, to, energy) < rise)) break;
        rise = newton_.rise(state_, to, energy);
    }
    return length;
}

double NewtonRun::step_length(const Eigen::VectorXd& step, double slope, double gradient) const {
    for (int halvings = 0; std::ldexp(1.0, -halvings) > kShortestStep; ++halvings) {
        const double length = std::ldexp(1.0, -halvings);
        const Eigen::VectorXd to = state_.u + length * step;
        const double energy = newton_.energy(to, work_, control_).energy;
        if (!std::isfinite(energy)) continue;
        if (newton_.rise(state_, to, energy) <= kArmijo * length * slope)
            return halvings == 0 && !state_.stable ? lengthened(step, newton_.rise(state_, to, energy)) : length;
        if (newton_.loads().follow() && free_rows(newton_.forces(to, state_.factors, work_, control_)).norm() <=
                                            (1.0 - kArmijo * length) * gradient)
            return length;
    }
    return 0.0;
}

bool NewtonRun::go(const Eigen::VectorXd& reduced, const Eigen::VectorXd& gradient) {
    const Eigen::VectorXd step = newton_.tangent().all_rows(reduced);
    if (state_.residual <= kRoundedEnergy) {
        const Place before = place();
        if (put(state_.u + step) && state_.residual < before.residual) return true;
        take(before);
        const bool by_own = state_.stable && state_.factor_residual == state_.residual;
        return by_own && (leap(step, 0.0) || leap(kShortLeap * step, 0.0));
    }
    const double slope = std::min(gradient.dot(reduced), 0.0);
    const double length = step_length(step, slope, gradient.norm());
    if (length < 1.0 && state_.stable && state_.residual <= kClose && state_.iterations >= leaps_from_) {
        if (leap(step, slope) || leap(kShortLeap * step, kShortLeap * slope)) {
            wait_ = 1;
            return true;
        }
        wait_ *= 2;
        leaps_from_ = state_.iterations + wait_;
        stale_ = true;
    }
    return length > 0.0 && put(state_.u + length * step);
}

bool NewtonRun::put(const Eigen::VectorXd& u) {
    const BodyEnergy energy = newton_.energy(u, work_, control_);
    if (!std::isfinite(energy.energy)) return false;
    forces_ = newton_.forces(u, state_.factors, work_, control_);
    if (newton_.loads().size() > 0) size_ = std::max(size_, u.lpNorm<Eigen::Infinity>());
    state_.residual = newton_.residual(size_, forces_, u, state_.factors);
    state_.u = u;
    energy_ = energy;
    state_.energy = energy.energy;
    return true;
}

void NewtonRun::take(const Place& place) {
    state_.u = place.u;
    state_.energy = place.energy.energy;
    state_.residual = place.residual;
    state_.stable = place.stable;
    energy_ = place.energy;
    forces_ = place.forces;
    size_ = place.size;
}

bool NewtonRun::leap(const Eigen::VectorXd& step, double slope) {
    const Place before = place();
    NewtonState from;
    from.u = before.u;
    from.energy = before.energy.energy;
    from.factors = state_.factors;
    const auto is_better = [&] {
        return before.residual > kRoundedEnergy ? newton_.rise(from, state_.u, state_.energy) <= kArmijo * slope
                                                : state_.residual < before.residual;
    };
    const int most = before.residual > kRoundedEnergy ? kMostRighting : kMostRightingOfRounded;
    bool moved = put(state_.u + step), keeps_factor = true;
    for (int more = 0; moved && !is_better() && more < most; ++more) {
        const Eigen::VectorXd gradient = free_rows(forces_);
        std::optional<Eigen::VectorXd> next = near_step(gradient);
        if (!next) {
            next = own_step(gradient);
            keeps_factor = false;
        }
        moved = next && put(state_.u + newton_.tangent().all_rows(*next));
        ++state_.iterations;
    }
    if (moved && is_better()) return true;
    take(before);
    if (!keeps_factor) state_.factor.reset();  // it is of a place that was given up
    return false;
}

NewtonState NewtonRun::run(int most_iterations, int most_steps, double most_stretch) {
    int unhindered = 0;
    most_steps = std::min(most_steps, kMoreWhereProjected * most_iterations);
    while (state_.residual > tolerance_ && unhindered < most_iterations && state_.iterations < most_steps) {
        control_.set_progress(progress());
        const Eigen::VectorXd gradient = free_rows(forces_);
        std::optional<Eigen::VectorXd> step = near_step(gradient);
        if (!step || !go(*step, gradient)) {
            step = own_step(gradient);
            if (!step || !go(*step, gradient)) break;
        }
        unhindered += state_.stable ? 1 : 0;
        ++state_.iterations;
        if (std::isfinite(most_stretch) && !state_.stable &&
            newton_.tangent().elements().largest_stretch(state_.u, control_) > most_stretch)
            break;
    }
    state_.converged = state_.residual <= tolerance_;
    state_.least_J = energy_.least_J;
    state_.crushed = energy_.element;
    return std::move(state_);
}

}  // namespace elastolab
