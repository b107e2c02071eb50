#include "bem/hierarchical/recycled_solutions.hpp"

#include "base/lapack.hpp"

namespace elastolab {

namespace {

/// Columns that are kept, and what a combination of them may miss.
constexpr Eigen::Index kMostKept = 16;
constexpr double kCombined = 1e-12;
/// Errors of the kept solutions add up in a combination, by their shares. Shares that would make them larger than this
/// many times the tolerance come from right-hand sides that are nearly parallel: such a combination is solved for.
constexpr double kMostAmplified = 8.0;

/// The columns of two matrices side by side; the first may be empty.
Eigen::MatrixXd beside(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
    if (left.cols() == 0) return right;
    Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
    both << left, right;
    return both;
}

}  // namespace

Eigen::MatrixXd RecycledSolutions::get(const Eigen::MatrixXd& right_hand_sides, Eigen::Index n_rows, double tolerance,
                                       const Compute& compute) {
    Eigen::MatrixXd solutions = Eigen::MatrixXd::Zero(n_rows, right_hand_sides.cols());
    const Columns others = combine(right_hand_sides, tolerance, solutions);
    if (others.empty()) return solutions;
    const Eigen::MatrixXd new_sides = right_hand_sides(Eigen::all, others);
    const Eigen::MatrixXd computed = compute(new_sides, solutions(Eigen::all, others));
    solutions(Eigen::all, others) = computed;
    if (new_sides.allFinite() && computed.allFinite()) {
        const std::scoped_lock lock(mutex_);
        kept_[tolerance].add(new_sides, computed);
    }
    return solutions;
}

/// Returns the columns that are not known to the tolerance; there, solutions are what is known most exactly.
RecycledSolutions::Columns RecycledSolutions::combine(const Eigen::MatrixXd& right_hand_sides, double tolerance,
                                                      Eigen::MatrixXd& solutions) {
    Columns others;
    for (Eigen::Index c = 0; c < right_hand_sides.cols(); ++c)
        if (!right_hand_sides.col(c).isZero(0.0)) others.push_back(c);
    const std::scoped_lock lock(mutex_);
    const auto first_coarse = kept_.upper_bound(tolerance);
    for (auto kept = kept_.begin(); kept != first_coarse; ++kept)
        others = kept->second.combine(right_hand_sides, others, solutions);
    Columns unknown = others;
    for (auto kept = first_coarse; kept != kept_.end(); ++kept)
        unknown = kept->second.combine(right_hand_sides, unknown, solutions);
    return others;
}

RecycledSolutions::Columns RecycledSolutions::Kept::combine(const Eigen::MatrixXd& sides, const Columns& columns,
                                                            Eigen::MatrixXd& answers) const {
    if (columns.empty() || right_hand_sides.cols() == 0) return columns;  // nothing is kept of too many at once
    const Eigen::MatrixXd wanted = sides(Eigen::all, columns);
    const Eigen::MatrixXd shares = solve_minimum_norm(right_hand_sides, wanted, kCombined).X;
    const Eigen::MatrixXd missed = right_hand_sides * shares - wanted;
    const Eigen::RowVectorXd errors = right_hand_sides.colwise().stableNorm() * shares.cwiseAbs();
    Columns others;
    for (Eigen::Index c = 0; c < wanted.cols(); ++c) {
        const Eigen::Index column = columns[static_cast<std::size_t>(c)];
        const double size = wanted.col(c).stableNorm();
        if (missed.col(c).stableNorm() <= kCombined * size && errors[c] <= kMostAmplified * size)
            answers.col(column) = solutions * shares.col(c);
        else  // or it is not finite
            others.push_back(column);
    }
    return others;
}

void RecycledSolutions::Kept::add(const Eigen::MatrixXd& sides, const Eigen::MatrixXd& answers) {
    if (right_hand_sides.cols() + sides.cols() <= kMostKept) {
        right_hand_sides = beside(right_hand_sides, sides);
        solutions = beside(solutions, answers);
    } else if (sides.cols() <= kMostKept) {
        right_hand_sides = sides;
        solutions = answers;
    }
}

}  // namespace elastolab
