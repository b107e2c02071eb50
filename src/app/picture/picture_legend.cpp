#include "app/picture/picture_legend.hpp"

#include <algorithm>
#include <vector>

#include "app/names.hpp"
#include "app/window/fonts.hpp"
#include "base/error.hpp"
#include "render/drawing/legend.hpp"
#include "render/pixels/lettering.hpp"

namespace elastolab {

namespace {

// On an ordinary screen [pixels].
constexpr double kLegendMargin = 20.0, kLegendPad = 9.0, kBarWidth = 16.0, kMostBarHeight = 220.0,
                 kLegendFontSize = 17.0;
constexpr double kTickLength = 4.0, kTickGap = 8.0, kHeadingGap = 10.0, kLegendCorner = 7.0;
constexpr float kLegendChipOpacity = 0.72f;
constexpr int kLegendTicks = 5;

}  // namespace

std::optional<PictureLegend> legend_of(const ViewerState& state) {
    const auto& bodies = state.shown.bodies();
    if (state.display.field == Field::none ||
        std::none_of(bodies.begin(), bodies.end(), [](const ShownBody& body) { return body.is_coloured(); }))
        return {};
    return PictureLegend{field_title(state.display.field, state.compare.reference, state.display.units),
                         state.shown.field_scale(state.display), &shown_colour_map(state.display), state.display.bands};
}

void draw_legend(Canvas& canvas, const PictureLegend& legend, const Palette& palette, double scale) {
    const std::optional<std::filesystem::path> font = regular_font();
    if (!font) throw Error("picture: no font for the legend is installed. Install fonts-roboto-unhinted.");
    const Lettering lettering(*font);
    const double size = kLegendFontSize * scale, pad = kLegendPad * scale;
    const double bar_height = std::min(kMostBarHeight * scale, 0.5 * canvas.height());
    const std::vector<LegendTick> ticks = legend.scale.ticks(kLegendTicks);
    double beside = 0.0;
    for (const LegendTick& tick : ticks) beside = std::max(beside, lettering.width(tick.text, size));
    const double bar_and_ticks = (kBarWidth + kTickGap) * scale + beside;
    const double width = std::max(bar_and_ticks, lettering.width(legend.heading, size));
    const double right = canvas.width() - kLegendMargin * scale - pad,
                 bottom = canvas.height() - kLegendMargin * scale - pad;
    const double left = right - width, top = bottom - bar_height;
    const double heading_middle = top - kHeadingGap * scale - 0.5 * size;
    canvas.fill_rectangle(left - pad, heading_middle - 0.5 * size - pad, right + pad, bottom + pad,
                          palette.panel.with_opacity(kLegendChipOpacity), kLegendCorner * scale);
    lettering.draw(canvas, left, heading_middle, legend.heading, size, palette.text);

    const double bar = right - bar_and_ticks, bar_right = bar + kBarWidth * scale;
    for (auto y = static_cast<int>(top); y < static_cast<int>(bottom); ++y)
        canvas.fill_rectangle(bar, y, bar_right, y + 1,
                              legend.colours->sample(place_on_map((bottom - y - 0.5) / bar_height, legend.bands)));
    for (const LegendTick& tick : ticks) {
        const double y = bottom - legend.scale.place(tick.value) * bar_height;
        canvas.fill_rectangle(bar_right, y - 0.5 * scale, bar_right + kTickLength * scale, y + 0.5 * scale,
                              palette.text);
        lettering.draw(canvas, bar_right + kTickGap * scale, y, tick.text, size, palette.text);
    }
}

}  // namespace elastolab
