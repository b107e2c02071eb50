#pragma once

#include <Eigen/Core>

namespace elastolab {

/// A square matrix known by what it does: dense, sparse, hierarchical, a factorisation that is substituted, or a sum of
/// such. Applying is separate from solving, so that a solver need not know how its matrix is kept. Immutable to its
/// users; any thread may use it.
class LinearOperator {
public:
    virtual ~LinearOperator() = default;
    virtual Eigen::Index size() const = 0;
    /// A X, for any number of columns at once.
    virtual Eigen::MatrixXd product(const Eigen::MatrixXd& X) const = 0;
};

}  // namespace elastolab
