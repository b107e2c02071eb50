#pragma once

#include <optional>
#include <string>

#include "app/picture/palette.hpp"
#include "app/viewer_state.hpp"
#include "render/colour_map.hpp"
#include "render/pixels/canvas.hpp"

namespace elastolab {

/// The colour bar of a picture: what is shown, and which colours it has.
struct PictureLegend {
    std::string heading;
    ColourScale scale = {};
    const ColourMap* colours = nullptr;
    bool bands = false;
};

/// The legend of what the viewer shows now; nothing where no body is coloured by a field.
std::optional<PictureLegend> legend_of(const ViewerState& state);

/// At the lower right, on a chip; `scale`: pixels for a length that is 1 on an ordinary screen. Throws Error when no
/// font is installed.
void draw_legend(Canvas& canvas, const PictureLegend& legend, const Palette& palette, double scale);

}  // namespace elastolab
