#include "deform/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

namespace elastolab {

namespace {

/// Inner products of the columns of two matrices.
Eigen::RowVectorXd column_products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.cwiseProduct(b).colwise().sum();
}

/// Not a number once one of them is none, whatever comes after it.
double largest_or_nan(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

/// Columns that still iterate. Each ends by itself.
class ActiveColumns {
public:
    /// size: of the right sides; those that vanish have their answer.
    ActiveColumns(const IterationOptions& options, const Eigen::RowVectorXd& size)
        : options_(options), done_(size.array() <= 0.0) {}

    bool any() const { return !done_.all(); }
    /// Ends those whose residual is small enough; the largest residual of all, or NaN.
    double end_by_residual(const Eigen::MatrixXd& R) {
        double largest = 0.0;
        for (Eigen::Index c = 0; c < R.cols(); ++c) {
            const double residual = R.col(c).norm();
            if (residual <= options_.tolerance) done_[c] = true;
            largest = largest_or_nan(largest, residual);
        }
        return largest;
    }
    /// energy: squares of what the preconditioner takes the energy norm of the error for.
    void end_by_energy(const Eigen::RowVectorXd& energy) {
        if (first_energy_.size() == 0) first_energy_ = energy;
        const double part = options_.energy_tolerance * options_.energy_tolerance;
        if (part > 0.0) done_ = done_ || energy.array() <= part * first_energy_.array();
    }
    /// a / b where the column is not done yet, else 0.
    Eigen::RowVectorXd ratio(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b) const {
        return done_.select(0.0, a.array() / b.array());
    }

private:
    const IterationOptions& options_;
    Eigen::Array<bool, 1, Eigen::Dynamic> done_;
    Eigen::RowVectorXd first_energy_;
};

}  // namespace

Eigen::MatrixXd conjugate_gradients(const LinearOperator& A, const LinearOperator& preconditioner,
                                    const Eigen::MatrixXd& B, const IterationOptions& options, const char* name,
                                    Control& control, IterationReport* report) {
    // Columns of unit size: whatever the units, no square over- or underflows.
    Eigen::MatrixXd R = B;
    Eigen::RowVectorXd size(B.cols());
    for (Eigen::Index c = 0; c < B.cols(); ++c) {
        size[c] = B.col(c).stableNorm();
        if (size[c] > 0.0) R.col(c) /= size[c];
    }
    ActiveColumns active(options, size);
    Eigen::MatrixXd X = scaled_start(options.start, B.rows(), size);
    IterationReport own;
    IterationReport& so_far = report != nullptr ? *report : own;
    so_far = {0, 1.0};  // of the right side itself, whose product is to be exact
    if (!X.isZero(0.0)) R -= A.product(X);
    Eigen::MatrixXd Z = preconditioner.product(R), P = Z;
    Eigen::RowVectorXd rz = column_products(R, Z);
    active.end_by_energy(rz);
    double residual = active.end_by_residual(R);
    so_far.residual = residual;
    for (int iterations = 0; active.any(); ++iterations) {
        if (iterations >= options.max_iterations && !options.must_converge) break;
        control.checkpoint();
        const Eigen::MatrixXd AP = A.product(P);
        const Eigen::RowVectorXd alpha = active.ratio(rz, column_products(P, AP));
        so_far.indefinite = so_far.indefinite || (alpha.array() < 0.0).any();
        if (so_far.indefinite && !options.must_converge) break;
        X += P * alpha.asDiagonal();
        R -= AP * alpha.asDiagonal();
        residual = active.end_by_residual(R);
        so_far.iterations = iterations + 1;
        so_far.residual = residual;
        if (!std::isfinite(residual) || iterations >= options.max_iterations) give_up_iteration(name, residual);
        control.set_progress(std::clamp(std::log(std::max(residual, 1e-300)) / std::log(options.tolerance), 0.0, 1.0));
        if (!active.any()) break;
        Z = preconditioner.product(R);
        const Eigen::RowVectorXd next = column_products(R, Z);
        active.end_by_energy(next);
        P = Z + P * active.ratio(next, rz).asDiagonal();
        rz = next;
    }
    return X * size.asDiagonal();
}

}  // namespace elastolab
