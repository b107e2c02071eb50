#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "cli/matrix_market.hpp"
#include "cli/npy.hpp"
#include "cli/program.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

TEST(Npy, HoldsTheMatrixAsItIs) {
    const test::TemporaryFolder folder;
    for (const int rows : {1, 7, 1000}) {
        const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(rows, 3);
        const auto file = folder.path() / "m.npy";
        {
            std::ofstream out(file, std::ios::binary);
            write_npy(out, matrix);
        }
        const test::NpyFile npy = test::read_npy(file);
        ASSERT_EQ(npy.rows, rows);
        ASSERT_EQ(npy.columns, 3);
        EXPECT_EQ(Eigen::Map<const Eigen::MatrixXd>(npy.values.data(), rows, 3), matrix);
    }
}

Eigen::SparseMatrix<double> sparse(double upper) {
    Eigen::SparseMatrix<double> matrix(3, 3);
    matrix.insert(0, 0) = 1.0 / 3.0;
    matrix.insert(2, 0) = -2.0;
    matrix.insert(0, 2) = upper;
    return matrix;
}

TEST(MatrixMarket, StoresTheLowerTriangleOfASymmetricMatrix) {
    std::ostringstream out;
    write_matrix_market(out, sparse(-2.0));
    EXPECT_EQ(out.str(), "%%MatrixMarket matrix coordinate real symmetric\n3 3 2\n1 1 0.33333333333333331\n3 1 -2\n");
}

TEST(MatrixMarket, StoresEveryEntryOfAnother) {
    std::ostringstream out;
    write_matrix_market(out, sparse(-2.0000000000000004));
    EXPECT_EQ(out.str(),
              "%%MatrixMarket matrix coordinate real general\n3 3 3\n1 1 0.33333333333333331\n3 1 -2\n"
              "1 3 -2.0000000000000004\n");
}

}  // namespace
}  // namespace elastolab
