#include "base/strips.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/cholesky.hpp"
#include "base/lapack.hpp"

namespace elastolab {
namespace {

TEST(Strips, CoverEveryColumnOnce) {
    for (const Eigen::Index n : {0, 1, 63, 64, 65, 400, 5000}) {
        std::vector<int> times(static_cast<std::size_t>(n), 0);
        for_strips(n, [&](Eigen::Index first, Eigen::Index count) {
            for (Eigen::Index i = first; i < first + count; ++i) ++times[static_cast<std::size_t>(i)];
        });
        for (const int count : times) EXPECT_EQ(count, 1) << n;
    }
}

/// Factors and solutions for 300 right sides of a matrix of 900 rows.
struct Solved {
    Eigen::MatrixXd by_lu, by_cholesky;

    explicit Solved(int n_threads) {
        std::srand(3);
        const Eigen::MatrixXd A = Eigen::MatrixXd::Random(900, 900), B = Eigen::MatrixXd::Random(900, 300);
        const Eigen::MatrixXd spd = A * A.transpose() + 10.0 * Eigen::MatrixXd::Identity(900, 900);
        const int before = thread_count();
        set_thread_count(n_threads);
        by_lu = LuFactorization(Eigen::MatrixXd(A), "A").solve(B);
        by_cholesky = B;
        CholeskyFactorization(Eigen::MatrixXd(spd), "spd").solve_in_place(by_cholesky);
        set_thread_count(before);
        EXPECT_LT((A * by_lu - B).norm(), 1e-9 * B.norm());
        EXPECT_LT((spd * by_cholesky - B).norm(), 1e-9 * B.norm());
    }
};

TEST(Strips, GiveTheSameSolutionsWhateverTheNumberOfThreads) {
    const Solved one(1), three(3);
    EXPECT_EQ(one.by_lu, three.by_lu);
    EXPECT_EQ(one.by_cholesky, three.by_cholesky);
}

}  // namespace
}  // namespace elastolab
