#include "app/settings.hpp"

namespace elastolab {

std::optional<StressMeasure> stress_of(Field field) {
    if (field < Field::von_mises) return std::nullopt;
    static_assert(static_cast<int>(Field::stress_xz) - static_cast<int>(Field::von_mises) ==
                  static_cast<int>(StressMeasure::xz) - static_cast<int>(StressMeasure::von_mises));
    return static_cast<StressMeasure>(static_cast<int>(field) - static_cast<int>(Field::von_mises));
}

bool is_signed(Field field) { return field > Field::von_mises; }

const ColourMap& shown_colour_map(const DisplaySettings& display) {
    return colour_map(is_signed(display.field) ? display.signed_colour_map : display.colour_map);
}

}  // namespace elastolab
