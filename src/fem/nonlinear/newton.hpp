#pragma once

#include <Eigen/Core>
#include <memory>

#include "base/control.hpp"
#include "elasticity/material.hpp"
#include "fem/nonlinear/elements.hpp"
#include "fem/nonlinear/free_tangent.hpp"
#include "fem/sparse_cholesky.hpp"

namespace elastolab {

/// A state that Newton's method has reached, and its last linear system.
struct NewtonState {
    Eigen::VectorXd u;  ///< 3*n_nodes [L]
    bool converged = false;
    int iterations = 0;  ///< linear systems factorised
    double residual = 0.0;
    double energy = 0.0;
    double least_J = 1.0;
    int crushed = -1;  ///< the element of least J
    /// Factorised tangent: at the state itself, or where the residual was `factor_residual` before the last step.
    std::shared_ptr<const SparseCholesky> factor = nullptr;
    double factor_residual = 0.0;
    bool stable = true;  ///< the last tangent was positive definite as it is
};

/// Equilibria of a body whose constrained nodes have their displacements already. Newton's method: the true tangent,
/// and the one of projected element tangents where that is not positive definite; steps that invert no element and
/// lower the energy, but close to the solution, where energies drown in rounding, full steps as long as the residual
/// falls. Immutable; any thread may use it.
class Newton {
public:
    /// shift: added to the tangent's diagonal, for bodies that can move as a whole; else 0
    Newton(std::shared_ptr<const FreeTangent> tangent, const Material& material, double shift)
        : tangent_(std::move(tangent)), material_(material), shift_(shift) {}

    /// From u, which inverts no element, to this relative residual: of the forces at the free nodes over those at the
    /// constrained ones. Not converged when there is no step that helps or so many iterations with the true tangent, or
    /// four times as many with any, do not suffice; what was reached is returned all the same. Throws SolveError,
    /// Cancelled.
    NewtonState run(Eigen::VectorXd u, double tolerance, int most_iterations, ElementWork& work,
                    Control& control) const;
    /// A push along the most unstable direction that lowers the energy; u itself where there is none.
    Eigen::VectorXd pushed(const NewtonState& state, ElementWork& work, Control& control) const;

    BodyEnergy energy(const Eigen::VectorXd& u, ElementWork& work, Control& control) const {
        return tangent_->elements().energy(u, material_, work, control);
    }
    /// Residual of these forces at all nodes. size: of the displacements, below which part of it forces are rounding.
    double residual(double size, const Eigen::VectorXd& forces) const;
    const FreeTangent& tangent() const { return *tangent_; }
    const std::shared_ptr<const FreeTangent>& shared_tangent() const { return tangent_; }
    const Material& material() const { return material_; }
    /// The factorised tangent at u: the true one, or (stable false) the projected one.
    std::shared_ptr<const SparseCholesky> factor_at(const Eigen::VectorXd& u, ElementWork& work, SparseMatrix& K,
                                                    bool& stable, Control& control) const;

private:
    /// A step that inverts nothing and lowers the energy enough: its length, 0 when there is none.
    double step_length(const Eigen::VectorXd& u, const Eigen::VectorXd& step, double slope, double energy,
                       ElementWork& work, Control& control) const;

    std::shared_ptr<const FreeTangent> tangent_;
    Material material_;
    double shift_;
};

}  // namespace elastolab
