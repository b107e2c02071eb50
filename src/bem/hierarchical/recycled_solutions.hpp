#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

namespace elastolab {

/// Solutions of a linear problem that is solved by iteration: a right-hand side that is a linear combination of earlier
/// ones needs no further iteration. Those known less exactly than asked for are what the next iteration starts from.
/// Any thread may use it.
class RecycledSolutions {
public:
    /// Solutions for these right-hand sides, one a column, from start, which is near them or zero.
    using Compute =
        std::function<Eigen::MatrixXd(const Eigen::MatrixXd& right_hand_sides, const Eigen::MatrixXd& start)>;

    /// right_hand_sides: one a column. compute: solutions to this tolerance for those that are new, n_rows rows each.
    Eigen::MatrixXd get(const Eigen::MatrixXd& right_hand_sides, Eigen::Index n_rows, double tolerance,
                        const Compute& compute);

private:
    using Columns = std::vector<Eigen::Index>;
    /// Of one tolerance.
    struct Kept {
        Eigen::MatrixXd right_hand_sides, solutions;
        /// Fills those of these columns of solutions that are combinations; returns the others.
        Columns combine(const Eigen::MatrixXd& right_hand_sides, const Columns& columns,
                        Eigen::MatrixXd& solutions) const;
        void add(const Eigen::MatrixXd& right_hand_sides, const Eigen::MatrixXd& solutions);
    };
    Columns combine(const Eigen::MatrixXd& right_hand_sides, double tolerance, Eigen::MatrixXd& solutions);

    std::mutex mutex_;
    std::map<double, Kept> kept_;  ///< by tolerance
};

}  // namespace elastolab
