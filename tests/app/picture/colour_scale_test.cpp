#include "app/picture/colour_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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

TEST(ColourScale, StaysFiniteAtTheEndsOfWhatNumbersCanBe) {
    const double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
    for (const double high : {std::numeric_limits<double>::infinity(), largest, 1e-300, least})
        for (const double low : {0.0, least, 1e-300, 1.0}) {
            const ColourScale scale = colour_scale(low, high, true);
            EXPECT_LE(scale.ticks(5).size(), 9u) << low << " to " << high;
            if (std::isfinite(high)) {
                EXPECT_TRUE(std::isfinite(scale.place(0.5 * high))) << low << " to " << high;
            }
        }
    EXPECT_FALSE(colour_scale(0.0, least, true).logarithmic) << "a thousandth of it is zero";
    const std::vector<LegendTick> ticks = colour_scale(1e-300, 1e300, true).ticks(5);
    ASSERT_GE(ticks.size(), 3u);
    EXPECT_DOUBLE_EQ(std::log10(ticks[1].value) - std::log10(ticks[0].value),
                     std::log10(ticks[2].value) - std::log10(ticks[1].value));
}

TEST(ColourScale, HasOneColourInEachBand) {
    EXPECT_EQ(place_on_map(0.123, false), 0.123);
    for (const double place : {0.0, 0.05, 0.0999}) EXPECT_DOUBLE_EQ(place_on_map(place, true), 0.05);
    EXPECT_DOUBLE_EQ(place_on_map(0.1001, true), 0.15);
    EXPECT_DOUBLE_EQ(place_on_map(1.0, true), 0.95);
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
