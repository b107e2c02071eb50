#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/control.hpp"

namespace elastolab {

/// LU factors of a square matrix. Immutable after construction.
class LuFactorization {
public:
    LuFactorization() = default;
    /// Factors A in place of its own storage: no second matrix. `name` is what the error message calls the matrix.
    /// `control`, when given, is told the progress of the present stage and may cancel (see factorise_lu).
    /// Throws SingularMatrixError when A is exactly singular, SolveError when it has entries that are not finite,
    /// Cancelled.
    LuFactorization(Eigen::MatrixXd&& A, const std::string& name, Control* control = nullptr);

    Eigen::Index size() const { return factors_.rows(); }
    /// B <- A^-1 B;  B has size() rows.
    void solve_in_place(Eigen::Ref<Eigen::MatrixXd> B) const;
    Eigen::MatrixXd solve(Eigen::MatrixXd B) const;
    /// Reciprocal condition number in the 1-norm, estimated (dgecon): below about 1e-14 solutions carry no digit.
    double reciprocal_condition() const { return reciprocal_condition_; }
    /// A^-1 (dgetri), in place of the factors, which are given up.
    Eigen::MatrixXd inverse() &&;

private:
    Eigen::MatrixXd factors_;
    std::vector<int> pivots_;
    double reciprocal_condition_ = 0.0;
};

/// Inverse of a symmetric positive definite matrix (dpotrf, dpotri), both triangles filled.
/// Throws SolveError when A is not positive definite; `name` is what the message calls A.
Eigen::MatrixXd spd_inverse(Eigen::MatrixXd A, const std::string& name);

/// Minimum-norm least-squares solution of A X = B by complete orthogonal factorisation (dgelsy), with the numerical
/// rank of A at the relative tolerance `rank_tolerance`: by default, what only rounding makes independent is not.
struct MinimumNormSolution {
    Eigen::MatrixXd X;
    int rank = 0;
};
MinimumNormSolution solve_minimum_norm(Eigen::MatrixXd A, Eigen::MatrixXd B, double rank_tolerance = 1e-12);

/// A = Q R by Householder reflections (dgeqrf): Q has min(rows, columns) orthonormal columns. Immutable.
class QrFactorization {
public:
    explicit QrFactorization(Eigen::MatrixXd A);
    /// Upper triangular, min(rows, columns) x columns of A.
    Eigen::MatrixXd R() const;
    /// Q B;  B has as many rows as Q has columns.
    Eigen::MatrixXd times_Q(const Eigen::MatrixXd& B) const;

private:
    Eigen::MatrixXd reflectors_;
    Eigen::VectorXd scales_;
};

/// A = U diag(sigma) V^T, thin: k = min(rows, columns) singular values, in descending order.
struct SingularValues {
    Eigen::MatrixXd U;      ///< rows x k, orthonormal columns
    Eigen::VectorXd sigma;  ///< k, none negative
    Eigen::MatrixXd V;      ///< columns x k, orthonormal columns
};
/// By dgesdd. Throws SolveError when the iteration does not converge or A has entries that are not finite.
SingularValues singular_values(Eigen::MatrixXd A);

/// Symmetric A = vectors diag(values) vectors^T.
struct SymmetricEigen {
    Eigen::VectorXd values;   ///< ascending
    Eigen::MatrixXd vectors;  ///< orthonormal columns
};
/// By dsyevd; reads the lower triangle only. Throws SolveError when the iteration does not converge or A has entries
/// that are not finite.
SymmetricEigen symmetric_eigen(Eigen::MatrixXd A);

/// Real parts of the eigenvalues of a square matrix, ascending. By dgeev; throws as symmetric_eigen.
Eigen::VectorXd real_parts_of_eigenvalues(Eigen::MatrixXd A);

}  // namespace elastolab
