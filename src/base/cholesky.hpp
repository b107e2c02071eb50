#pragma once

#include <Eigen/Core>
#include <string>

#include "base/control.hpp"

namespace elastolab {

/// Cholesky factor of a symmetric positive definite matrix, A = L L^T, half the work of an LU. Immutable after
/// construction.
class CholeskyFactorization {
public:
    CholeskyFactorization() = default;
    /// Factors A in place of its own storage; reads its lower triangle only. `name` is what an error message calls the
    /// matrix. `control`, when given, is told the progress of the present stage and may cancel, between block columns.
    /// Throws SingularMatrixError when A is not positive definite, SolveError when it has entries that are not finite,
    /// Cancelled.
    CholeskyFactorization(Eigen::MatrixXd&& A, const std::string& name, Control* control = nullptr);

    Eigen::Index size() const { return factor_.rows(); }
    /// B <- L^-1 B and B <- L^-T B;  B has size() rows.
    void solve_lower_in_place(Eigen::Ref<Eigen::MatrixXd> B) const;
    void solve_upper_in_place(Eigen::Ref<Eigen::MatrixXd> B) const;
    /// B <- A^-1 B.
    void solve_in_place(Eigen::Ref<Eigen::MatrixXd> B) const {
        solve_lower_in_place(B);
        solve_upper_in_place(B);
    }
    /// Reciprocal condition number in the 1-norm, estimated (dpocon); 1 for an empty matrix.
    double reciprocal_condition() const { return reciprocal_condition_; }

private:
    Eigen::MatrixXd factor_;  ///< its lower triangle
    double reciprocal_condition_ = 1.0;
};

}  // namespace elastolab
