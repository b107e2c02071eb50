#include "app/panels/overlays.hpp"

#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "app/panels/widgets.hpp"

namespace elastolab {

ImVec2 im_point(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }

void chip(const PanelContext& context, ImDrawList& list, ImVec2 low, ImVec2 high, float opacity) {
    const float pad = 7.0f * context.gui.scale();
    list.AddRectFilled({low.x - pad, low.y - 0.6f * pad}, {high.x + pad, high.y + 0.6f * pad},
                       imgui_packed(context.palette.panel, opacity), 0.8f * pad);
}

ImVec2 draw_lines(const PanelContext& context, ImDrawList& list, ImVec2 place, float width,
                  const std::vector<OverlayLine>& lines, float opacity) {
    ImVec2 high = place;
    std::vector<float> tops;
    for (const OverlayLine& line : lines) {
        const ImVec2 extent = line.font->CalcTextSizeA(line.size, FLT_MAX, width, line.text.c_str());
        tops.push_back(high.y);
        high = {std::max(high.x, place.x + extent.x), high.y + extent.y + 0.15f * line.size};
    }
    chip(context, list, place, high, opacity);
    for (std::size_t i = 0; i < lines.size(); ++i)
        list.AddText(lines[i].font, lines[i].size, {place.x, tops[i]}, imgui_packed(lines[i].colour),
                     lines[i].text.c_str(), nullptr, width);
    return high;
}

}  // namespace elastolab
