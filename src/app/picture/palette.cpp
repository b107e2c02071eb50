#include "app/picture/palette.hpp"

#include <imgui.h>

#include <algorithm>

#include "scene/live/simulation.hpp"

namespace elastolab {

namespace {

ImVec4 vec4(const Colour& c, float opacity = 1.0f) { return {c.r, c.g, c.b, c.a * opacity}; }

Palette make_dark() {
    const auto hex = colour_of_hex;
    return {.background_top = hex(0x2b323c),
            .background_bottom = hex(0x15181d),
            .panel = hex(0x1d2127),
            .panel_raised = hex(0x2a3039),
            .border = hex(0x3a424d),
            .text = hex(0xe6e9ed),
            .text_dim = hex(0x98a2ae),
            .accent = hex(0x4bb0a2),
            .good = hex(0x62c08a),
            .busy = hex(0xe8b04b),
            .bad = hex(0xee8072),
            .wire = hex(0x101418),
            .grid = hex(0x8d99a8),
            .outline = hex(0xffffff),
            .fixed = hex(0x6d9bf4),
            .fixed_active = hex(0x7fe3ff),
            .handle = hex(0xf08a3c),
            .active = hex(0xffd166),
            .hover = hex(0xfff4d6),
            .probe = hex(0xf2c6ff),
            .load = hex(0x8fe36b),
            .axes = {hex(0xe0605a), hex(0x6cbf63), hex(0x5a8fe6)},
            .bodies = {hex(0x7fa8d6), hex(0xdba06a), hex(0x83bf9f), hex(0xb79ad6), hex(0xd68fae), hex(0xbfc07a)}};
}

Palette make_light() {
    const auto hex = colour_of_hex;
    return {.background_top = hex(0xfbfcfd),
            .background_bottom = hex(0xdde3ea),
            .panel = hex(0xf4f6f8),
            .panel_raised = hex(0xe4e9ee),
            .border = hex(0xc3cbd4),
            .text = hex(0x1c2229),
            .text_dim = hex(0x5c6773),
            .accent = hex(0x1b7065),
            .good = hex(0x1d7042),
            .busy = hex(0x845400),
            .bad = hex(0xb33225),
            .wire = hex(0x20262d),
            .grid = hex(0x6b7683),
            .outline = hex(0xffffff),
            .fixed = hex(0x2a5bc0),
            .fixed_active = hex(0x00606d),
            .handle = hex(0xa8480a),
            .active = hex(0x7d5900),
            .hover = hex(0x8a5a00),
            .probe = hex(0x7a1fa0),
            .load = hex(0x2c6e12),
            .axes = {hex(0xc8413b), hex(0x3f9440), hex(0x2f66d0)},
            .bodies = {hex(0x86aedb), hex(0xe0a873), hex(0x8ac7a6), hex(0xbea3dc), hex(0xdc9ab6), hex(0xc7c886)}};
}

constexpr float kUnderText = 0.5f;  ///< opacity of the accent where text stands over it

void set_measures(ImGuiStyle& style, float scale) {
    style.WindowPadding = {12, 10};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.WindowRounding = 6;
    style.FrameRounding = 4;
    style.PopupRounding = 5;
    style.GrabRounding = 4;
    style.ScrollbarRounding = 6;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 12;
    style.WindowBorderSize = 1;
    style.FrameBorderSize = 0;
    style.ScaleAllSizes(scale);
}

}  // namespace

const Colour& Palette::body(MethodKind kind) const {
    return bodies[static_cast<std::size_t>(kind->colour) % bodies.size()];
}

Colour Palette::words(MethodKind kind) const { return mix(body(kind), text, this == &light_palette() ? 0.6 : 0.35); }

const Palette& dark_palette() {
    static const Palette palette = make_dark();
    return palette;
}

const Palette& light_palette() {
    static const Palette palette = make_light();
    return palette;
}

void apply_style(const Palette& palette, float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    set_measures(style, scale);
    ImVec4* c = style.Colors;
    for (int i = 0; i < ImGuiCol_COUNT; ++i) c[i] = vec4(palette.panel_raised);
    c[ImGuiCol_Text] = c[ImGuiCol_NavHighlight] = vec4(palette.text);
    c[ImGuiCol_TextDisabled] = vec4(palette.text_dim);
    c[ImGuiCol_WindowBg] = c[ImGuiCol_MenuBarBg] = vec4(palette.panel);
    c[ImGuiCol_ChildBg] = vec4(palette.panel, 0.0f);
    c[ImGuiCol_PopupBg] = vec4(palette.panel);
    c[ImGuiCol_Border] = c[ImGuiCol_Separator] = vec4(palette.border);
    c[ImGuiCol_BorderShadow] = {0, 0, 0, 0};
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = vec4(palette.panel_raised);
    c[ImGuiCol_ScrollbarBg] = vec4(palette.panel, 0.0f);
    c[ImGuiCol_ScrollbarGrab] = vec4(palette.border);
    c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = c[ImGuiCol_HeaderHovered] = vec4(palette.border);
    for (const ImGuiCol_ i :
         {ImGuiCol_CheckMark, ImGuiCol_PlotLines, ImGuiCol_SeparatorActive, ImGuiCol_SeparatorHovered})
        c[i] = vec4(palette.accent);
    for (const ImGuiCol_ i : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_PlotHistogram})
        c[i] = vec4(palette.accent, kUnderText);
    for (const ImGuiCol_ i : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive,
                              ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive})
        c[i] = vec4(palette.accent, 0.7f);
    c[ImGuiCol_TextSelectedBg] = vec4(palette.accent, 0.4f);
    c[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.45f};
}

}  // namespace elastolab
