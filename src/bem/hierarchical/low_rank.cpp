#include "bem/hierarchical/low_rank.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <Eigen/SVD>
#include <vector>

#include "base/lapack.hpp"

namespace elastolab {

namespace {

/// A direction of a pivot row is used only if the pivot is at least this part of what the row has anywhere: smaller
/// pivots would multiply errors.
constexpr double kLeastPivot = 0.1;
/// Before the approximation is believed: consecutive crosses below the tolerance, groups of rows sampled, and rows in a
/// group (which mostly cost what one costs).
constexpr int kSmallCrosses = 2, kSamples = 3, kRowsTogether = 8;

class CrossApproximation {
public:
    CrossApproximation(const BlockEntries& entries, PositionRange rows, PositionRange cols, double tolerance)
        : entries_(entries),
          rows_(rows),
          cols_(cols),
          tolerance_(tolerance),
          taken_(static_cast<std::size_t>(rows.size()), 0) {}

    LowRankMatrix run() {
        U_.resize(3 * rows_.size(), 0);
        V_.resize(3 * cols_.size(), 0);
        int n_small = 0;
        for (int row = rows_.size() / 2; row >= 0 && rank_ < limit();) {
            n_small = cross(row) > allowed(rows_.size()) ? 0 : n_small + 1;
            row = next_row();
            if (n_small >= kSmallCrosses || row < 0) {
                n_small = 0;
                row = unconverged_sample();
            }
        }
        return {U_.leftCols(rank_), V_.leftCols(rank_)};
    }

private:
    static constexpr int kDirections = 3;  ///< that one row can give

    /// Size of the error that so many rows may have.
    double allowed(int n_rows) const { return tolerance_ * std::sqrt(norm_square_ * n_rows / rows_.size()); }
    Eigen::Index limit() const { return 3 * std::min(rows_.size(), cols_.size()); }
    int& taken(int row) { return taken_[static_cast<std::size_t>(row)]; }

    Eigen::MatrixXd residual_rows(PositionRange some) const {
        Eigen::MatrixXd values(3 * some.size(), 3 * cols_.size());
        entries_.fill_far({rows_.begin + some.begin, rows_.begin + some.end}, cols_, values);
        values.noalias() -= U_.block(3 * some.begin, 0, values.rows(), rank_) * V_.leftCols(rank_).transpose();
        return values;
    }

    Eigen::MatrixXd residual_column(int col) const {
        Eigen::MatrixXd values(3 * rows_.size(), 3);
        const int at = cols_.begin + col;
        entries_.fill_far(rows_, {at, at + 1}, values);
        values.noalias() -= U_.leftCols(rank_) * V_.block(3 * col, 0, 3, rank_).transpose();
        return values;
    }

    /// Adds the cross through a row; returns the size of what it adds, in the Frobenius norm.
    double cross(int row) {
        const Eigen::Matrix3Xd R = residual_rows({row, row + 1});
        int col = 0;
        double largest = -1.0;
        for (int j = 0; j < cols_.size(); ++j)
            if (const double size = R.middleCols<3>(3 * j).squaredNorm(); size > largest) {
                largest = size;
                col = j;
            }
        last_column_ = {};
        if (!(largest > 0.0)) {
            taken(row) = kDirections;
            return 0.0;
        }
        const Eigen::JacobiSVD<Eigen::Matrix3d> pivot(R.middleCols<3>(3 * col),
                                                      Eigen::ComputeFullU | Eigen::ComputeFullV);
        const Eigen::Matrix3Xd along = pivot.matrixU().transpose() * R;
        int used = 0;
        // What a row has left has no more directions than that; others would be rounding, and count as rank.
        const int left = kDirections - taken(row);
        for (; used < left; ++used) {
            double most = 0.0;
            for (int j = 0; j < cols_.size(); ++j) most = std::max(most, along.row(used).segment<3>(3 * j).norm());
            if (!(pivot.singularValues()[used] >= kLeastPivot * most) || most == 0.0) break;
        }
        if (used == 0) used = 1;  // the pivot was the largest block: its first direction is sound
        taken(row) += used;
        last_column_ = residual_column(col);
        const Eigen::MatrixXd u = last_column_ * pivot.matrixV().leftCols(used) *
                                  pivot.singularValues().head(used).cwiseInverse().asDiagonal();
        return append(u, along.topRows(used).transpose());
    }

    Eigen::MatrixXd widened(const Eigen::MatrixXd& A, Eigen::Index n_rows, Eigen::Index n_columns) const {
        Eigen::MatrixXd wide(n_rows, n_columns);
        if (rank_ > 0) wide.leftCols(rank_) = A.leftCols(rank_);
        return wide;
    }

    double append(const Eigen::MatrixXd& u, const Eigen::MatrixXd& v) {
        if (rank_ + u.cols() > U_.cols()) {
            const Eigen::Index room = std::max<Eigen::Index>(48, 2 * U_.cols());
            U_ = widened(U_, 3 * rows_.size(), room);
            V_ = widened(V_, 3 * cols_.size(), room);
        }
        const Eigen::MatrixXd u_u = u.transpose() * u, v_v = v.transpose() * v;
        const double added = u_u.cwiseProduct(v_v).sum();
        if (rank_ > 0) {
            const Eigen::MatrixXd U_u = U_.leftCols(rank_).transpose() * u, V_v = V_.leftCols(rank_).transpose() * v;
            norm_square_ += 2.0 * U_u.cwiseProduct(V_v).sum();
        }
        norm_square_ = std::max(norm_square_ + added, added);
        U_.middleCols(rank_, u.cols()) = u;
        V_.middleCols(rank_, v.cols()) = v;
        rank_ += u.cols();
        return std::sqrt(std::max(added, 0.0));
    }

    /// The row in which the last pivot column was largest, among those not used up; -1: none.
    int next_row() {
        int best = -1;
        double largest = -1.0;
        for (int i = 0; i < rows_.size(); ++i) {
            if (taken(i) >= kDirections) continue;
            const double size = last_column_.size() > 0 ? last_column_.middleRows<3>(3 * i).squaredNorm() : 0.0;
            if (size > largest) {
                largest = size;
                best = i;
            }
        }
        return best;
    }

    /// Groups of rows that are looked at: a few spread over the block, or all where that costs nothing.
    int n_groups() const {
        const int all = (rows_.size() + kRowsTogether - 1) / kRowsTogether;
        return entries_.are_stored() ? all : std::min(all, kSamples);
    }
    PositionRange group(int g) const {
        const int last = std::max(rows_.size() - kRowsTogether, 0), n = n_groups();
        const int begin = n > 1 ? static_cast<int>(static_cast<std::int64_t>(g) * last / (n - 1)) : last / 2;
        return {begin, std::min(begin + kRowsTogether, rows_.size())};
    }

    /// The worst row of a group in which some are not yet approximated; -1: all are.
    int unconverged_sample() {
        for (; samples_ < n_groups(); ++samples_) {
            const PositionRange some = group(samples_);
            const Eigen::MatrixXd R = residual_rows(some);
            int worst = -1;
            double largest = 3.0 * allowed(1);
            for (int i = 0; i < some.size(); ++i)
                if (const double size = R.middleRows<3>(3 * i).norm();
                    size > largest && taken(some.begin + i) < kDirections) {
                    largest = size;
                    worst = some.begin + i;
                }
            if (worst >= 0) return worst;  // the same group is looked at once more
        }
        return -1;
    }

    const BlockEntries& entries_;
    PositionRange rows_, cols_;
    double tolerance_, norm_square_ = 0.0;
    std::vector<int> taken_;
    Eigen::MatrixXd U_, V_, last_column_;
    Eigen::Index rank_ = 0;
    int samples_ = 0;
};

}  // namespace

LowRankMatrix cross_approximation(const BlockEntries& entries, PositionRange rows, PositionRange cols,
                                  double tolerance) {
    return CrossApproximation(entries, rows, cols, tolerance).run();
}

LowRankMatrix recompressed(const LowRankMatrix& A, double tolerance) {
    if (A.rank() == 0) return A;
    const QrFactorization left(A.U), right(A.V);
    const SingularValues middle = singular_values(left.R() * right.R().transpose());
    const Eigen::VectorXd& sigma = middle.sigma;
    const double allowed = tolerance * tolerance * sigma.squaredNorm();
    Eigen::Index rank = sigma.size();
    for (double dropped = 0.0; rank > 0; --rank) {
        dropped += sigma[rank - 1] * sigma[rank - 1];
        if (dropped > allowed) break;
    }
    return {left.times_Q(middle.U.leftCols(rank) * sigma.head(rank).asDiagonal()),
            right.times_Q(middle.V.leftCols(rank))};
}

}  // namespace elastolab
