#pragma once

#include <Eigen/Core>
#include <memory>

#include "base/control.hpp"
#include "fem/nonlinear/free_tangent.hpp"
#include "fem/nonlinear/newton.hpp"
#include "fem/sparse_cholesky.hpp"

namespace elastolab {

/// Starts for large motions (rotation-strain warping, Huang et al. 2011): the linear answer to the logarithms of the
/// handles' motions tells rotation and strain everywhere; then the positions whose gradients are nearest to
/// exp(rotation) (I + strain), times the gradients before. Both factors are of the body at rest and kept.
class WarpedStart {
public:
    WarpedStart(const Newton& newton, NewtonWork& work, Control& control);

    /// Displacements of all nodes from logarithms and displacements of the constrained ones, both 3*n_nodes with zeros
    /// at the free nodes.
    Eigen::VectorXd displace(const Eigen::VectorXd& logarithm, const Eigen::VectorXd& prescribed, ElementWork& work,
                             Control& control) const;
    /// The same from displacements `from`, by a change to first order of all nodes.
    Eigen::VectorXd warped(const Eigen::VectorXd& from, const Eigen::VectorXd& change,
                           const Eigen::VectorXd& prescribed, ElementWork& work, Control& control) const;
    /// The factorised stiffness at rest.
    const std::shared_ptr<const SparseCholesky>& rest() const { return rest_; }

private:
    const FiniteElements& elements() const { return tangent_->elements(); }

    std::shared_ptr<const FreeTangent> tangent_;
    Material material_;
    std::shared_ptr<const SparseCholesky> rest_, poisson_;
};

}  // namespace elastolab
