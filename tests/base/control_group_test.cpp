#include "base/control_group.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <thread>

#include "base/machine.hpp"
#include "base/memory.hpp"
#include "support/one_core.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

/// A hierarchy of control groups as the kernel shows it, made of plain files.
class ControlGroupTest : public testing::Test {
protected:
    void add(const std::string& group, const std::string& max, std::uint64_t current, const std::string& stat = "") {
        const auto at = folder_.path() / group;
        create_directories(at);
        folder_.write(group + "/memory.max", max + "\n");
        folder_.write(group + "/memory.current", std::to_string(current) + "\n");
        folder_.write(group + "/memory.stat", stat);
    }
    std::uint64_t available(const std::string& group) const { return control_group_available(folder_.path(), group); }

    test::TemporaryFolder folder_;
};

TEST_F(ControlGroupTest, IsAsNarrowAsTheNarrowestGroupAround) {
    add("a", "1000", 100);
    add("a/b", "max", 80);
    add("a/b/c", "5000", 70);
    add("other", "1", 1);
    EXPECT_EQ(available("/a/b/c"), 900U);
    EXPECT_EQ(available("/a"), 900U);
    EXPECT_EQ(available("/"), kUnlimited);
    add("a/b/c", "200", 70);
    EXPECT_EQ(available("/a/b/c"), 130U);
    add("a/b/c", "200", 300);
    EXPECT_EQ(available("/a/b/c"), 0U);
}

TEST_F(ControlGroupTest, DoesNotCountWhatTheKernelGivesUp) {
    add("a", "1000", 950, "anon 100\nfile 700\ninactive_file 600\nactive_file 100\nslab_reclaimable 50\n");
    EXPECT_EQ(available("/a"), 700U);
}

TEST_F(ControlGroupTest, CountsTheSoftLimit) {
    add("a", "max", 100);
    folder_.write("a/memory.high", "400\n");
    EXPECT_EQ(available("/a"), 300U);
}

TEST_F(ControlGroupTest, TakesTheMountedRootWhenTheNameLeadsOutOfIt) {
    add(".", "1000", 400);
    EXPECT_EQ(available("/../../elsewhere"), 600U);
    EXPECT_EQ(available("/gone"), 600U);
}

TEST_F(ControlGroupTest, KnowsTheFirstVersion) {
    create_directories(folder_.path() / "a");
    folder_.write("a/memory.limit_in_bytes", "1000\n");
    folder_.write("a/memory.usage_in_bytes", "900\n");
    folder_.write("a/memory.stat", "inactive_file 10\ntotal_inactive_file 300\n");
    EXPECT_EQ(available("/a"), 400U);
}

TEST_F(ControlGroupTest, KnowsQuotasOfProcessorTime) {
    const auto processors = [&](const char* group) { return control_group_processors(folder_.path(), group); };
    add("a/b", "max", 1);
    EXPECT_TRUE(std::isinf(processors("/a/b")));
    folder_.write("a/cpu.max", "150000 100000\n");
    folder_.write("a/b/cpu.max", "max 100000\n");
    EXPECT_EQ(processors("/a/b"), 1.5);
    folder_.write("a/b/cpu.max", "5000 10000\n");
    EXPECT_EQ(processors("/a/b"), 0.5);
    EXPECT_TRUE(std::isinf(processors("/")));
    add("old", "max", 1);
    folder_.write("old/cpu.cfs_period_us", "100000\n");
    folder_.write("old/cpu.cfs_quota_us", "-1\n");
    EXPECT_TRUE(std::isinf(processors("/old")));
    folder_.write("old/cpu.cfs_quota_us", "250000\n");
    EXPECT_EQ(processors("/old"), 2.5);
}

TEST_F(ControlGroupTest, IsFoundAmongTheHierarchiesOfBothVersions) {
    std::istringstream mixed("12:memory:/v1\n1:name=systemd:/x\n0::/user.slice/run.scope\n"), old("12:memory:/v1\n");
    EXPECT_EQ(control_group_of(mixed), "/user.slice/run.scope");
    EXPECT_EQ(control_group_of(old), "/");
    std::istringstream again("12:memory:/v1\n0::/unified\n");
    EXPECT_EQ(control_group_of(again, "memory"), "/v1");
}

TEST(Machine, HasTheCoresThatThisProcessMayUse) {
    EXPECT_GE(available_cores(), 1);
    EXPECT_LE(available_cores(), static_cast<int>(std::thread::hardware_concurrency()));
    const test::OneCore one_core;
    EXPECT_EQ(available_cores(), 1);
}

TEST(Memory, ThereIsSome) {
    EXPECT_GT(available_memory_bytes(), std::uint64_t{1} << 20);
    EXPECT_LT(available_memory_bytes(), kUnlimited);
}

}  // namespace
}  // namespace elastolab
