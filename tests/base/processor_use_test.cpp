#include "base/processor_use.hpp"

#include <gtest/gtest.h>

#include "base/timer.hpp"

namespace elastolab {
namespace {

TEST(ProcessorUse, SlowsDownByTheShareThatOthersTake) {
    const ProcessorUse before{.all = 100.0, .idle = 60.0, .own = 5.0};
    const auto slowdown = [&](double idle, double own, double others) {
        return slowdown_by_others(
            before, {.all = before.all + idle + own + others, .idle = before.idle + idle, .own = before.own + own});
    };
    EXPECT_EQ(slowdown(2.0, 0.0, 0.0), 1.0);
    EXPECT_EQ(slowdown(0.0, 2.0, 0.0), 1.0);
    EXPECT_EQ(slowdown(1.0, 0.0, 1.0), 1.5) << "two threads of this program will run on two processors beside one more";
    EXPECT_EQ(slowdown(0.0, 1.0, 1.0), 2.0) << "shared already";
    EXPECT_EQ(slowdown(0.0, 0.5, 1.5), 4.0);
    EXPECT_EQ(slowdown(0.0, 0.0, 2.0), 2.0) << "others want as many as there are, or more: that cannot be seen";
    EXPECT_EQ(slowdown(0.0, 0.25, 3.75), 1.9375);
    EXPECT_EQ(slowdown(0.0, 0.0, 0.0), 1.0) << "no time has passed";
}

TEST(ProcessorUse, OfThisProgramGrowsAsItComputes) {
    const auto before = processor_use();
    if (!before) GTEST_SKIP() << "the system does not tell";
    const Stopwatch watch;
    while (watch.seconds() < 0.05) {
    }
    const auto after = processor_use();
    ASSERT_TRUE(after);
    EXPECT_GT(after->own, before->own);
    EXPECT_GE(after->all, before->all);
    EXPECT_GE(after->all, after->idle);
}

}  // namespace
}  // namespace elastolab
