#include "deform/gmres.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Jacobi>
#include <vector>

namespace elastolab {

namespace {

/// The least-squares problem of one column, whose Hessenberg matrix is made triangular by Givens rotations.
class LeastSquares {
public:
    explicit LeastSquares(int basis, double size)
        : R_(Eigen::MatrixXd::Zero(basis + 1, basis)), right_(Eigen::VectorXd::Zero(basis + 1)) {
        right_[0] = size;
    }
    /// Appends a column of j + 2 entries; returns the size of the residual now.
    double append(int j, Eigen::VectorXd h) {
        for (int i = 0; i < j; ++i) h.applyOnTheLeft(i, i + 1, rotations_[static_cast<std::size_t>(i)].adjoint());
        Eigen::JacobiRotation<double> rotation;
        rotation.makeGivens(h[j], h[j + 1]);
        h.applyOnTheLeft(j, j + 1, rotation.adjoint());
        right_.applyOnTheLeft(j, j + 1, rotation.adjoint());
        rotations_.push_back(rotation);
        R_.col(j).head(j + 1) = h.head(j + 1);
        return std::abs(right_[j + 1]);
    }
    /// Coefficients of the first n vectors of the basis; zero where a column was done before.
    Eigen::VectorXd solve(int n) const {
        Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
        for (int i = n - 1; i >= 0; --i) {
            if (R_(i, i) == 0.0) continue;
            y[i] = (right_[i] - R_.row(i).segment(i + 1, n - 1 - i).dot(y.tail(n - 1 - i))) / R_(i, i);
        }
        return y;
    }

private:
    Eigen::MatrixXd R_;
    Eigen::VectorXd right_;
    std::vector<Eigen::JacobiRotation<double>> rotations_;
};

/// Columns of unit size; those that vanish stay zero.
Eigen::MatrixXd normalised(const Eigen::MatrixXd& X, Eigen::RowVectorXd& size) {
    size.resize(X.cols());
    Eigen::MatrixXd unit = X;
    for (Eigen::Index c = 0; c < X.cols(); ++c) {
        size[c] = X.col(c).stableNorm();
        if (size[c] > 0.0) unit.col(c) /= size[c];
    }
    return unit;
}

/// Largest norm of the columns; not finite when one of them is not.
double largest_size(const Eigen::MatrixXd& X) {
    double largest = 0.0;
    for (const auto& column : X.colwise()) {
        const double size = column.norm();
        if (!std::isfinite(size)) return size;
        largest = std::max(largest, size);
    }
    return largest;
}

/// A cycle that leaves more than this fraction of the residual has stagnated.
constexpr double kProgress = 0.9;

/// The vectors of one cycle, for all columns at once.
class Cycle {
public:
    Cycle(const LinearOperator& A, const LinearOperator& preconditioner, const Eigen::MatrixXd& R, int basis)
        : A_(A), preconditioner_(preconditioner) {
        Eigen::RowVectorXd size;
        vectors_.push_back(normalised(R, size));
        for (const double s : size) columns_.emplace_back(basis, s);
    }

    /// Returns the largest residual of all columns.
    double step() {
        const int j = static_cast<int>(vectors_.size()) - 1;
        preconditioned_.push_back(preconditioner_.product(vectors_.back()));
        Eigen::MatrixXd W = A_.product(preconditioned_.back());
        Eigen::MatrixXd h(j + 2, W.cols());
        for (int i = 0; i <= j; ++i) {
            const Eigen::MatrixXd& v = vectors_[static_cast<std::size_t>(i)];
            h.row(i) = v.cwiseProduct(W).colwise().sum();
            W -= v * h.row(i).asDiagonal();
        }
        Eigen::RowVectorXd size;
        vectors_.push_back(normalised(W, size));
        h.row(j + 1) = size;
        double largest = 0.0;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const double residual = columns_[c].append(j, h.col(static_cast<Eigen::Index>(c)));
            if (!std::isfinite(residual)) return residual;
            largest = std::max(largest, residual);
        }
        return largest;
    }

    /// What the steps so far add to the solution.
    Eigen::MatrixXd answer() const {
        const int n = static_cast<int>(preconditioned_.size());
        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(vectors_.front().rows(), vectors_.front().cols());
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const Eigen::VectorXd y = columns_[c].solve(n);
            const auto column = static_cast<Eigen::Index>(c);
            for (int i = 0; i < n; ++i)
                sum.col(column) += y[i] * preconditioned_[static_cast<std::size_t>(i)].col(column);
        }
        return sum;
    }

private:
    const LinearOperator &A_, &preconditioner_;
    std::vector<Eigen::MatrixXd> vectors_, preconditioned_;
    std::vector<LeastSquares> columns_;
};

}  // namespace

Eigen::MatrixXd gmres(const LinearOperator& A, const LinearOperator& preconditioner, const Eigen::MatrixXd& B,
                      const GmresOptions& options, const char* name, Control& control, IterationReport* report) {
    Eigen::RowVectorXd size;
    const Eigen::MatrixXd unit = normalised(B, size);  // whatever the units, no square over- or underflows
    Eigen::MatrixXd X = scaled_start(options.start, B.rows(), size), R = unit;
    if (!X.isZero(0.0)) R -= A.product(X);
    int iterations = 0;
    double residual = largest_size(R);
    if (!std::isfinite(residual)) give_up_iteration(name, residual);
    while (residual > options.tolerance) {
        const double before = residual;
        Cycle cycle(A, preconditioner, R, options.basis);
        double expected = residual;
        for (int j = 0; j < options.basis && iterations < options.max_iterations && expected > options.tolerance; ++j) {
            control.checkpoint();
            expected = cycle.step();
            if (!std::isfinite(expected)) give_up_iteration(name, expected);
            ++iterations;
            if (report != nullptr) *report = {iterations, expected};
            control.set_progress(
                std::clamp(std::log(std::max(expected, 1e-300)) / std::log(options.tolerance), 0.0, 1.0));
        }
        X += cycle.answer();
        R = unit - A.product(X);
        residual = largest_size(R);
        if (!(residual <= options.tolerance) &&
            (iterations >= options.max_iterations || !(residual < kProgress * before)))
            give_up_iteration(name, residual);
    }
    return X * size.asDiagonal();
}

}  // namespace elastolab
