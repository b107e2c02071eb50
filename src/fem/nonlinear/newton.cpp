#include "fem/nonlinear/newton.hpp"

#include <cmath>
#include <random>

namespace elastolab {

namespace {

/// Residual below which energies cannot tell better from worse.
constexpr double kRoundedEnergy = 1e-6;
/// Part of the decrease that the slope promises, which a step must bring.
constexpr double kArmijo = 1e-4;
constexpr double kShortestStep = 1e-8;
/// Projected tangents, which a body takes that buckles, converge slowly: so many times as many iterations are allowed.
constexpr int kMoreWhereProjected = 4;
/// Reactions below this part of modulus times displacement times edge are rounding.
constexpr double kNoForce = 1e-5;

}  // namespace

double Newton::residual(double size, const Eigen::VectorXd& forces) const {
    const double free = tangent_->free_rows(forces).norm();
    const double constrained = std::sqrt(std::max(forces.squaredNorm() - free * free, 0.0));
    const double whole = constrained + kNoForce * material_.young_modulus * size * tangent_->elements().edge();
    return whole > 0.0 ? free / whole : (free > 0.0 ? 1.0 : 0.0);
}

std::shared_ptr<const SparseCholesky> Newton::factor_at(const Eigen::VectorXd& u, ElementWork& work, SparseMatrix& K,
                                                        bool& stable, Control& control) const {
    for (const bool projected : {false, true}) {
        tangent_->elements().stiffness(u, material_, projected, work, control);
        tangent_->assemble(work, shift_, K, control);
        stable = !projected;
        if (std::optional<SparseCholesky> factor = factorised(*tangent_, K, control))
            return std::make_shared<const SparseCholesky>(std::move(*factor));
    }
    return nullptr;
}

double Newton::step_length(const Eigen::VectorXd& u, const Eigen::VectorXd& step, double slope, double energy,
                           ElementWork& work, Control& control) const {
    for (double length = 1.0; length > kShortestStep; length *= 0.5)
        if (this->energy(u + length * step, work, control).energy <= energy + kArmijo * length * slope) return length;
    return 0.0;
}

NewtonState Newton::run(Eigen::VectorXd u, double tolerance, int most_iterations, ElementWork& work,
                        Control& control) const {
    NewtonState state;
    state.u = std::move(u);
    SparseMatrix K = tangent_->make_matrix();
    BodyEnergy energy = this->energy(state.u, work, control);
    Eigen::VectorXd forces = tangent_->elements().forces(state.u, material_, work, control);
    const double size = state.u.lpNorm<Eigen::Infinity>();
    state.residual = residual(size, forces);
    const double first = std::log(std::max(state.residual, tolerance));
    int unhindered = 0;
    while (state.residual > tolerance && unhindered < most_iterations &&
           state.iterations < kMoreWhereProjected * most_iterations) {
        control.set_progress(first > std::log(tolerance) ? 1.0 - (std::log(state.residual) - std::log(tolerance)) /
                                                                     (first - std::log(tolerance))
                                                         : 0.0);
        state.factor.reset();  // not two at once
        state.factor = factor_at(state.u, work, K, state.stable, control);
        if (!state.factor) break;
        unhindered += state.stable ? 1 : 0;
        state.factor_residual = state.residual;
        ++state.iterations;
        const Eigen::VectorXd gradient = tangent_->free_rows(forces);
        const Eigen::VectorXd reduced = -state.factor->solve(gradient);
        const Eigen::VectorXd step = tangent_->all_rows(reduced);
        double length = 1.0;
        if (state.residual > kRoundedEnergy)
            length = step_length(state.u, step, gradient.dot(reduced), energy.energy, work, control);
        if (length == 0.0) break;
        const Eigen::VectorXd next = state.u + length * step;
        const BodyEnergy next_energy = this->energy(next, work, control);
        if (!std::isfinite(next_energy.energy)) break;
        const Eigen::VectorXd next_forces = tangent_->elements().forces(next, material_, work, control);
        const double next_residual = residual(size, next_forces);
        if (state.residual <= kRoundedEnergy && !(next_residual < state.residual)) break;
        state.u = next;
        energy = next_energy;
        forces = next_forces;
        state.residual = next_residual;
    }
    state.converged = state.residual <= tolerance;
    state.energy = energy.energy;
    state.least_J = energy.least_J;
    state.crushed = energy.element;
    return state;
}

Eigen::VectorXd Newton::pushed(const NewtonState& state, ElementWork& work, Control& control) const {
    constexpr int kIterations = 40;
    SparseMatrix K = tangent_->make_matrix();
    tangent_->elements().stiffness(state.u, material_, false, work, control);
    tangent_->assemble(work, 0.0, K, control);
    // With P the projected tangent, I - P^-1 K has eigenvalues above 1 where K has negative ones.
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    Eigen::VectorXd v = Eigen::VectorXd::NullaryExpr(K.rows(), [&] { return normal(random); });
    for (int i = 0; i < kIterations; ++i) {
        control.checkpoint();
        v.normalize();
        const Eigen::VectorXd Kv = K.selfadjointView<Eigen::Lower>() * v;
        v -= state.factor->solve(Kv);
    }
    v.normalize();
    const Eigen::VectorXd Kv = K.selfadjointView<Eigen::Lower>() * v;
    if (!(v.dot(Kv) < 0.0)) return state.u;
    const Eigen::VectorXd direction = tangent_->all_rows(v) / v.lpNorm<Eigen::Infinity>();
    for (double length = tangent_->elements().edge(); length > 1e-3 * tangent_->elements().edge(); length *= 0.5)
        for (const double sign : {1.0, -1.0}) {
            Eigen::VectorXd u = state.u + sign * length * direction;
            if (energy(u, work, control).energy < state.energy) return u;
        }
    return state.u;
}

}  // namespace elastolab
