#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "render/colour.hpp"

namespace elastolab {

/// Red, green, blue, opacity in bytes, as vertex attributes and textures hold them.
using PackedColour = std::array<std::uint8_t, 4>;

inline PackedColour pack(const Colour& colour) {
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): nothing is negative, and lround is slow
    const auto byte = [](float x) { return static_cast<std::uint8_t>(std::clamp(x, 0.0f, 1.0f) * 255.0f + 0.5f); };
    return {byte(colour.r), byte(colour.g), byte(colour.b), byte(colour.a)};
}

}  // namespace elastolab
