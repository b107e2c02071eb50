#include <gtest/gtest.h>

#include "base/mixed_product.hpp"

namespace elastolab {
namespace {

/// Sizes around the lanes, the columns and the rows that are taken at once.
TEST(MixedProduct, AgreesWithThatOfACopyInDoublePrecision) {
    for (const Eigen::Index rows : {1, 7, 16, 33, 1023, 1024, 2100})
        for (const Eigen::Index cols : {1, 3, 4, 5, 9}) {
            const Eigen::MatrixXf outer = Eigen::MatrixXf::Random(rows + 3, cols + 1);
            const auto A = outer.block(2, 1, rows, cols);
            const Eigen::MatrixXd wide = A.cast<double>(), X = Eigen::MatrixXd::Random(cols, 3),
                                  T = Eigen::MatrixXd::Random(rows, 3), start = Eigen::MatrixXd::Random(rows, 3);
            Eigen::MatrixXd Y = start;
            add_mixed_product(A, X, Y);
            EXPECT_LT((Y - (start + wide * X)).cwiseAbs().maxCoeff(), 1e-14 * static_cast<double>(cols))
                << rows << " x " << cols;
            EXPECT_LT((transposed_mixed_product(A, T) - wide.transpose() * T).cwiseAbs().maxCoeff(),
                      1e-14 * static_cast<double>(rows))
                << rows << " x " << cols;
        }
}

}  // namespace
}  // namespace elastolab
