#include "render/gl/image.hpp"

#include <gtest/gtest.h>
#include <stb_image.h>

#include "base/error.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

TEST(Image, ComesBackFromItsPngUnchanged) {
    const test::TemporaryFolder folder;
    Image image{3, 2, {}};
    for (int i = 0; i < 18; ++i) image.pixels.push_back(static_cast<std::uint8_t>(14 * i));
    write_png(folder.path() / "a.png", image);
    int width = 0, height = 0, channels = 0;
    std::uint8_t* const read = stbi_load((folder.path() / "a.png").c_str(), &width, &height, &channels, 0);
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(width, 3);
    EXPECT_EQ(height, 2);
    EXPECT_EQ(channels, 3);
    EXPECT_EQ(std::vector<std::uint8_t>(read, read + 18), image.pixels);
    stbi_image_free(read);
}

TEST(Image, SaysWhenItCannotBeWritten) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_png(folder.path() / "none" / "a.png", {1, 1, {0, 0, 0}}), Error);
    EXPECT_THROW(write_png_channels(folder.path() / "a.png", 32768, 32768, 4, nullptr), Error) << "4 GB of pixels";
    EXPECT_TRUE(folder.listing().empty());
}

}  // namespace
}  // namespace elastolab
