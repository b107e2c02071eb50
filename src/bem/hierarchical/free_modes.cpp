#include "bem/hierarchical/free_modes.hpp"

#include <algorithm>
#include <utility>

#include "base/lapack.hpp"
#include "bem/hierarchical/item_rows.hpp"

namespace elastolab {

namespace {

/// A rigid motion counts as free when the constrained vertices see less than this part of what they see of another.
constexpr double kUnseen = 1e-9;

}  // namespace

Eigen::MatrixXd unseen_modes(const Eigen::MatrixXd& modes, const std::vector<int>& items) {
    const Eigen::Index n_seen_rows = 3 * std::ssize(items);
    Eigen::MatrixXd seen =
        Eigen::MatrixXd::Zero(std::max(n_seen_rows, modes.cols()), modes.cols());  // so that V is square
    seen.topRows(n_seen_rows) = rows_of(modes, items);
    const SingularValues svd = singular_values(std::move(seen));
    const auto n_seen = (svd.sigma.array() > kUnseen * svd.sigma[0]).count();
    return modes * svd.V.rightCols(modes.cols() - n_seen);
}

void orthogonalise(Eigen::MatrixXd& X, const Eigen::MatrixXd& N) {
    if (N.cols() > 0) X.noalias() -= N * (N.transpose() * X).eval();
}

}  // namespace elastolab
