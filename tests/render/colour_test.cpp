#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "render/colour.hpp"
#include "render/colour_map.hpp"

namespace elastolab {
namespace {

using testing::HasSubstr;

constexpr double kSinglePrecision = 3e-5;  // colours are floats, whose rounding OKLab enlarges in the dark

TEST(Colour, KnowsTheWhiteAndTheGreysOfOklab) {
    EXPECT_TRUE(to_oklab({1, 1, 1}).isApprox(Eigen::Vector3d(1, 0, 0), 1e-6));
    EXPECT_LT(to_oklab({0.5f, 0.5f, 0.5f}).tail<2>().norm(), 1e-6);
}

TEST(Colour, ComesBackFromOklab) {
    for (const unsigned hex : {0x000000u, 0xff0000u, 0x12ab34u, 0x7f7fffu, 0xfffffeu}) {
        const Colour colour = colour_of_hex(hex);
        EXPECT_TRUE(oklab_to_srgb(to_oklab(colour)).isApprox(Eigen::Vector3d(colour.r, colour.g, colour.b), 1e-6))
            << hex;
        EXPECT_NEAR(to_srgb(to_linear(colour.g)), colour.g, 1e-9);
    }
}

TEST(Colour, MixesOpacityToo) {
    const Colour middle = mix({0, 0, 0, 0}, {1, 1, 1, 1}, 0.5);
    EXPECT_FLOAT_EQ(middle.a, 0.5f);
    EXPECT_NEAR(to_oklab(middle).x(), 0.5, 1e-6);
}

/// OKLab coordinates of the table of a map.
std::vector<Eigen::Vector3d> lab_of(const ColourMap& map) {
    std::vector<Eigen::Vector3d> lab;
    for (const Colour& colour : map.table()) lab.push_back(to_oklab(colour));
    return lab;
}

TEST(ColourMap, IsLinearInLightness) {
    for (const ColourMap& map : colour_maps()) {
        const std::vector<Eigen::Vector3d> lab = lab_of(map);
        const double first = lab.front().x(), last = lab.back().x(), middle = 2 * lab[127].x() - lab[126].x();
        for (std::size_t i = 0; i < lab.size(); ++i) {
            const double t = static_cast<double>(i) / 255.0;
            const double even = first + t * (last - first);
            const double tent = first + (lab[1].x() - first) * 255.0 * std::min(t, 1.0 - t);
            EXPECT_NEAR(lab[i].x(), map.is_diverging() ? tent : even, 100 * kSinglePrecision) << map.name() << i;
        }
        EXPECT_GT(map.is_diverging() ? middle - first : last - first, 0.3) << map.name();
    }
}

TEST(ColourMap, TakesEvenSteps) {
    for (const ColourMap& map : colour_maps()) {
        const std::vector<Eigen::Vector3d> lab = lab_of(map);
        double length = 0.0;
        for (std::size_t i = 1; i < lab.size(); ++i) length += (lab[i] - lab[i - 1]).norm();
        const double even = length / 255.0;
        for (std::size_t i = 1; i < lab.size(); ++i) {
            const bool at_the_middle = map.is_diverging() && (i == 128);  // the turn lies between two entries
            if (at_the_middle) continue;
            EXPECT_NEAR((lab[i] - lab[i - 1]).norm(), even, 0.03 * even) << map.name() << i;
        }
    }
}

TEST(ColourMap, StaysWithinWhatScreensShow) {
    for (const ColourMap& map : colour_maps())
        for (const Colour& colour : map.table())
            for (const float part : {colour.r, colour.g, colour.b}) {
                EXPECT_GT(part, 0.0f) << map.name() << ": was clipped";
                EXPECT_LT(part, 1.0f) << map.name() << ": was clipped";
            }
}

TEST(ColourMap, SamplesItsTableAndHoldsItsEnds) {
    const ColourMap& map = colour_map("lagoon");
    EXPECT_EQ(map.sample(-1.0), map.table().front());
    EXPECT_EQ(map.sample(7.0), map.table().back());
    EXPECT_NEAR(map.sample(17.0 / 255.0).g, map.table()[17].g, 1e-6);
}

TEST(ColourMap, NamesTheMapsThatThereAre) {
    try {
        colour_map("jet");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("lagoon, ember, slate, balance"));
    }
}

}  // namespace
}  // namespace elastolab
