#include "base/column_sum.hpp"

#include <algorithm>
#include <cassert>

#include "base/column_kernels.hpp"

namespace elastolab {

void column_sum(const Eigen::VectorXd& rest, const Eigen::MatrixXd& A, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    assert(A.rows() == rest.size() && A.cols() == x.size() && &rest != &y);
    y.resize(rest.size());
    for (Eigen::Index first = 0; first < y.size(); first += kRowsAtOnce)
        column_kernels().sum(rest.data() + first, A.data() + first, A.outerStride(),
                             std::min(kRowsAtOnce, y.size() - first), A.cols(), x.data(), y.data() + first);
}

}  // namespace elastolab
