#include "render/drawing/legend.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace elastolab {
namespace {

std::vector<std::string> texts(double low, double high, int n) {
    std::vector<std::string> result;
    for (const LegendTick& tick : legend_ticks(low, high, n)) result.push_back(tick.text);
    return result;
}

using testing::ElementsAre;

TEST(Legend, HasRoundNumbers) {
    EXPECT_THAT(texts(0.0, 1.0, 5), ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1.0"));
    EXPECT_THAT(texts(-3.1, 12.0, 4), ElementsAre("0", "5", "10"));
    EXPECT_THAT(texts(997.3, 998.1, 4), ElementsAre("997.4", "997.6", "997.8", "998.0"));
}

TEST(Legend, UsesExponentsForVeryLargeAndVerySmallNumbers) {
    EXPECT_THAT(texts(0.0, 2.4e7, 3), ElementsAre("0", "1e+07", "2e+07"));
    EXPECT_THAT(texts(0.0, 1.6e5, 4), ElementsAre("0", "0.5e+05", "1.0e+05", "1.5e+05"));
    EXPECT_THAT(texts(1e-9, 3e-9, 2), ElementsAre("1e-09", "2e-09", "3e-09"));
    EXPECT_THAT(texts(1.0e6, 1.2e6, 2), ElementsAre("1.0e+06", "1.1e+06", "1.2e+06"));
}

TEST(Legend, HasOneTickForOneValueAndNoneForNonsense) {
    EXPECT_THAT(texts(0.25, 0.25, 5), ElementsAre("0.25"));
    EXPECT_TRUE(legend_ticks(1.0, 0.0, 5).empty());
    EXPECT_TRUE(legend_ticks(0.0, std::numeric_limits<double>::infinity(), 5).empty());
    EXPECT_TRUE(legend_ticks(std::nan(""), 1.0, 5).empty());
}

TEST(Legend, TellsItsTicksApartAndStaysInTheRange) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<> exponent(-12, 12), sign(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const double a = sign(engine) * std::pow(10, exponent(engine)), b = a + std::pow(10, exponent(engine));
        const std::vector<LegendTick> ticks = legend_ticks(a, b, 6);
        if (b - a < 1e-6 * std::abs(a)) continue;
        std::set<std::string> different;
        for (const LegendTick& tick : ticks) {
            different.insert(tick.text);
            EXPECT_GE(tick.value, a - 1e-6 * (b - a));
            EXPECT_LE(tick.value, b + 1e-6 * (b - a));
            EXPECT_NEAR(std::stod(tick.text), tick.value, 1e-3 * (b - a));
        }
        EXPECT_EQ(different.size(), ticks.size()) << a << " " << b;
        EXPECT_GE(ticks.size(), 2u);
        EXPECT_LE(ticks.size(), 7u);
    }
}

}  // namespace
}  // namespace elastolab
