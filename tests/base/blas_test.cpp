#include "base/blas.hpp"

#include <cblas.h>
#include <gmock/gmock.h>

#include <memory>

namespace elastolab {
namespace {

#if defined(__x86_64__)
/// Run without OPENBLAS_CORETYPE, by which a person may ask for slow ones.
TEST(Blas, KernelsUseTheVectorInstructionsOfThisCpu) {
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "any kernels will do on this CPU";
    for (const char* without : {"Prescott", "Core2", "Penryn", "Dunnington", "Nehalem", "Sandybridge"})
        EXPECT_THAT(blas_kernels(), testing::Not(testing::StartsWith(without)));
}
#endif

class BlasThreadsTest : public testing::Test {
protected:
    BlasThreadsTest() { set_thread_count(3); }
    ~BlasThreadsTest() override { set_thread_count(before_); }

private:
    int before_ = thread_count();
};

TEST_F(BlasThreadsTest, AreOneForLoopsThatCallTheBlas) {
    ASSERT_EQ(openblas_get_num_threads(), 3);
    {
        const SerialBlas loop;
        EXPECT_EQ(openblas_get_num_threads(), 1);
        const SerialBlas another;
        set_thread_count(2);
        EXPECT_EQ(openblas_get_num_threads(), 1) << "the loop goes on";
        EXPECT_EQ(thread_count(), 2);
    }
    EXPECT_EQ(openblas_get_num_threads(), 2);
}

/// Of which this thread is one, and knows nothing of the other.
TEST_F(BlasThreadsTest, AreAllForAFactorisationWhateverOtherWorkersDo) {
    auto loop = std::make_unique<SerialBlas>();
    {
        const ParallelBlas factorisation;
        EXPECT_EQ(openblas_get_num_threads(), 3);
        const SerialBlas another;
        EXPECT_EQ(openblas_get_num_threads(), 3);
    }
    EXPECT_EQ(openblas_get_num_threads(), 1);
    loop.reset();
    EXPECT_EQ(openblas_get_num_threads(), 3);
}

}  // namespace
}  // namespace elastolab
