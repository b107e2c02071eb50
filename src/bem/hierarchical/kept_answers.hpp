#pragma once

#include <Eigen/Core>
#include <functional>
#include <mutex>
#include <vector>

namespace elastolab {

/// Answers of a linear problem that is solved by iteration: a question that is a linear combination of earlier ones
/// needs no further iteration. Any thread may use it.
class KeptAnswers {
public:
    /// questions: one a column. compute: answers to those that are new, as many columns, n_rows rows each.
    Eigen::MatrixXd get(const Eigen::MatrixXd& questions, Eigen::Index n_rows,
                        const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& compute);

private:
    /// Fills the columns that are combinations; returns the numbers of the others.
    std::vector<Eigen::Index> combine(const Eigen::MatrixXd& questions, Eigen::MatrixXd& answers);
    void keep(const Eigen::MatrixXd& questions, const Eigen::MatrixXd& answers);

    std::mutex mutex_;
    Eigen::MatrixXd questions_, answers_;
};

}  // namespace elastolab
