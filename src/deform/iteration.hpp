#pragma once

#include <Eigen/Core>

namespace elastolab {

/// Relative residual to which answers are iterated, and that of one that is shown first, while a better one is on its
/// way: displacements are then off by about 1e-4 of the largest (tests/benchmarks/first_answer_benchmark.cpp).
inline constexpr double kSolveTolerance = 1e-8, kFirstTolerance = 1e-4;

/// What an iterative solver has done so far.
struct IterationReport {
    int iterations = 0;
    double residual = 0.0;  ///< relative, the largest of all columns
    /// Conjugate gradients met a direction along which the matrix is not positive. Where they need not converge they
    /// end before it, with what they had, which lowers x^T A x / 2 - x^T b.
    bool indefinite = false;
};

/// Throws the SolveError of an iteration that ends at this residual without an answer. name: of its matrix.
[[noreturn]] void give_up_iteration(const char* name, double residual);

/// Where an iteration for right sides of these sizes starts that has divided them by that: 0 where nothing is known
/// (start empty) or asked for (size 0).
Eigen::MatrixXd scaled_start(const Eigen::MatrixXd& start, Eigen::Index n_rows, const Eigen::RowVectorXd& size);

}  // namespace elastolab
