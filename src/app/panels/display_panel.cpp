#include "app/panels/display_panel.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>
#include <string>

#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "base/text.hpp"
#include "render/colour_map.hpp"

namespace elastolab {

namespace {

constexpr std::array<Choice<Field>, 16> kFields = {
    {{Field::none, "plain", "One colour for each method."},
     {Field::displacement, "displacement", "How far every vertex has moved."},
     {Field::displacement_x, "displacement x", "How far every vertex has moved along x."},
     {Field::displacement_y, "displacement y", "How far every vertex has moved along y."},
     {Field::displacement_z, "displacement z", "How far every vertex has moved along z."},
     {Field::difference, "difference", "How far each vertex is from its place by the reference method (see Compare)."},
     {Field::traction, "traction", "Force per area on the constrained parts of the surface; zero elsewhere."},
     {Field::von_mises, "von Mises stress",
      "How near the material at the surface is to yielding: from the stretch of "
      "each triangle and, where it is constrained, the traction."},
     {Field::first_principal, "first principal stress", "The largest tension in any direction; negative: pressure."},
     {Field::third_principal, "third principal stress", "The largest pressure in any direction, negative."},
     {Field::stress_xx, "stress xx", "Force along x per area on planes normal to x; tension is positive."},
     {Field::stress_yy, "stress yy", "Force along y per area on planes normal to y; tension is positive."},
     {Field::stress_zz, "stress zz", "Force along z per area on planes normal to z; tension is positive."},
     {Field::stress_xy, "stress xy", "Shear: force along x per area on planes normal to y."},
     {Field::stress_yz, "stress yz", "Shear: force along y per area on planes normal to z."},
     {Field::stress_xz, "stress xz", "Shear: force along x per area on planes normal to z."}}};

constexpr std::array<Choice<SurfaceMaterial>, 4> kMaterials = {
    {{SurfaceMaterial::studio, "studio", "Studio lights; shows the colours of fields most faithfully."},
     {SurfaceMaterial::clay, "clay", "Matt and soft: shows the shape without highlights."},
     {SurfaceMaterial::wax, "wax", "Light scatters below the surface, as in skin and rubber."},
     {SurfaceMaterial::metal, "metal", "Reflects a horizon: shows every dent."}}};

enum class RangeRule { data, most, typed };
constexpr std::array<Choice<RangeRule>, 3> kRangeRules = {
    {{RangeRule::data, "of all that is seen", "From the smallest to the largest value of what is not cut away."},
     {RangeRule::most, "of 98 % of it", "Leaves out the two per cent that are most extreme, such as at sharp rims."},
     {RangeRule::typed, "typed", "Stays as it is typed, for this field."}}};
constexpr double kMostOfData = 0.98;

void draw_range_rule(ViewerState& state) {
    DisplaySettings& display = state.display;
    RangeRule rule = display.typed_ranges.contains(display.field) ? RangeRule::typed
                     : display.range_part < 1.0                   ? RangeRule::most
                                                                  : RangeRule::data;
    const auto range = state.shown.field_range(display);
    if (!choose<RangeRule>("range", rule, kRangeRules)) return;
    if (rule == RangeRule::typed) {
        display.typed_ranges[display.field] = range;
        return;
    }
    display.typed_ranges.erase(display.field);
    display.range_part = rule == RangeRule::most ? kMostOfData : 1.0;
}

void draw_end_of_range(const char* label, double& end, float scale) {
    ImGui::SetNextItemWidth(80.0f * scale);
    draw_number(label, end);
}

void draw_range(ViewerState& state, float scale) {
    DisplaySettings& display = state.display;
    set_item_width(scale);
    std::string& chosen = is_signed(display.field) ? display.signed_colour_map : display.colour_map;
    if (begin_choice("colours", chosen.c_str())) {
        for (const ColourMap& map : colour_maps())
            if (choice_entry(map.name().c_str(), "", map.name() == chosen)) chosen = map.name();
        end_choice();
    }
    draw_range_rule(state);
    if (const auto typed = display.typed_ranges.find(display.field); typed != display.typed_ranges.end()) {
        auto& [low, high] = typed->second;
        draw_end_of_range("##low", low, scale);
        ImGui::SameLine();
        draw_end_of_range("from, to", high, scale);
    }
    ImGui::Checkbox("hold while pulling", &display.hold_range);
    tooltip("The range stays as it was when the pull began, so that colours can be compared.");
    if (!is_signed(display.field)) {
        ImGui::SameLine();
        ImGui::Checkbox("log", &display.logarithmic);
        tooltip("Equal steps of colour for equal factors: shows what is small beside what is large.");
    }
    ImGui::Checkbox("mark extremes", &display.extremes);
    tooltip("Marks where the field is largest and, if it has a sign, smallest; also beside the colours.");
    ImGui::SameLine();
    ImGui::Checkbox("bands", &display.bands);
    tooltip("Ten steps of colour with lines between them, as on a map.");
}

/// Names that a person gives to the units; what is computed does not depend on them.
void draw_units(UnitNames& units, float scale) {
    const auto draw = [&](const char* label, const char* hint, std::string& name) {
        ImGui::SetNextItemWidth(56.0f * scale);
        std::string typed = name;
        if (ImGui::InputTextWithHint(label, hint, &typed) && typed.size() <= UnitNames::kLongest)
            name = one_line(typed);
        tooltip("What to write behind numbers, such as mm or N. Nothing is converted.");
    };
    draw("length unit", "-", units.length);
    ImGui::SameLine(0.5f * ImGui::GetWindowContentRegionMax().x);
    draw("force unit", "-", units.force);
}

void draw_section(DisplaySettings& display, float scale) {
    ImGui::Checkbox("cut open", &display.section);
    tooltip("A plane through the body at rest, which moves as the body does. Displacement and stresses colour it.");
    if (!display.section) return;
    for (int axis = 0; axis < 3; ++axis) {
        ImGui::SameLine();
        constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
        if (ImGui::RadioButton(kAxes[static_cast<std::size_t>(axis)], display.cut.axis == axis))
            display.cut.axis = axis;
    }
    slider("place", display.cut.place, 0.0, 1.0, "%.2f", scale);
    slider("turn", display.cut.turn, -90.0, 90.0, "%.0f\u00b0", scale);
    slider("tilt", display.cut.tilt, -90.0, 90.0, "%.0f\u00b0", scale);
    ImGui::Checkbox("keep the other side", &display.cut.flip);
    ImGui::Checkbox("gizmo at the plane", &display.section_gizmo);
    tooltip("Drag its arrow to move the plane, its rings to turn and tilt it; with Ctrl in steps.");
}

}  // namespace

void draw_display(const PanelContext& context) {
    DisplaySettings& display = context.state.display;
    const float scale = context.gui.scale();
    set_item_width(scale);
    choose<Field>("colour by", display.field, kFields);
    if (display.field != Field::none) draw_range(context.state, scale);
    set_item_width(scale);
    choose<SurfaceMaterial>("material", display.material, kMaterials);
    factor_slider("deformation", display.deformation_scale, 0.1, 10.0, "x %.2f", scale);
    tooltip("Shows displacements larger or smaller than they are.");
    struct Switch {
        const char* label;
        bool DisplaySettings::*value;
        const char* explanation;
    };
    constexpr std::array<Switch, 9> kSwitches = {
        {{"wireframe", &DisplaySettings::wireframe, "W"},
         {"flat", &DisplaySettings::flat, "One shade for each triangle."},
         {"creases", &DisplaySettings::feature_edges, "Sharp edges of the rest shape."},
         {"rest shape", &DisplaySettings::rest_shape, "The undeformed body, drawn faintly."},
         {"constraints", &DisplaySettings::constraints, "Fixed vertices and handles as points."},
         {"forces", &DisplaySettings::arrows, "Forces that the fixed sets and every handle exert on the body."},
         {"grid", &DisplaySettings::grid, ""},
         {"defects", &DisplaySettings::defects,
          "Rims of holes, the patches that fill them where those are simulated, and edges of more or fewer than two "
          "triangles."},
         {"soft shadows", &DisplaySettings::soft_shadows,
          "Hollows are darker, and the body throws a shadow on the ground."}}};
    for (std::size_t i = 0; i < kSwitches.size(); ++i) {
        if (i % 2 == 1) ImGui::SameLine(0.5f * ImGui::GetWindowContentRegionMax().x);
        ImGui::Checkbox(kSwitches[i].label, &(display.*kSwitches[i].value));
        tooltip(kSwitches[i].explanation);
    }
    ImGui::SameLine(0.5f * ImGui::GetWindowContentRegionMax().x);
    bool light = !display.dark;
    if (ImGui::Checkbox("light theme", &light)) display.dark = !light;
    tooltip("T");
    draw_section(display, scale);
    draw_units(display.units, scale);
}

}  // namespace elastolab
