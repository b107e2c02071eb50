#include "app/settings.hpp"

namespace elastolab {

Shown shown_by(const DisplaySettings& display) {
    Shown shown{.field = display.field};
    if (const auto typed = display.typed_ranges.find(display.field); typed != display.typed_ranges.end())
        shown.range = typed->second;
    if (display.section) shown.cut = display.cut;
    return shown;
}

void show(const Shown& shown, DisplaySettings& display) {
    display.field = shown.field;
    display.typed_ranges.erase(shown.field);
    if (shown.range) display.typed_ranges[shown.field] = *shown.range;
    display.section = shown.cut.has_value();
    if (shown.cut) display.cut = *shown.cut;
}

const ColourMap& shown_colour_map(const DisplaySettings& display) {
    return colour_map(is_signed(display.field) ? display.signed_colour_map : display.colour_map);
}

}  // namespace elastolab
