#include "app/panels/overlays_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/label_places.hpp"
#include "app/panels/overlays.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "app/picture/scene_renderer.hpp"
#include "base/text.hpp"
#include "methods/registry.hpp"

namespace elastolab {

namespace {

constexpr const char* kDash = "  \u2013  ";

/// What is seen of a method: its answer, the preview of it, or why there is none.
std::string source_words(const ViewerState& state, MethodKind kind) {
    const Simulation& simulation = state.simulation;
    const MethodRunner& runner = simulation.runner(kind);
    const auto progress = [](const JobStatus& status) {
        return stage_words(status.stage) + formatted(" %.0f\u00a0%%", std::floor(100.0 * status.progress));
    };
    std::string text;
    if (const MethodKind other = simulation.stand_in(kind)) {
        text = std::string(kDash) + title(other) + " until it is there";
    } else if (simulation.previewing(kind)) {
        const Proxy* proxy = simulation.preview(kind).proxy();
        text = std::string(kDash) + (runner.has_set() && !kind->linear ? "preview is following" : "preview");
        if (proxy) text += " (proxy of " + count_text(proxy->surface->n_vertices()) + " vertices)";
    }
    if (simulation.making_proxy(kind)) return text + kDash + progress(simulation.proxies().status());
    if (runner.precomputing()) return text + kDash + progress(runner.status());
    if (runner.crushed()) return text + kDash + "no equilibrium: the last one stays";
    if (!simulation.problem(kind).empty()) return text + kDash + "not available: see the warnings (P: panel)";
    if (simulation.previewing(kind)) return text;
    if (!runner.has_answer())
        return kDash + std::string(simulation.proxies().running()   ? "making a proxy for the preview"
                                   : simulation.preparing_preview() ? "preparing the preview"
                                   : runner.preparing()             ? "preparing the constrained set"
                                   : simulation.waiting()           ? "waiting"
                                                                    : "not computed");
    if (simulation.is_of_former_model(kind)) return kDash + std::string("before the last change: waiting");
    const Proxy* proxy = simulation.embedded(kind).proxy();
    if (!kind->linear)
        text = kDash + std::string(runner.following() ? "following" : runner.answers() ? "exact" : "preparing");
    if (!runner.converged() && !runner.following() && (kind->linear || runner.answers()))
        text = kDash + std::string("exact to ") + number_text(runner.tolerance());
    if (proxy != nullptr && proxy->is_filled()) return text + kDash + "holes filled";
    return proxy ? text + kDash + "on a proxy of " + count_text(proxy->surface->n_vertices()) + " vertices" : text;
}

/// How far a compared method is from the reference, on the average and at most; of the reference itself that it is
/// that. Empty where nothing is compared.
std::pair<std::string, std::string> difference_words(const ViewerState& state, MethodKind kind) {
    const ShownBody* shown = state.shown.body(kind);
    if (!state.comparing() || shown == nullptr) return {};
    if (!shown->difference()) return {kind == state.compare.reference ? "reference" : "", ""};
    return {"differs by " + number_text(100.0 * shown->difference()->relative_rms) + " % (rms)",
            number_text(100.0 * shown->difference()->relative_max) + " % at most"};
}

/// Whose answer a viewport shows, how it is doing, and how far it is from the reference. No labels are to cover it.
void draw_title(const PanelContext& context, ImDrawList& list, const SceneViewport& viewport, LabelPlaces& labels) {
    const ViewerState& state = context.state;
    const Palette& palette = context.palette;
    const float size = ImGui::GetFontSize(), margin = kOverlayMargin * context.gui.scale();
    const Viewport& place = viewport.place;
    const float width = std::max(40.0f, static_cast<float>(place.width - place.covered) - 2.0f * margin);
    std::vector<OverlayLine> lines;
    for (const MethodKind kind : viewport.kinds) {
        const bool first = lines.empty();
        lines.push_back({first ? context.gui.fonts().large : context.gui.fonts().regular, first ? 1.35f * size : size,
                         palette.words(kind), title(kind) + source_words(state, kind)});
        const auto [rms, largest] = difference_words(state, kind);
        if (rms.empty()) continue;
        const std::string both = rms + (largest.empty() ? "" : "   ") + largest;
        const bool fits = ImGui::CalcTextSize(both.c_str()).x <= width;
        if (!first) lines.back().text += ":  " + both;
        if (first) lines.push_back({context.gui.fonts().regular, size, palette.text, fits ? both : rms});
        if (first && !fits) lines.push_back({context.gui.fonts().regular, size, palette.text, largest});
    }
    const Eigen::Vector2d low(place.x + margin, place.y + margin);
    const ImVec2 high = draw_lines(context, list, im_point(low.x(), low.y()), width, lines);
    labels.cover({low, Eigen::Vector2d(high.x, high.y)});
}

void draw_axes_letters(const PanelContext& context, ImDrawList& list, const SceneViewport& viewport) {
    const AxesGizmo::Labels labels = AxesGizmo::labels(context.state.camera, AxesGizmo::place_in(viewport.place));
    constexpr std::array<const char*, 3> kLetters = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
        const ImVec2 size = ImGui::CalcTextSize(kLetters[i]);
        list.AddText(im_point(labels.pixel[i].x() - 0.5 * size.x, labels.pixel[i].y() - 0.5 * size.y),
                     imgui_packed(context.palette.text), kLetters[i]);
    }
}

void draw_tools(const PanelContext& context, ImDrawList& list) {
    const ViewerState& state = context.state;
    const Palette& palette = context.palette;
    if (const auto box = state.gestures.box()) {
        const ImVec2 a = im_point(box->first.x(), box->first.y()), b = im_point(box->second.x(), box->second.y());
        const ImVec2 low{std::min(a.x, b.x), std::min(a.y, b.y)}, high{std::max(a.x, b.x), std::max(a.y, b.y)};
        list.AddRectFilled(low, high, imgui_packed(palette.fixed, 0.15f));
        list.AddRect(low, high, imgui_packed(palette.fixed), 0.0f, 0, 1.5f);
    }
    const Eigen::Vector2d& cursor = state.gestures.cursor();
    const bool brushes = state.tools.tool == Tool::brush || state.tools.tool == Tool::pressure;
    if (brushes && context.layout.scene.contains(cursor) && !context.gui.wants_mouse())
        list.AddCircle(im_point(cursor.x(), cursor.y()), static_cast<float>(state.tools.brush_pixels),
                       imgui_packed(state.tools.tool == Tool::brush ? palette.fixed : palette.load), 48, 1.5f);
}

/// What to do next, for those who see this for the first time.
std::string hint_text(const ViewerState& state) {
    if (!state.gestures.hint().empty()) return state.gestures.hint();
    if (state.scene().n_handles() > 0 || state.scene().n_loads() > 0 || state.gestures.dragging()) return "";
    const Simulation& simulation = state.simulation;
    if (!simulation.problem(state.method).empty() && !simulation.previewing(state.method))
        return title(state.method) + " has no answer; the panel (P) says why. Keys 1 to " +
               std::to_string(all_methods().size()) + " choose other methods.";
    if (state.tools.tool == Tool::brush) return "Paint over the vertices that are to be fixed; with Shift, free them.";
    if (state.tools.tool == Tool::force) return "Press on the body and drag: the arrow is the force.";
    if (state.tools.tool == Tool::pressure) return "Paint where the pressure acts; with Shift, take the paint off.";
    if (state.tools.tool == Tool::probe) return "";
    if (state.tools.tool == Tool::box) return "Draw a box around the vertices that are to be fixed.";
    if (state.scene().vertices(LiveScene::kFixed).empty())
        return "Nothing is fixed: fix some vertices with the brush (B), then pull.";
    return "Press on the body and pull.   Drag beside it to turn the view.   ? shows all keys.";
}

void draw_hint(const PanelContext& context, ImDrawList& list) {
    const std::string text = hint_text(context.state);
    if (text.empty()) return;
    const Viewport& scene = context.layout.scene;
    const float scale = context.gui.scale(), pad = 8.0f * scale;
    // Beside the axes, which can be clicked.
    const Viewport axes = AxesGizmo::place_in(scene);
    const double left = axes.x + axes.width + 2.0 * pad, right = scene.x + scene.width - 2.0 * pad;
    const auto width = static_cast<float>(std::max(right - left, 12.0 * ImGui::GetFontSize()));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
    const ImVec2 place = im_point(std::max(left, scene.x + 0.5 * (scene.width - size.x)),
                                  scene.y + scene.height - size.y - 26.0 * scale);
    list.AddRectFilled({place.x - 1.5f * pad, place.y - pad}, {place.x + size.x + 1.5f * pad, place.y + size.y + pad},
                       imgui_packed(context.palette.panel, 0.85f), 6.0f * scale);
    list.AddText(nullptr, 0.0f, place, imgui_packed(context.palette.text), text.c_str(), nullptr, width);
}

/// The first file is being opened.
void draw_blank(const PanelContext& context, ImDrawList& list) {
    const Viewport &scene = context.layout.scene, &panel = context.layout.panel;
    const ImVec2 low = im_point(panel.x, scene.y), high = im_point(scene.x + scene.width, scene.y + scene.height);
    const unsigned top = imgui_packed(context.palette.background_top);
    const unsigned bottom = imgui_packed(context.palette.background_bottom);
    list.AddRectFilledMultiColor(low, high, top, top, bottom, bottom);
    const std::string text = "Opening " + context.state.files.loading_file().filename().string() + " ...";
    const float width = std::min(high.x - low.x - 2.0f * kOverlayMargin, ImGui::CalcTextSize(text.c_str()).x);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
    list.AddText(nullptr, 0.0f, {0.5f * (low.x + high.x - size.x), 0.5f * (low.y + high.y - size.y)},
                 imgui_packed(context.palette.text), text.c_str(), nullptr, width);
}

}  // namespace

void draw_overlays(const PanelContext& context) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    if (context.state.blank()) {
        draw_blank(context, list);
        draw_messages(context);
        return;
    }
    for (const SceneViewport& viewport : context.state.shown.viewports) {
        const Viewport& v = viewport.place;
        list.PushClipRect(im_point(v.x, v.y), im_point(v.x + v.width, v.y + v.height));
        LabelPlaces labels(v, 7.0 * context.gui.scale());
        draw_title(context, list, viewport, labels);
        draw_axes_letters(context, list, viewport);
        draw_marks(context, list, viewport, labels);
        list.PopClipRect();
    }
    draw_legend(context, list);
    draw_tools(context, list);
    draw_hint(context, list);
    draw_messages(context);
}

}  // namespace elastolab
