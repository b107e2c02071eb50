#include "bem/hierarchical/recycled_solutions.hpp"

#include "base/lapack.hpp"

namespace elastolab {

namespace {

/// Columns that are kept, and what a combination of them may miss.
constexpr Eigen::Index kMostKept = 16;
constexpr double kCombined = 1e-12;

/// The columns of two matrices side by side; the first may be empty.
Eigen::MatrixXd beside(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
    if (left.cols() == 0) return right;
    Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
    both << left, right;
    return both;
}

}  // namespace

Eigen::MatrixXd RecycledSolutions::get(const Eigen::MatrixXd& right_hand_sides, Eigen::Index n_rows,
                                       const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& compute) {
    Eigen::MatrixXd solutions(n_rows, right_hand_sides.cols());
    const std::vector<Eigen::Index> others = combine(right_hand_sides, solutions);
    if (others.empty()) return solutions;
    const Eigen::MatrixXd new_sides = right_hand_sides(Eigen::all, others), computed = compute(new_sides);
    solutions(Eigen::all, others) = computed;
    keep(new_sides, computed);
    return solutions;
}

std::vector<Eigen::Index> RecycledSolutions::combine(const Eigen::MatrixXd& right_hand_sides,
                                                     Eigen::MatrixXd& solutions) {
    const std::scoped_lock lock(mutex_);
    std::vector<Eigen::Index> others;
    Eigen::MatrixXd shares(right_hand_sides_.cols(), right_hand_sides.cols()), missed = -right_hand_sides;
    if (shares.rows() > 0) {
        shares = solve_minimum_norm(right_hand_sides_, right_hand_sides, kCombined).X;
        missed.noalias() += right_hand_sides_ * shares;
    }
    for (Eigen::Index c = 0; c < right_hand_sides.cols(); ++c)
        if (!(missed.col(c).stableNorm() <=
              kCombined * right_hand_sides.col(c).stableNorm()))  // nor if it is not finite
            others.push_back(c);
        else if (shares.rows() > 0)
            solutions.col(c) = solutions_ * shares.col(c);
        else
            solutions.col(c).setZero();
    return others;
}

void RecycledSolutions::keep(const Eigen::MatrixXd& right_hand_sides, const Eigen::MatrixXd& solutions) {
    if (!right_hand_sides.allFinite() || !solutions.allFinite()) return;
    const std::scoped_lock lock(mutex_);
    if (right_hand_sides_.cols() + solutions.cols() <= kMostKept) {
        right_hand_sides_ = beside(right_hand_sides_, right_hand_sides);
        solutions_ = beside(solutions_, solutions);
    } else if (solutions.cols() <= kMostKept) {
        right_hand_sides_ = right_hand_sides;
        solutions_ = solutions;
    }
}

}  // namespace elastolab
