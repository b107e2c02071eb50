#include "base/memory.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace elastolab {
namespace {

TEST(Memory, ThatIsWrittenIsResident) {
    constexpr std::uint64_t kWritten = 64u << 20;
    const std::uint64_t before = resident_memory_bytes();
    const std::vector<char> written(kWritten, 1);
    EXPECT_GE(resident_memory_bytes(), before + kWritten / 2 + static_cast<std::uint64_t>(written.back()));
    EXPECT_LE(resident_memory_bytes(), peak_memory_bytes() + (1u << 20));
}

}  // namespace
}  // namespace elastolab
