// The colour bar with round numbers, at the right of the scene.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/names.hpp"
#include "app/panels/overlays.hpp"
#include "app/panels/widgets.hpp"
#include "app/picture/scene_renderer.hpp"
#include "render/drawing/legend.hpp"

namespace elastolab {

void draw_legend(const PanelContext& context, ImDrawList& list) {
    const ViewerState& state = context.state;
    const auto is_coloured = [](const ShownBody& body) { return body.is_coloured(); };
    if (state.display.field == Field::none ||
        std::none_of(state.shown.bodies().begin(), state.shown.bodies().end(), is_coloured))
        return;
    const Viewport& scene = context.layout.scene;
    const float scale = context.gui.scale(), width = 16.0f * scale;
    const float height = std::min(220.0f * scale, 0.5f * static_cast<float>(scene.height));
    const float x = static_cast<float>(scene.x + scene.width) - 84.0f * scale;
    const float y = static_cast<float>(scene.y + scene.height) - height - 28.0f * scale;
    const std::string heading = field_title(state.display.field, state.compare.reference, state.display.units);
    const float size = ImGui::GetFontSize(), room = static_cast<float>(kLegendHeadingWidth) * scale;
    const ImVec2 words = ImGui::CalcTextSize(heading.c_str(), nullptr, false, room);
    const float right = static_cast<float>(scene.x + scene.width) - kOverlayMargin * scale;
    const float left = std::max(static_cast<float>(scene.x) + kOverlayMargin * scale, std::min(x, right - words.x));
    const float heading_top = y - words.y - 0.7f * size;
    chip(context, list, {left, heading_top}, {right, y + height + 0.5f * size});
    const ColourMap& map = shown_colour_map(state.display);
    const int n_steps = state.display.bands ? kColourBands : 64;
    for (int i = 0; i < n_steps; ++i) {
        const float top = y + height * (1.0f - static_cast<float>(i + 1) / static_cast<float>(n_steps));
        const float bottom = y + height * (1.0f - static_cast<float>(i) / static_cast<float>(n_steps));
        list.AddRectFilled({x, top}, {x + width, bottom + 0.5f}, imgui_packed(map.sample((i + 0.5) / n_steps)));
    }
    list.AddRect({x, y}, {x + width, y + height}, imgui_packed(context.palette.border));
    const ColourScale scale_of_colours = state.shown.field_scale(state.display);
    const auto place_of = [&](double value) {
        return y + height * (1.0f - static_cast<float>(scale_of_colours.place(value)));
    };
    if (const ShownBody* body = state.shown.body(state.method); body && state.display.extremes)
        for (const auto& extreme : {body->smallest_seen(), body->largest_seen()}) {
            if (!extreme) continue;
            const float ty = place_of(extreme->value), s = 6.0f * scale;
            list.AddTriangleFilled({x - 1.0f, ty}, {x - s - 1.0f, ty - 0.6f * s}, {x - s - 1.0f, ty + 0.6f * s},
                                   imgui_packed(context.palette.text));
        }
    for (const LegendTick& tick : scale_of_colours.ticks(5)) {
        const float ty = place_of(tick.value);
        list.AddLine({x + width, ty}, {x + width + 4.0f * scale, ty}, imgui_packed(context.palette.text));
        list.AddText({x + width + 7.0f * scale, ty - 0.5f * size}, imgui_packed(context.palette.text),
                     tick.text.c_str());
    }
    list.AddText(nullptr, 0.0f, {left, heading_top}, imgui_packed(context.palette.text), heading.c_str(), nullptr,
                 room);
}

}  // namespace elastolab
