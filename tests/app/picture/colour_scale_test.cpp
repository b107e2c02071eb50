#include "app/picture/colour_scale.hpp"

#include <gtest/gtest.h>

#include <string>

namespace elastolab {
namespace {

TEST(ColourScale, PlacesValuesEvenlyOrByTheirLogarithms) {
    const ColourScale even = colour_scale(0.0, 2.0, false), log = colour_scale(0.01, 100.0, true);
    EXPECT_DOUBLE_EQ(even.place(0.5), 0.25);
    EXPECT_DOUBLE_EQ(even.place(-1.0), 0.0);
    EXPECT_DOUBLE_EQ(even.place(7.0), 1.0);
    EXPECT_NEAR(log.place(1.0), 0.5, 1e-12);
    EXPECT_NEAR(log.place(10.0), 0.75, 1e-12);
    EXPECT_EQ(log.place(0.0), 0.0);
    EXPECT_EQ(colour_scale(1.0, 1.0, false).place(1.0), 0.5);
}

TEST(ColourScale, BeginsAtAThousandthWhereZeroIsTheLeast) {
    const ColourScale scale = colour_scale(0.0, 50.0, true);
    EXPECT_TRUE(scale.logarithmic);
    EXPECT_DOUBLE_EQ(scale.low, 0.05);
    EXPECT_FALSE(colour_scale(-3.0, 0.0, true).logarithmic) << "nothing to take a logarithm of";
}

TEST(ColourScale, HasRoundTicksWithinItsRange) {
    for (const auto& [low, high] : {std::pair(1e-3, 1.0), {2.0, 30.0}, {1e-9, 1e9}, {0.9, 1.3}}) {
        const ColourScale scale = colour_scale(low, high, true);
        const std::vector<LegendTick> ticks = scale.ticks(5);
        EXPECT_GE(ticks.size(), 1u) << low;
        EXPECT_LE(ticks.size(), 9u) << low;
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            EXPECT_NEAR(std::stod(ticks[i].text), ticks[i].value, 1e-3 * ticks[i].value);
            EXPECT_GE(ticks[i].value, low * (1.0 - 1e-9));
            EXPECT_LE(ticks[i].value, high * (1.0 + 1e-9));
            if (i == 0) continue;
            EXPECT_GT(ticks[i].value, ticks[i - 1].value);
        }
    }
}

}  // namespace
}  // namespace elastolab
