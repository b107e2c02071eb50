#include "app/panels/export_panel.hpp"

#include <imgui.h>

#include <array>
#include <string>

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

}  // namespace

void draw_export_menu(ViewerState& state, FileQuestions& files) {
    if (!ImGui::BeginMenu("Export")) return;
    for (const ExportKind& kind : kExports) {
        const bool possible = std::string(kind.ending) != ".vtu" || state.method->has_inside;
        if (ImGui::MenuItem(kind.label, nullptr, false, possible)) files.ask_export(state, kind.ending);
        tooltip(possible ? kind.explanation : "This method has no tetrahedra: choose a finite-element method.");
    }
    ImGui::EndMenu();
}

}  // namespace elastolab
