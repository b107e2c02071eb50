#include <imgui.h>

#include <array>

#include "app/panels.hpp"
#include "app/widgets.hpp"
#include "base/text.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {

namespace {

/// Cells along an edge of the paper's cubes: 98, 218, 386, 602, 866 and 1016 vertices.
constexpr std::array kPaperCubes = {4, 6, 8, 10, 12, 13};

/// Holds a body where its kind is usually held: cubes, boxes and beams at the left, others at the bottom.
Selector usual_base(const std::string& primitive, const SurfaceMesh& mesh) {
    const bool at_left = primitive == "cube" || primitive == "box" || primitive == "beam";
    const int axis = at_left ? 0 : 2;
    const double low = mesh.vertices.row(axis).minCoeff(), high = mesh.vertices.row(axis).maxCoeff();
    const bool is_flat = at_left || primitive == "cylinder";
    return {PlaneSelector{low * Eigen::Vector3d::Unit(axis), Eigen::Vector3d::Unit(axis),
                          (is_flat ? 1e-6 : 0.12) * (high - low)}};
}

void draw_material(ViewerState& state, float scale) {
    Material material = state.scene().document().material;
    bool changed = false;
    set_item_width(scale);
    double nu = material.poisson_ratio;
    const double low = -0.5, high = 0.5;
    if (ImGui::SliderScalar("Poisson's ratio", ImGuiDataType_Double, &nu, &low, &high, "%.3f")) {
        material.poisson_ratio = nu;
        changed = true;
    }
    tooltip(
        "How much the body narrows when it is stretched: 0 not at all, 0.5 as rubber does, keeping its volume. "
        "FEM with linear tetrahedra grows too stiff near 0.5 and cannot take 0.5 itself.");
    bool done = ImGui::IsItemDeactivatedAfterEdit();
    set_item_width(scale);
    if (ImGui::InputDouble("Young's modulus", &material.young_modulus, 0.0, 0.0, "%.4g")) {
        changed = material.young_modulus > 0.0;
        if (!changed) state.messages.error("Young's modulus must be positive. Enter a force per area above 0.");
    }
    tooltip("Stiffness: force per area for a stretch by its own length. Displacements do not depend on it, forces do.");
    done = done || ImGui::IsItemDeactivatedAfterEdit();
    if (changed) state.scene().set_material(material);
    if (done) state.scene().commit();
}

}  // namespace

void Panels::open_primitive(ViewerState& state) {
    Document document;
    document.material = state.scene().document().material;
    document.method = state.method;
    document.mesh = Primitive{.name = primitive_, .resolution = resolution_, .size = {}};
    document.fixed = usual_base(primitive_, make_primitive(primitive_, resolution_));
    state.open_document(std::move(document), primitive_ + ".json");
}

void Panels::draw_body(const PanelContext& context) {
    ViewerState& state = context.state;
    const LiveScene& scene = state.scene();
    const float scale = context.gui.scale();
    paragraph(std::filesystem::path(scene.name()).filename().string(), context.palette.text);
    ImGui::SameLine();
    ImGui::TextColored(imgui_colour(context.palette.text_dim), "%s vertices, %s triangles",
                       count_text(scene.mesh().n_vertices()).c_str(), count_text(scene.mesh().n_triangles()).c_str());
    draw_material(state, scale);
    if (!ImGui::TreeNode("New body")) return;
    set_item_width(scale);
    if (begin_choice("shape", primitive_.c_str())) {
        for (const std::string& name : primitive_names())
            if (choice_entry(name.c_str(), "", name == primitive_)) primitive_ = name;
        end_choice();
    }
    set_item_width(scale);
    ImGui::SliderInt("resolution", &resolution_, 1, 30, "%d cells");
    tooltip("Cells along the shortest edge, or around a quarter turn.");
    if (primitive_ == "cube") {
        ImGui::TextColored(imgui_colour(context.palette.text_dim), "the paper's:");
        for (const int cells : kPaperCubes) {
            ImGui::SameLine();
            if (ImGui::SmallButton(std::to_string(6 * cells * cells + 2).c_str())) resolution_ = cells;
        }
    }
    if (ImGui::Button("Make it")) open_primitive(state);
    ImGui::SameLine();
    if (ImGui::Button("Open a file...")) ask_open(state);
    ImGui::TreePop();
}

}  // namespace elastolab
