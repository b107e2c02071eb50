#include "app/picture/palette.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace elastolab {
namespace {

double luminance(const Colour& colour) {
    const Colour c = linear(colour);
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// Contrast of the Web Content Accessibility Guidelines 2.1.
double contrast(const Colour& a, const Colour& b) {
    const auto [dark, light] = std::minmax({luminance(a), luminance(b)});
    return (light + 0.05) / (dark + 0.05);
}

TEST(Palette, EveryTextCanBeReadInBothThemes) {
    for (const Palette* palette : {&dark_palette(), &light_palette()})
        for (const Colour Palette::*ground : {&Palette::panel, &Palette::panel_raised})
            for (const Colour Palette::*text :
                 {&Palette::text, &Palette::text_dim, &Palette::good, &Palette::busy, &Palette::bad, &Palette::fixed,
                  &Palette::fixed_active, &Palette::handle, &Palette::active, &Palette::probe, &Palette::accent})
                EXPECT_GE(contrast(palette->*text, palette->*ground), 4.5)
                    << (palette == &dark_palette() ? "dark" : "light");
}

}  // namespace
}  // namespace elastolab
