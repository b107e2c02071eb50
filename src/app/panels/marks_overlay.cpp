// What is drawn at points of the body.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/names.hpp"
#include "app/panels/label_places.hpp"
#include "app/panels/overlays.hpp"
#include "app/panels/widgets.hpp"
#include "app/picture/load_arrows.hpp"

namespace elastolab {

namespace {

constexpr float kCardOpacity = 0.96f;                  ///< what is below would read as part of its numbers
constexpr double kRadians = std::numbers::pi / 180.0;  ///< of a degree
constexpr double kNoAngle = 1e-9;                      ///< [radians] less is rounding

/// One viewport's marks, and where their words stand.
struct Marks {
    const PanelContext& context;
    ImDrawList& list;
    const Viewport& viewport;
    LabelPlaces& labels;

    /// A ring at a point with words beside it, broken where they do not fit into the viewport.
    void draw(const Eigen::Vector3d& place, const Colour& colour, const std::string& text) const {
        const ProjectedPoint projected = context.state.camera.project(place, viewport);
        if (projected.depth <= 0.0 || !viewport.contains(projected.pixel)) return;
        const ImVec2 at = im_point(projected.pixel.x(), projected.pixel.y());
        const float scale = context.gui.scale(), width = static_cast<float>(labels.width());
        list.AddCircle(at, 5.0f * scale, imgui_packed(context.palette.panel, 0.8f), 24, 4.0f * scale);
        list.AddCircle(at, 5.0f * scale, imgui_packed(colour), 24, 2.0f * scale);
        const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
        const auto box = labels.take(projected.pixel, {size.x, size.y}, 18.0 * scale);
        const ImVec2 low = im_point(box.min().x(), box.min().y());
        chip(context, list, low, {low.x + size.x, low.y + size.y});
        list.AddText(nullptr, 0.0f, low, imgui_packed(colour), text.c_str(), nullptr, width);
    }
};

void draw_extremes(const Marks& marks, const ShownBody& body) {
    const auto& [context, list, viewport, labels] = marks;
    if (!body.is_coloured() || body.largest_magnitude() <= 0.0) return;
    const DisplaySettings& display = context.state.display;
    const std::string unit = after_value(display.field, display.units);
    const auto mark = [&](const std::optional<SeenValue>& seen, const char* name) {
        if (seen) marks.draw(seen->place, marks.context.palette.text, name + number_text(seen->value) + unit);
    };
    mark(body.largest_seen(), "largest ");
    if (is_signed(display.field)) mark(body.smallest_seen(), "smallest ");
}

void draw_arrow_head(ImDrawList& list, ImVec2 from, ImVec2 tip, float size, unsigned colour) {
    const Eigen::Vector2f along = Eigen::Vector2f(tip.x - from.x, tip.y - from.y).normalized() * size;
    const Eigen::Vector2f side(-along.y(), along.x());
    const auto corner = [&](float forward, float aside) {
        return ImVec2(tip.x + forward * along.x() + aside * side.x(), tip.y + forward * along.y() + aside * side.y());
    };
    list.AddTriangleFilled(corner(0.9f, 0.0f), corner(-0.7f, 0.7f), corner(-0.7f, -0.7f), colour);
}

/// A gizmo's lines, the part under the cursor and the one that is dragged thicker, with how far it was dragged.
void draw_gizmo(const Marks& marks, const Gizmo& gizmo) {
    const auto& [context, list, viewport, labels] = marks;
    const ViewerState& state = context.state;
    const float scale = context.gui.scale();
    const Gestures& gestures = state.gestures;
    const auto& drag = gestures.gizmo_drag();
    for (const GizmoPart& part : gizmo.parts) {
        if (drag && (drag->gizmo.handle != gizmo.handle || drag->part != part)) continue;
        const bool active = drag || gestures.hover().part == std::pair(gizmo.handle, part);
        const Colour& colour = context.palette.axes[static_cast<std::size_t>(part.axis)];
        const float width = (active ? 4.0f : 2.2f) * scale;
        std::vector<ImVec2> line;
        for (const Eigen::Vector2d& pixel : outline(gizmo, part, state.camera, viewport))
            line.push_back(im_point(pixel.x(), pixel.y()));
        if (line.size() < 2) continue;
        const auto n = static_cast<int>(line.size());
        list.AddPolyline(line.data(), n, imgui_packed(context.palette.panel, 0.55f), 0, width + 2.0f * scale);
        list.AddPolyline(line.data(), n, imgui_packed(colour), 0, width);
        if (part.kind == GizmoPart::Kind::arrow)
            draw_arrow_head(list, line[0], line[1], (active ? 9.0f : 7.0f) * scale, imgui_packed(colour));
    }
    if (!drag || drag->gizmo.handle != gizmo.handle) return;
    const bool moves = drag->part.kind == GizmoPart::Kind::arrow;
    const std::string amount =
        moves ? number_text(drag->amount) + state.display.units.after_length()
              : number_text(std::abs(drag->amount) < kNoAngle ? 0.0 : drag->amount / kRadians) + "\u00b0";
    marks.draw(gizmo.center, context.palette.text, (moves ? "moved by " : "turned by ") + amount);
}

/// All that is known at a vertex.
std::vector<OverlayLine> card(const PanelContext& context, int vertex, const ProbeValue& value) {
    const ViewerState& state = context.state;
    const float size = ImGui::GetFontSize();
    std::vector<OverlayLine> lines = {
        {context.gui.fonts().bold, size, context.palette.text, "vertex " + std::to_string(vertex)}};
    const auto add = [&](const std::string& text) {
        lines.push_back({context.gui.fonts().regular, size, context.palette.text, text});
    };
    const UnitNames& units = state.display.units;
    add("at " + vector_text(value.position) + units.after_length());
    add("moved by " + vector_text(value.displacement) + units.after_length());
    add("length " + number_text(value.displacement.norm()) + units.after_length());
    const Field field = state.display.field;
    if (value.field && field != Field::displacement)
        add(field_title(field, state.compare.reference, units) + " " + number_text(*value.field));
    if (value.traction && value.traction->squaredNorm() > 0.0)
        add("traction " + vector_text(*value.traction) + units.after_stress());
    if (!value.stress) return lines;
    const Eigen::Matrix3d stress = stress_tensor(*value.stress);
    const auto number = [&](StressMeasure which) { return number_text(measure(which, stress)); };
    add("stress xx yy zz " + vector_text(value.stress->head<3>()) + units.after_stress());
    add("stress xy yz xz " + vector_text(value.stress->tail<3>()) + units.after_stress());
    add("principal " + number(StressMeasure::third_principal) + " to " + number(StressMeasure::first_principal) +
        units.after_stress());
    if (field != Field::von_mises) add("von Mises " + number(StressMeasure::von_mises) + units.after_stress());
    return lines;
}

/// The kept probes, and a card of what is known at the vertex under the cursor.
void draw_probes(const Marks& marks, const ShownBody& body) {
    const auto& [context, list, viewport, labels] = marks;
    const ViewerState& state = context.state;
    const Positions& rest = state.scene().mesh().vertices;
    const auto value_at = [&](int vertex) { return probe(vertex, rest, body, state.display.deformation_scale); };
    for (const int vertex : state.probes.vertices()) {
        if (body.is_cut_away(vertex)) continue;
        const ProbeValue value = value_at(vertex);
        marks.draw(body.positions().col(vertex), context.palette.probe,
                   std::to_string(vertex) + ": " + number_text(value.field.value_or(value.displacement.norm())) +
                       after_value(value.field ? state.display.field : Field::none, state.display.units));
    }
    const int hovered = state.gestures.hover().vertex;
    const Eigen::Vector2d& cursor = state.gestures.cursor();
    if (state.tools.tool != Tool::probe || hovered < 0 || !viewport.contains(cursor)) return;
    const std::vector<OverlayLine> lines = card(context, hovered, value_at(hovered));
    const float width = 320.0f * context.gui.scale(), step = 18.0f * context.gui.scale();
    const double height = (1.15 * static_cast<double>(lines.size()) + 1.0) * ImGui::GetFontSize();
    const double right = viewport.x + viewport.width, bottom = viewport.y + viewport.height;
    const double x = std::max(viewport.x + step, std::min(cursor.x() + step, right - width));
    const double y = std::max(viewport.y + step, std::min(cursor.y() + step, bottom - height));
    draw_lines(context, list, im_point(x, y), width, lines, kCardOpacity);
}

void draw_forces(const Marks& marks, const ShownBody& body) {
    const auto& [context, list, viewport, labels] = marks;
    const UnitNames& units = context.state.display.units;
    for (const ShownReaction& reaction : body.reactions())
        marks.draw(reaction.place, reaction.fixed ? context.palette.fixed : context.palette.handle,
                   reaction.name + ": force " + number_text(reaction.force.norm()) + units.after_force() + ", moment " +
                       number_text(reaction.moment_about_middle().norm()) + units.after_moment());
}

/// The size of the load that is selected, dragged or pointed at, at the end of its arrow.
void draw_load_sizes(const Marks& marks, const ShownBody& body) {
    const auto& [context, list, viewport, labels] = marks;
    const ViewerState& state = context.state;
    const Gestures& gestures = state.gestures;
    for (const LoadArrow& arrow : state.load_arrows_at(body)) {
        const bool chosen = gestures.selected_load() == arrow.load || gestures.hover().load == arrow.load;
        if (!chosen && !state.display.arrows) continue;
        const std::string name = arrow.load == LiveScene::kGravity ? "" : state.scene().load_name(arrow.load) + ": ";
        marks.draw(arrow.end, chosen ? context.palette.active : context.palette.load,
                   name + load_text(state.scene(), arrow.load, state.display.units));
    }
}

/// The spring that a patch is pulled through, and the force in it.
void draw_spring(const Marks& marks, const ShownBody& body) {
    const auto& [context, list, viewport, labels] = marks;
    const ViewerState& state = context.state;
    if (!state.gestures.pulling()) return;
    const auto spring = state.gestures.spring_pull(state.scene());
    if (!spring || spring->vertex < 0 || spring->vertex >= body.positions().cols()) return;
    const Eigen::Vector3d place = body.positions().col(spring->vertex);
    const Eigen::Vector2d from = state.camera.project(place, viewport).pixel, to = state.gestures.cursor();
    constexpr int kTurns = 8;
    const Eigen::Vector2d along = (to - from) / (2 * kTurns);
    Eigen::Vector2d side(-along.y(), along.x());
    if (const double length = side.norm(); length > 0.0) side *= 4.0 * context.gui.scale() / length;
    std::vector<ImVec2> line = {im_point(from.x(), from.y())};
    for (int i = 1; i < 2 * kTurns; ++i) {
        const Eigen::Vector2d at = from + i * along + (i % 2 == 0 ? -side : side);
        line.push_back(im_point(at.x(), at.y()));
    }
    line.push_back(im_point(to.x(), to.y()));
    list.AddPolyline(line.data(), static_cast<int>(line.size()), imgui_packed(context.palette.active), 0,
                     2.0f * context.gui.scale());
    marks.draw(place, context.palette.active,
               "force " + number_text(spring->force.norm()) + context.state.display.units.after_force());
}

/// Where a body is crushed that has no equilibrium, as it is shown.
void draw_crushed(const Marks& marks, MethodKind kind, const ShownBody& body) {
    const auto& [context, list, viewport, labels] = marks;
    const ViewerState& state = context.state;
    const std::optional<Crushed>& crushed = state.simulation.runner(kind).crushed();
    const Positions& rest = state.scene().mesh().vertices;
    if (!crushed || body.positions().cols() != rest.cols()) return;
    Eigen::Index nearest = 0;
    (rest.colwise() - crushed->place).colwise().squaredNorm().minCoeff(&nearest);
    marks.draw(body.positions().col(nearest), context.palette.bad, "crushed here");
}

}  // namespace

void draw_marks(const PanelContext& context, ImDrawList& list, const SceneViewport& viewport, LabelPlaces& labels) {
    const ViewerState& state = context.state;
    const MethodKind kind = viewport.kinds.front();
    const ShownBody* body = state.shown.body(kind);
    if (body == nullptr) return;
    const Marks marks{context, list, viewport.place, labels};
    if (state.display.arrows) draw_forces(marks, *body);
    if (state.display.constraints) draw_load_sizes(marks, *body);
    if (state.display.extremes) draw_extremes(marks, *body);
    draw_crushed(marks, kind, *body);
    draw_spring(marks, *body);
    for (const Gizmo& gizmo : state.gizmos()) draw_gizmo(marks, gizmo);
    draw_probes(marks, *body);  // over the gizmos: numbers are to be read
}

}  // namespace elastolab
