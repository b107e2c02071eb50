#include "fem/nonlinear/newton.hpp"

#include <cmath>
#include <random>

#include "base/error.hpp"
#include "deform/gmres.hpp"

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
/// Steps under pressures that follow the surface.
constexpr double kStepTolerance = 1e-4;
constexpr int kMostStepIterations = 40;

class FreeTangentProduct : public LinearOperator {
public:
    FreeTangentProduct(const Newton& newton, const Eigen::VectorXd& u, const Eigen::VectorXd& factors, double shift,
                       ElementWork& work, Control& control)
        : newton_(newton),
          u_(u),
          factors_(factors),
          none_(newton.loads().none()),
          shift_(shift),
          work_(work),
          control_(control) {}
    Eigen::Index size() const override { return newton_.tangent().size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        control_.checkpoint();
        Eigen::MatrixXd all = newton_.tangent().all_rows(X);
        for (auto column : all.colwise())
            column = newton_.force_change(u_, factors_, Eigen::VectorXd(column), none_, work_, control_);
        return newton_.tangent().free_rows(all) + shift_ * X;
    }

private:
    const Newton& newton_;
    const Eigen::VectorXd &u_, &factors_;
    Eigen::VectorXd none_;
    double shift_;
    ElementWork& work_;
    Control& control_;
};

class FactorSolve : public LinearOperator {
public:
    explicit FactorSolve(const SparseCholesky& factor) : factor_(factor) {}
    Eigen::Index size() const override { return factor_.size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override { return factor_.solve(X); }

private:
    const SparseCholesky& factor_;
};

}  // namespace

std::optional<Eigen::MatrixXd> Newton::solve_tangent(const Eigen::VectorXd& u, const Eigen::VectorXd& factors,
                                                     const SparseCholesky& factor, const Eigen::MatrixXd& B,
                                                     double tolerance, int most_iterations, ElementWork& work,
                                                     Control& control) const {
    Control of_its_own;  // its progress is not that of Newton's method; products watch for a cancel
    try {
        return gmres(FreeTangentProduct(*this, u, factors, shift_, work, control), FactorSolve(factor), B,
                     {.tolerance = tolerance, .start = {}, .max_iterations = most_iterations}, "tangent stiffness",
                     of_its_own);
    } catch (const SolveError&) {
        return std::nullopt;
    }
}

double Newton::residual(double size, const Eigen::VectorXd& forces, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& factors) const {
    const double free = tangent_->free_rows(forces).norm();
    const double constrained = std::sqrt(std::max(forces.squaredNorm() - free * free, 0.0));
    const double given = loads_.size() > 0 ? loads_.forces(u, factors).norm() : 0.0;
    const double whole = constrained + given + kNoForce * material_.young_modulus * size * tangent_->elements().edge();
    return whole > 0.0 ? free / whole : (free > 0.0 ? 1.0 : 0.0);
}

std::shared_ptr<const SparseCholesky> Newton::factor_at(const Eigen::VectorXd& u, const Eigen::VectorXd& factors,
                                                        ElementWork& work, SparseMatrix& K, bool& stable,
                                                        Control& control) const {
    for (const bool projected : {false, true}) {
        tangent_->elements().stiffness(u, material_, projected, work, control);
        if (!projected) loads_.add_tangent(u, factors, work);
        tangent_->assemble(work, shift_, K, control);
        stable = !projected;
        if (std::optional<SparseCholesky> factor = factorised(*tangent_, K, control))
            return std::make_shared<const SparseCholesky>(std::move(*factor));
    }
    return nullptr;
}

double Newton::step_length(const NewtonState& state, const Eigen::VectorXd& step, double slope, double gradient,
                           ElementWork& work, Control& control) const {
    for (int halvings = 0; std::ldexp(1.0, -halvings) > kShortestStep; ++halvings) {
        const double length = std::ldexp(1.0, -halvings);
        const Eigen::VectorXd to = state.u + length * step;
        const double energy = this->energy(to, work, control).energy;
        if (!std::isfinite(energy)) continue;
        if (rise(state, to, energy) <= kArmijo * length * slope) return length;
        if (loads_.follow() &&
            tangent_->free_rows(forces(to, state.factors, work, control)).norm() <= (1.0 - kArmijo * length) * gradient)
            return length;
    }
    return 0.0;
}

NewtonState Newton::run(Eigen::VectorXd u, const Eigen::VectorXd& factors, double tolerance, int most_iterations,
                        ElementWork& work, Control& control, std::shared_ptr<const SparseCholesky> before) const {
    NewtonState state;
    state.u = std::move(u);
    state.factor = std::move(before);
    state.factor_residual = 1.0;
    state.factors = factors;
    SparseMatrix K = tangent_->make_matrix();
    BodyEnergy energy = this->energy(state.u, work, control);
    state.energy = energy.energy;
    Eigen::VectorXd forces = this->forces(state.u, factors, work, control);
    double size = state.u.lpNorm<Eigen::Infinity>();
    state.residual = residual(size, forces, state.u, factors);
    const double first = std::log(std::max(state.residual, tolerance));
    int unhindered = 0;
    while (state.residual > tolerance && unhindered < most_iterations &&
           state.iterations < kMoreWhereProjected * most_iterations) {
        control.set_progress(first > std::log(tolerance) ? 1.0 - (std::log(state.residual) - std::log(tolerance)) /
                                                                     (first - std::log(tolerance))
                                                         : 0.0);
        state.factor.reset();  // not two at once
        state.factor = factor_at(state.u, factors, work, K, state.stable, control);
        if (!state.factor) break;
        unhindered += state.stable ? 1 : 0;
        state.factor_residual = state.residual;
        ++state.iterations;
        const Eigen::VectorXd gradient = tangent_->free_rows(forces);
        Eigen::VectorXd reduced = -state.factor->solve(gradient);
        if (loads_.follow())
            if (const std::optional<Eigen::MatrixXd> whole = solve_tangent(
                    state.u, factors, *state.factor, gradient, kStepTolerance, kMostStepIterations, work, control))
                reduced = -whole->col(0);
        const Eigen::VectorXd step = tangent_->all_rows(reduced);
        double length = 1.0;
        if (state.residual > kRoundedEnergy)
            length = step_length(state, step, std::min(gradient.dot(reduced), 0.0), gradient.norm(), work, control);
        if (length == 0.0) break;
        const Eigen::VectorXd next = state.u + length * step;
        const BodyEnergy next_energy = this->energy(next, work, control);
        if (!std::isfinite(next_energy.energy)) break;
        const Eigen::VectorXd next_forces = this->forces(next, factors, work, control);
        if (loads_.size() > 0) size = std::max(size, next.lpNorm<Eigen::Infinity>());
        const double next_residual = residual(size, next_forces, next, factors);
        if (state.residual <= kRoundedEnergy && !(next_residual < state.residual)) break;
        state.u = next;
        energy = next_energy;
        state.energy = energy.energy;
        forces = next_forces;
        state.residual = next_residual;
    }
    state.converged = state.residual <= tolerance;
    state.least_J = energy.least_J;
    state.crushed = energy.element;
    return state;
}

Eigen::VectorXd Newton::pushed(const NewtonState& state, ElementWork& work, Control& control) const {
    constexpr int kIterations = 40;
    SparseMatrix K = tangent_->make_matrix();
    tangent_->elements().stiffness(state.u, material_, false, work, control);
    loads_.add_tangent(state.u, state.factors, work);
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
    constexpr int kHalvings = 10;
    for (int halvings = 0; halvings < kHalvings; ++halvings)
        for (const double sign : {1.0, -1.0}) {
            const double length = std::ldexp(tangent_->elements().edge(), -halvings);
            Eigen::VectorXd u = state.u + sign * length * direction;
            const double energy = this->energy(u, work, control).energy;
            if (std::isfinite(energy) && rise(state, u, energy) < 0.0) return u;
        }
    return state.u;
}

}  // namespace elastolab
