#include "base/blas.hpp"

#include <gmock/gmock.h>

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

}  // namespace
}  // namespace elastolab
