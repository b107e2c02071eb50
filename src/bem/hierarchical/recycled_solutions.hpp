#pragma once

#include <Eigen/Core>
#include <functional>
#include <mutex>
#include <vector>

namespace elastolab {

/// Solutions of a linear problem that is solved by iteration: a right-hand side that is a linear combination of earlier
/// ones needs no further iteration. Any thread may use it.
class RecycledSolutions {
public:
    /// right_hand_sides: one a column. compute: solutions for those that are new, as many columns, n_rows rows each.
    Eigen::MatrixXd get(const Eigen::MatrixXd& right_hand_sides, Eigen::Index n_rows,
                        const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& compute);

private:
    /// Fills the columns that are combinations; returns the numbers of the others.
    std::vector<Eigen::Index> combine(const Eigen::MatrixXd& right_hand_sides, Eigen::MatrixXd& solutions);
    void keep(const Eigen::MatrixXd& right_hand_sides, const Eigen::MatrixXd& solutions);

    std::mutex mutex_;
    Eigen::MatrixXd right_hand_sides_, solutions_;
};

}  // namespace elastolab
