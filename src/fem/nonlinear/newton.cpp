#include "fem/nonlinear/newton.hpp"

#include <cmath>
#include <random>

#include "base/error.hpp"
#include "deform/conjugate_gradients.hpp"
#include "deform/gmres.hpp"
#include "fem/nonlinear/newton_run.hpp"
#include "fem/nonlinear/tangent_operators.hpp"

namespace elastolab {

namespace {

Eigen::VectorXd random_vector(Eigen::Index n) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
}

/// Reactions below this part of modulus times displacement times edge are rounding.
constexpr double kNoForce = 1e-5;

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
                                                        NewtonWork& work, bool& stable, Control& control,
                                                        double* lift) const {
    constexpr int kLifts = 8;
    constexpr double kLeastLift = 1e-8, kHigher = 4.0;  // the first over the mean of the diagonal
    const auto factor = [&](double lifted) -> std::shared_ptr<const SparseCholesky> {
        tangent_->assemble(work, shift_ + lifted, work.K, control);
        std::optional<SparseCholesky> found = factorised(*tangent_, work.K, control);
        return found ? std::make_shared<const SparseCholesky>(std::move(*found)) : nullptr;
    };
    tangent_->elements().stiffness(u, material_, false, work, control);
    loads_.add_tangent(u, factors, work);
    stable = true;
    if (auto found = factor(0.0)) return found;
    stable = false;
    if (lift != nullptr) {
        double lifted = std::max(*lift / kHigher, kLeastLift * work.K.diagonal().mean());
        for (int i = 0; i < kLifts; ++i, lifted *= kHigher)
            if (auto found = factor(lifted)) {
                *lift = lifted;
                return found;
            }
    }
    tangent_->elements().stiffness(u, material_, true, work, control);
    return factor(0.0);
}

NewtonState Newton::run(Eigen::VectorXd u, const Eigen::VectorXd& factors, double tolerance, int most_iterations,
                        NewtonWork& work, Control& control, std::shared_ptr<const SparseCholesky> before,
                        int most_steps, double most_stretch) const {
    return NewtonRun(*this, std::move(u), factors, tolerance, work, control, std::move(before))
        .run(most_iterations, most_steps, most_stretch);
}

NearSolution Newton::solve_near(const Eigen::VectorXd& u, const Eigen::VectorXd& factors, const SparseCholesky& factor,
                                const Eigen::MatrixXd& B, double tolerance, int most_iterations, ElementWork& work,
                                Control& control) const {
    if (loads_.follow()) {
        std::optional<Eigen::MatrixXd> X =
            solve_tangent(u, factors, factor, B, tolerance, most_iterations, work, control);
        return X ? NearSolution{.X = std::move(*X), .converged = true} : NearSolution{};
    }
    Control of_its_own;
    IterationReport report;
    NearSolution near;
    try {
        near.X =
            conjugate_gradients(FreeTangentProduct(*this, u, factors, shift_, work, control), FactorSolve(factor), B,
                                {.tolerance = tolerance, .max_iterations = most_iterations, .must_converge = false},
                                "tangent stiffness", of_its_own, &report);
    } catch (const SolveError&) {
        return {};
    }
    near.converged = report.residual <= tolerance;
    near.indefinite = report.indefinite;
    near.iterations = report.iterations;
    return near;
}

bool Newton::leaves(const NewtonState& state, NewtonWork& work, Control& control) const {
    constexpr int kIterations = 12, kMostOfEach = 60;
    constexpr double kTolerance = 1e-3;
    Eigen::VectorXd v = random_vector(tangent_->size());
    double softness = 0.0;
    for (int i = 0; i < kIterations; ++i) {
        v.normalize();
        const std::optional<Eigen::MatrixXd> x =
            solve_tangent(state.u, state.factors, *state.factor, v, kTolerance, kMostOfEach, work, control);
        if (!x) return true;  // nothing is known that speaks for it
        softness = v.dot(x->col(0));
        v = x->col(0);
    }
    return softness < 0.0;
}

Eigen::VectorXd Newton::pushed(const NewtonState& state, NewtonWork& work, Control& control) const {
    constexpr int kIterations = 40;
    SparseMatrix& K = work.K;
    tangent_->elements().stiffness(state.u, material_, false, work, control);
    loads_.add_tangent(state.u, state.factors, work);
    tangent_->assemble(work, 0.0, K, control);
    // With P the projected tangent, I - P^-1 K has eigenvalues above 1 where K has negative ones.
    Eigen::VectorXd v = random_vector(K.rows());
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
