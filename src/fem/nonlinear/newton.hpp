#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>

#include "base/control.hpp"
#include "deform/equilibrium.hpp"
#include "elasticity/material.hpp"
#include "fem/nonlinear/elements.hpp"
#include "fem/nonlinear/free_tangent.hpp"
#include "fem/nonlinear/loads.hpp"
#include "fem/sparse_cholesky.hpp"

namespace elastolab {

/// Residual from which on the factor is to be one from so close to the solution: it shows whether the solution is
/// stable, and residuals do not see the soft motions that an older one leaves.
inline constexpr double kClose = 0.3;

/// A state that Newton's method has reached, and its last linear system.
struct NewtonState {
    Eigen::VectorXd u;        ///< 3*n_nodes [L]
    Eigen::VectorXd factors;  ///< of the loads
    bool converged = false;
    int iterations = 0;  ///< steps
    double residual = 0.0;
    double energy = 0.0;  ///< stored in the body
    double least_J = 1.0;
    int crushed = -1;  ///< the element of least J
    /// Where loads alone changed and no equilibrium was found: the part of their change up to which there was one.
    std::optional<double> share = std::nullopt;
    /// Factorised tangent of a state close by: on the way to this one, where the residual was `factor_residual`, or
    /// before it (1).
    std::shared_ptr<const SparseCholesky> factor = nullptr;
    double factor_residual = 0.0;
    bool stable = true;  ///< the last tangent was positive definite as it is
};

/// Workspace of Newton's method on one tangent, made once and used again.
struct NewtonWork : ElementWork {
    SparseMatrix K;  ///< the last tangent that was factorised
};

/// Answer of the true tangent that a factor of another one has preconditioned.
struct NearSolution {
    Eigen::MatrixXd X;  ///< at the free nodes; empty where there is none
    bool converged = false;
    /// The tangent is not positive definite: X is what conjugate gradients had before they saw that, and goes downhill.
    bool indefinite = false;
    int iterations = 0;  ///< of conjugate gradients
};

/// Equilibria of a body whose constrained nodes have their displacements already. Newton's method: the true tangent,
/// and the one of projected element tangents where that is not positive definite; steps that invert no element and
/// lower the energy less the work of the loads, but close to the solution, where energies drown in rounding, full steps
/// as long as the residual falls. Under pressures that follow the surface the tangent is not symmetric where the rim of
/// a pressed part is free: its symmetric part is factorised, and preconditions GMRES for the whole; a step may also
/// lower the residual instead of the energy. Immutable; any thread may use it.
class Newton {
public:
    /// shift: added to the tangent's diagonal, for bodies that can move as a whole; else 0
    Newton(std::shared_ptr<const FreeTangent> tangent, const Material& material, double shift,
           NonlinearLoads loads = {})
        : tangent_(std::move(tangent)), material_(material), shift_(shift), loads_(std::move(loads)) {}

    /// For this method alone: its matrix has the pattern of this tangent.
    NewtonWork make_work() const { return {tangent_->elements().make_work(), tangent_->make_matrix()}; }

    /// From u, which inverts no element, with loads of these factors, to this relative residual: of the forces at the
    /// free nodes over those of the loads and at the constrained ones. Not converged when there is no step that helps
    /// or so many iterations with the true tangent, or four times as many with any but no more than most_steps, do not
    /// suffice; what was reached is returned all the same. Throws SolveError, Cancelled.
    /// before: a factor of a tangent near by. It preconditions the steps, for as long as a few iterations do, down to
    /// where the solution is close; there one factor is made that serves the rest. It is let go of before that.
    /// most_stretch: a run out of a state that is not stable ends, not converged, where it stretches the body more.
    NewtonState run(Eigen::VectorXd u, const Eigen::VectorXd& factors, double tolerance, int most_iterations,
                    NewtonWork& work, Control& control, std::shared_ptr<const SparseCholesky> before = nullptr,
                    int most_steps = kMostEquilibriumSteps,
                    double most_stretch = std::numeric_limits<double>::infinity()) const;
    /// A push along the most unstable direction that lowers the energy less the loads' work; u itself where there is
    /// none.
    Eigen::VectorXd pushed(const NewtonState& state, NewtonWork& work, Control& control) const;

    /// Whether the body would leave an equilibrium under loads that follow its surface: the eigenvalue of the whole
    /// tangent next to zero is negative. That the symmetric part is not positive definite does not say so: a bar that a
    /// tension at its free end pulls straight is stable. Flutter, which needs the mass, is not seen.
    bool leaves(const NewtonState& state, NewtonWork& work, Control& control) const;

    BodyEnergy energy(const Eigen::VectorXd& u, ElementWork& work, Control& control) const {
        return tangent_->elements().energy(u, material_, work, control);
    }
    /// Forces that the nodes take at u less those that the loads give.
    Eigen::VectorXd forces(const Eigen::VectorXd& u, const Eigen::VectorXd& factors, ElementWork& work,
                           Control& control) const {
        return tangent_->elements().forces(u, material_, work, control) - loads_.forces(u, factors);
    }
    /// Relative residual of forces(u, factors). size: of the displacements, below which part of it forces are rounding.
    double residual(double size, const Eigen::VectorXd& forces, const Eigen::VectorXd& u,
                    const Eigen::VectorXd& factors) const;
    /// Change of forces(u, factors) with u along `motion` and with the factors, to first order.
    Eigen::VectorXd force_change(const Eigen::VectorXd& u, const Eigen::VectorXd& factors,
                                 const Eigen::VectorXd& motion, const Eigen::VectorXd& factor_change, ElementWork& work,
                                 Control& control) const {
        return tangent_->elements().force_change(u, motion, material_, work, control) -
               loads_.force_change(u, factors, motion, factor_change);
    }
    /// Energy of one state less that of another, and less the work of the loads on the straight way between them.
    double rise(const NewtonState& from, const Eigen::VectorXd& to, double energy) const {
        return energy - from.energy - loads_.work(from.u, to - from.u, from.factors);
    }
    const FreeTangent& tangent() const { return *tangent_; }
    const std::shared_ptr<const FreeTangent>& shared_tangent() const { return tangent_; }
    const Material& material() const { return material_; }
    const NonlinearLoads& loads() const { return loads_; }
    /// The factorised tangent at u: the true one, or (stable false) the projected one, which leaves loads out.
    /// lift: where given, the true one with so much or more added to its diagonal comes before the projected one, and
    /// what was added is returned there. Close to an equilibrium it leads on at once; the projected one, which is much
    /// stiffer, takes hundreds of steps.
    std::shared_ptr<const SparseCholesky> factor_at(const Eigen::VectorXd& u, const Eigen::VectorXd& factors,
                                                    NewtonWork& work, bool& stable, Control& control,
                                                    double* lift = nullptr) const;

    /// X at the free nodes with tangent X = B, the true tangent at u, loads included, by GMRES; factor: of one close to
    /// it. Nothing where so many iterations do not reach the relative tolerance. Throws Cancelled.
    std::optional<Eigen::MatrixXd> solve_tangent(const Eigen::VectorXd& u, const Eigen::VectorXd& factors,
                                                 const SparseCholesky& factor, const Eigen::MatrixXd& B,
                                                 double tolerance, int most_iterations, ElementWork& work,
                                                 Control& control) const;

    /// The same with a factor that is known to be of a positive definite tangent: by conjugate gradients, and by GMRES
    /// where loads follow the surface. Not converged: see NearSolution. Throws Cancelled.
    NearSolution solve_near(const Eigen::VectorXd& u, const Eigen::VectorXd& factors, const SparseCholesky& factor,
                            const Eigen::MatrixXd& B, double tolerance, int most_iterations, ElementWork& work,
                            Control& control) const;

private:
    std::shared_ptr<const FreeTangent> tangent_;
    Material material_;
    double shift_;
    NonlinearLoads loads_;
};

}  // namespace elastolab
