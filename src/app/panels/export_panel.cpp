#include "app/panels/export_panel.hpp"

#include <imgui.h>

#include <array>
#include <string>
#include <string_view>

#include "app/panels/file_questions.hpp"
#include "app/panels/widgets.hpp"
#include "app/viewer_state.hpp"

namespace elastolab {

namespace {

struct ExportKind {
    const char* label;
    const char* ending;
    const char* explanation;
};
constexpr std::array<ExportKind, 8> kExports = {
    {{"Deformed mesh (OBJ)...", ".obj", "Vertices and triangles as text, all digits."},
     {"Deformed mesh (STL)...", ".stl", "Triangles in single precision."},
     {"With fields (PLY)...", ".ply",
      "Double precision; displacement, traction, stress and von Mises at the vertices."},
     {"For ParaView: surface (VTP)...", ".vtp",
      "The surface at rest with displacement (Warp By Vector), traction and stress."},
     {"For ParaView: inside (VTU)...", ".vtu", "The tetrahedra at rest with displacement (Warp By Vector) and stress."},
     {"Figure for browsers (HTML)...", ".html",
      "One file in which anyone pulls the handles, without network. Linear methods."},
     {"Morph targets (glTF)...", ".glb", "For Blender and game engines: six for each handle. Linear methods."},
     {"Table of vertices (CSV)...", ".csv", "Rest positions, displacements, tractions and stresses."}}};

/// Why a method cannot have it; empty where it can.
std::string why_not_exported(const ExportKind& kind, MethodKind method) {
    const std::string_view ending = kind.ending;
    if (ending == ".vtu" && !method->has_inside)
        return "This method has no tetrahedra: choose a finite-element method.";
    if ((ending == ".html" || ending == ".glb") && !method->linear) return "A figure needs a linear method.";
    return "";
}

}  // namespace

void draw_export_menu(ViewerState& state, FileQuestions& files) {
    if (!ImGui::BeginMenu("Export")) return;
    for (const ExportKind& kind : kExports) {
        const std::string why_not = why_not_exported(kind, state.method);
        if (ImGui::MenuItem(kind.label, nullptr, false, why_not.empty())) files.ask_export(state, kind.ending);
        tooltip(why_not.empty() ? kind.explanation : why_not.c_str());
    }
    ImGui::EndMenu();
}

}  // namespace elastolab
