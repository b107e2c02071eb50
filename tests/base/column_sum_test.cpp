#include <gtest/gtest.h>

#include "base/column_sum.hpp"

namespace elastolab {
namespace {

/// Sizes around the lanes, the columns and the rows that are taken at once.
TEST(ColumnSum, IsThatOfEigen) {
    for (const Eigen::Index rows : {0, 1, 7, 16, 33, 1023, 1024, 1025, 2100})
        for (const Eigen::Index cols : {0, 1, 2, 3, 4, 5, 6, 12}) {
            const Eigen::MatrixXd A = Eigen::MatrixXd::Random(rows, cols);
            const Eigen::VectorXd rest = Eigen::VectorXd::Random(rows), x = Eigen::VectorXd::Random(cols);
            Eigen::VectorXd y = Eigen::VectorXd::Constant(5, 7.0);
            column_sum(rest, A, x, y);
            ASSERT_EQ(y.size(), rows);
            EXPECT_TRUE((y - (rest + A * x)).isZero(1e-14)) << rows << " x " << cols;
        }
}

}  // namespace
}  // namespace elastolab
