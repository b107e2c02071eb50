#include "base/blas.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

namespace elastolab {
namespace {

#if defined(__x86_64__)
bool has_avx512() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}

TEST(Blas, KernelsAreThoseAskedForOrUseTheVectorInstructionsOfThisCpu) {
    using testing::StartsWith;
    // By a person, or by the program itself before it started anew.
    if (const char* asked = std::getenv("OPENBLAS_CORETYPE")) {
        EXPECT_THAT(blas_kernels(), testing::StrCaseEq(asked));
        return;
    }
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "any kernels will do on this CPU";
    for (const char* old : {"Prescott", "Core2", "Nehalem", "Sandybridge"})
        EXPECT_THAT(blas_kernels(), testing::Not(StartsWith(old)));
    if (!has_avx512()) return;
    for (const char* half : {"Haswell", "Zen"}) EXPECT_THAT(blas_kernels(), testing::Not(StartsWith(half)));
}
#endif

}  // namespace
}  // namespace elastolab
