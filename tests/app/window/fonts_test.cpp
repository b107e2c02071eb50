#include "app/window/fonts.hpp"

#include <gtest/gtest.h>

namespace elastolab {
namespace {

TEST(Fonts, AreFoundForLatinAndForOtherScriptsWhereOneHasThem) {
    ASSERT_TRUE(regular_font());
    EXPECT_TRUE(std::filesystem::exists(*regular_font()));
    EXPECT_TRUE(bold_font());
    const auto cyrillic = font_with(U'\u0416');
    ASSERT_TRUE(cyrillic);
    EXPECT_TRUE(std::filesystem::exists(cyrillic->path));
    EXPECT_FALSE(font_with(0xFFFF)) << "no character";
}

}  // namespace
}  // namespace elastolab
