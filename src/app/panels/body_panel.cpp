#include "app/panels/body_panel.hpp"

#include <imgui.h>

#include <array>

#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/text.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {

namespace {

constexpr double kFlightPart = 0.06;  ///< of the body's diagonal: what is seen around a defect

/// Cells along an edge of the paper's cubes: 98, 218, 386, 602, 866 and 1016 vertices.
constexpr std::array kPaperCubes = {4, 6, 8, 10, 12, 13};

void draw_poisson_ratio(ViewerState& state, float scale) {
    Material material = state.scene().document().material;
    if (slider("Poisson's ratio", material.poisson_ratio, -0.5, 0.5, "%.3f", scale))
        state.scene().set_material(material);
    if (ImGui::IsItemDeactivatedAfterEdit()) state.scene().commit();
    tooltip(
        "How much the body narrows when it is stretched: 0 not at all, 0.5 as rubber does, at constant volume. "
        "Linear FEM grows too stiff (locks) near 0.5; no FEM can take 0.5 itself.");
}

constexpr std::array<Choice<ProxyUse>, 2> kProxyUses = {
    {{ProxyUse::automatic, "through a proxy",
      "A closed surface around the body is simulated, and the body moves with it. Works for any triangles."},
     {ProxyUse::fill, "with holes filled",
      "The surface itself, its vertices unchanged: each hole is filled with a smooth patch of triangles. "
      "Works where holes are its only defect."}}};
constexpr std::array<Choice<OpenSurface>, 3> kOpenSurfaces = {
    {{OpenSurface::automatic, "by its holes", "A solid when its holes are small beside it, else a sheet."},
     {OpenSurface::solid, "a solid", "Every hole is closed."},
     {OpenSurface::sheet, "a sheet", "Holes stay open; the surface becomes a thin wall."}}};
/// Range of a proxy's vertices that a person can choose.
constexpr int kFewestChosen = 100, kMostChosen = 10000;

}  // namespace

/// How a surface that bounds no solid is simulated.
void BodyPanel::draw_proxy(ViewerState& state, float scale) {
    if (!state.scene().needs_proxy(state.method)) return;
    ProxyChoice choice = state.scene().document().proxy;
    const auto set = [&] {
        state.scene().set_proxy(choice);
        state.scene().commit();
    };
    if (choice.use != ProxyUse::always) {
        set_item_width(scale);
        if (choose<ProxyUse>("simulated", choice.use, kProxyUses)) set();
    }
    if (choice.use == ProxyUse::fill) return;
    if (!state.scene().report().closed) {
        set_item_width(scale);
        if (choose<OpenSurface>("taken for", choice.taken_for, kOpenSurfaces)) set();
    }
    int n_vertices = proxy_vertices_.value_or(choice.n_vertices);
    if (slider("proxy vertices", n_vertices, kFewestChosen, kMostChosen, "about %d", scale))
        proxy_vertices_ = n_vertices;
    if (ImGui::IsItemDeactivatedAfterEdit() && proxy_vertices_) {  // not at every step: a wrap takes its time
        choice.n_vertices = *proxy_vertices_;
        set();
    }
    if (!ImGui::IsItemActive()) proxy_vertices_.reset();
    tooltip("A proxy of more vertices is closer to the surface and takes longer to prepare.");
}

void BodyPanel::draw_young_modulus(ViewerState& state, float scale) {
    const double present = state.scene().document().material.young_modulus;
    if (const auto typed = young_modulus_.draw("Young's modulus", present, scale)) state.set_young_modulus(*typed);
    tooltip(
        "Stiffness: the force per area that would stretch the body by its own length. The forces that a "
        "motion takes grow with it, and the motions that loads and forces cause shrink.");
}

/// What keeps the surface from being a solid, with a button that goes from one place of it to the next.
void BodyPanel::draw_defects(const PanelContext& context) {
    ViewerState& state = context.state;
    const MeshReport& report = state.scene().report();
    const bool has_proxy = state.simulation.embedded(state.method).proxy() != nullptr;
    for (std::size_t i = 0; i < report.defects.size(); ++i) {
        const Defect& defect = report.defects[i];
        if (!defect.fatal || defect.repaired) continue;
        ImGui::PushID(static_cast<int>(i));
        if (!defect.places.empty() && ImGui::SmallButton("show")) {
            const Eigen::Vector3d& place = defect.places[n_flights_++ % defect.places.size()];
            const double radius = kFlightPart * (report.max_corner - report.min_corner).norm();
            state.camera.frame({place, radius}, context.layout.scene.aspect());
        }
        tooltip("Flies to its places one after another; F frames the body again.");
        if (!defect.places.empty()) ImGui::SameLine();
        paragraph(has_proxy ? defect.found + " (a proxy is simulated)" : defect.text,
                  has_proxy ? context.palette.busy : context.palette.bad);
        ImGui::PopID();
    }
}

void BodyPanel::make(ViewerState& state) {
    state.open_primitive({.name = primitive_, .resolution = resolution_, .size = {}});
}

void BodyPanel::draw(const PanelContext& context, const std::function<void()>& ask_open) {
    ViewerState& state = context.state;
    const LiveScene& scene = state.scene();
    const float scale = context.gui.scale();
    const std::string file = std::filesystem::path(scene.name()).filename().string();
    const std::string size =
        count_text(scene.mesh().n_vertices()) + " vertices, " + count_text(scene.mesh().n_triangles()) + " triangles";
    const float room = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x;
    paragraph(file, context.palette.text);
    if (ImGui::CalcTextSize(file.c_str()).x + ImGui::CalcTextSize(size.c_str()).x < room) ImGui::SameLine();
    paragraph(size, context.palette.text_dim);
    draw_defects(context);
    draw_proxy(state, scale);
    draw_poisson_ratio(state, scale);
    draw_young_modulus(state, scale);
    if (!ImGui::TreeNode("New body")) return;
    set_item_width(scale);
    if (begin_choice("shape", primitive_.c_str())) {
        for (const std::string& name : primitive_names())
            if (choice_entry(name.c_str(), "", name == primitive_)) primitive_ = name;
        end_choice();
    }
    slider("resolution", resolution_, 1, 30, "%d cells", scale);
    tooltip("Cells along the shortest edge, or around a quarter turn.");
    if (primitive_ == "cube") {
        ImGui::TextColored(imgui_colour(context.palette.text_dim), "the paper's:");
        for (const int cells : kPaperCubes) {
            ImGui::SameLine();
            if (ImGui::SmallButton(std::to_string(6 * cells * cells + 2).c_str())) resolution_ = cells;
        }
    }
    if (ImGui::Button("Make it")) make(state);
    ImGui::SameLine();
    if (ImGui::Button("Open a file...")) ask_open();
    ImGui::TreePop();
}

}  // namespace elastolab
