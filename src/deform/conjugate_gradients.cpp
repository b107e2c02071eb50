#include "deform/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace elastolab {

namespace {

/// Inner products of the columns of two matrices.
Eigen::RowVectorXd column_products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.cwiseProduct(b).colwise().sum();
}

/// a / b where the column is not done yet, else 0.
Eigen::RowVectorXd ratio(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b, const std::vector<char>& done) {
    Eigen::RowVectorXd r = Eigen::RowVectorXd::Zero(a.size());
    for (Eigen::Index c = 0; c < a.size(); ++c)
        if (!done[static_cast<std::size_t>(c)]) r[c] = a[c] / b[c];
    return r;
}

/// Not a number once one of them is none, whatever comes after it.
double largest_or_nan(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

}  // namespace

Eigen::MatrixXd conjugate_gradients(const LinearOperator& A, const LinearOperator& preconditioner,
                                    const Eigen::MatrixXd& B, const IterationOptions& options, const char* name,
                                    Control& control, IterationReport* report) {
    // Columns of unit size: whatever the units, no square over- or underflows.
    Eigen::MatrixXd R = B;
    Eigen::RowVectorXd size(B.cols());
    std::vector<char> done(static_cast<std::size_t>(B.cols()), 0);
    for (Eigen::Index c = 0; c < B.cols(); ++c) {
        size[c] = B.col(c).stableNorm();
        if (size[c] > 0.0)
            R.col(c) /= size[c];
        else
            done[static_cast<std::size_t>(c)] = 1;
    }
    Eigen::MatrixXd X = scaled_start(options.start, B.rows(), size);
    if (report != nullptr) *report = {0, 1.0};  // of the right side itself, whose product is to be exact
    if (!X.isZero(0.0)) R -= A.product(X);
    const auto worst = [&] {
        double largest = 0.0;
        for (Eigen::Index c = 0; c < B.cols(); ++c) {
            const double residual = R.col(c).norm();
            if (residual <= options.tolerance) done[static_cast<std::size_t>(c)] = 1;
            largest = largest_or_nan(largest, residual);
        }
        return largest;
    };
    Eigen::MatrixXd Z = preconditioner.product(R), P = Z;
    Eigen::RowVectorXd rz = column_products(R, Z);
    if (report != nullptr) *report = {0, worst()};
    for (int iterations = 0; std::find(done.begin(), done.end(), 0) != done.end(); ++iterations) {
        control.checkpoint();
        const Eigen::MatrixXd AP = A.product(P);
        const Eigen::RowVectorXd alpha = ratio(rz, column_products(P, AP), done);
        X += P * alpha.asDiagonal();
        R -= AP * alpha.asDiagonal();
        const double residual = worst();
        if (report != nullptr) *report = {iterations + 1, residual};
        if (!std::isfinite(residual) || iterations >= options.max_iterations) give_up_iteration(name, residual);
        control.set_progress(std::clamp(std::log(std::max(residual, 1e-300)) / std::log(options.tolerance), 0.0, 1.0));
        Z = preconditioner.product(R);
        const Eigen::RowVectorXd next = column_products(R, Z);
        P = Z + P * ratio(next, rz, done).asDiagonal();
        rz = next;
    }
    return X * size.asDiagonal();
}

}  // namespace elastolab
