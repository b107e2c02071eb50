#include "render/pixels/canvas.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

Image grey(int width, int height) {
    return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), 100)};
}

TEST(Canvas, MixesAColourByItsOpacityAndCover) {
    Image image = grey(2, 1);
    Canvas canvas(image);
    canvas.blend(0, 0, {1.0f, 0.0f, 0.0f, 0.5f}, 1.0f);
    canvas.blend(1, 0, {1.0f, 0.0f, 0.0f, 1.0f}, 0.25f);
    EXPECT_EQ(image.at(0, 0), (std::array{178, 50, 50}));
    EXPECT_EQ(image.at(1, 0), (std::array{139, 75, 75}));
}

TEST(Canvas, AddsOpacityToATransparentPicture) {
    TransparentImage image{2, 1, {0, 0, 0, 0, 255, 255, 255, 128}};
    Canvas canvas(image);
    canvas.blend(0, 0, {0.0f, 1.0f, 0.0f, 0.5f}, 1.0f);
    canvas.blend(1, 0, {0.0f, 0.0f, 0.0f, 0.5f}, 1.0f);
    EXPECT_EQ(image.pixels[1], 255) << "what was clear adds no colour of its own";
    EXPECT_EQ(image.pixels[3], 128);
    EXPECT_EQ(image.pixels[7], 192);
    EXPECT_NEAR(image.pixels[4], 255.0 * 0.25 / 0.75, 2.0);
}

TEST(Canvas, FillsRectanglesWithRoundCornersAndLeavesOutWhatIsOutside) {
    Image image = grey(20, 20);
    Canvas canvas(image);
    canvas.fill_rectangle(4, 4, 30, 16, {0.0f, 0.0f, 0.0f, 1.0f}, 4.0);
    EXPECT_EQ(image.at(10, 10), (std::array{0, 0, 0}));
    EXPECT_EQ(image.at(10, 3), (std::array{100, 100, 100}));
    EXPECT_EQ(image.at(10, 4), (std::array{0, 0, 0}));
    EXPECT_EQ(image.at(4, 4), (std::array{100, 100, 100})) << "beyond the round corner";
    EXPECT_EQ(image.at(19, 10), (std::array{0, 0, 0}));
    canvas.fill_rectangle(0, 0.25, 20, 1, {0.0f, 0.0f, 0.0f, 1.0f});
    EXPECT_NEAR(image.at(10, 0)[0], 25, 1) << "three quarters of a row";
}

}  // namespace
}  // namespace elastolab
