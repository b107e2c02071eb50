#include "base/mixed_product.hpp"

#include <algorithm>

#include "base/column_kernels.hpp"

namespace elastolab {

void add_mixed_product(const Eigen::Ref<const Eigen::MatrixXf>& A, const Eigen::Ref<const Eigen::MatrixXd>& X,
                       Eigen::Ref<Eigen::MatrixXd> Y) {
    for (Eigen::Index first = 0; first < A.rows(); first += kRowsAtOnce)
        for (Eigen::Index c = 0; c < X.cols(); ++c)
            column_kernels().add(A.data() + first, A.outerStride(), std::min(kRowsAtOnce, A.rows() - first), A.cols(),
                                 X.col(c).data(), Y.col(c).data() + first);
}

Eigen::MatrixXd transposed_mixed_product(const Eigen::Ref<const Eigen::MatrixXf>& A,
                                         const Eigen::Ref<const Eigen::MatrixXd>& X) {
    Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(A.cols(), X.cols());
    for (Eigen::Index first = 0; first < A.rows(); first += kRowsAtOnce)
        for (Eigen::Index c = 0; c < X.cols(); ++c)
            column_kernels().add_transposed(A.data() + first, A.outerStride(), std::min(kRowsAtOnce, A.rows() - first),
                                            A.cols(), X.col(c).data() + first, Y.col(c).data());
    return Y;
}

}  // namespace elastolab
