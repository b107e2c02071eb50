#include "deform/columns.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <vector>

#include "support/wait_until.hpp"

namespace elastolab {
namespace {

std::vector<Columns::Block> zeros(const std::vector<ColumnKey>& missing) {
    return std::vector<Columns::Block>(missing.size(), std::make_shared<const Eigen::MatrixXd>(3, 1));
}

std::uint64_t few_bytes(const ColumnKey&) { return 24; }

TEST(ColumnCache, WaitsForAnotherThreadUntilItIsCancelled) {
    ColumnCache cache(1 << 20);
    std::atomic<bool> computes = false, may_end = false;
    auto other = std::async(std::launch::async, [&] {
        const Control control;
        cache.get(
            {{0}}, few_bytes,
            [&](const std::vector<ColumnKey>& missing) {
                computes = true;
                test::wait_until([&] { return may_end.load(); });
                return zeros(missing);
            },
            control);
    });
    ASSERT_TRUE(test::wait_until([&] { return computes.load(); }));
    Control control;
    auto waiting = std::async(std::launch::async, [&] { cache.get({{0}}, few_bytes, zeros, control); });
    EXPECT_EQ(waiting.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
    control.cancel();
    EXPECT_TRUE(test::wait_until([&] { return waiting.wait_for(std::chrono::seconds(0)) == std::future_status::ready; },
                                 std::chrono::seconds(10)));
    EXPECT_FALSE(may_end) << "the other thread computes still";
    may_end = true;
    EXPECT_THROW(waiting.get(), Cancelled);
    other.get();
    EXPECT_EQ(cache.get({{0}}, few_bytes, zeros, Control()).cols(), 1);
}

}  // namespace
}  // namespace elastolab
