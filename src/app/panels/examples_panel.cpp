#include "app/panels/examples_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <utility>

#include "app/viewer_state.hpp"

namespace elastolab {

namespace {

constexpr int kMostColumns = 4;
constexpr float kPictureWidth = 150.0f, kPictureHeight = 100.0f, kPictureGap = 6.0f;

/// As many as fit between the menu that is being drawn and the right edge of the window: a wider one would come up
/// under the cursor, where the click that is to open it chooses a scene.
std::size_t columns_beside_menu(float scale) {
    const float room = ImGui::GetIO().DisplaySize.x - ImGui::GetWindowPos().x - ImGui::GetWindowWidth() -
                       2.0f * ImGui::GetStyle().WindowPadding.x;
    const auto columns = static_cast<int>(room / ((kPictureWidth + kPictureGap) * scale));
    return static_cast<std::size_t>(std::clamp(columns, 1, kMostColumns));
}

}  // namespace

/// Read when the menu is opened for the first time. One that cannot be read is shown by its name alone.
void ExamplesPanel::load() {
    if (loaded_) return;
    loaded_ = true;
    for (Example& example : examples()) {
        std::unique_ptr<PictureTexture> picture;
        try {
            if (!example.picture.empty()) picture = std::make_unique<PictureTexture>(example.picture);
        } catch (const std::exception&) {
        }
        examples_.push_back({std::move(example), std::move(picture)});
    }
}

void ExamplesPanel::draw(ViewerState& state, float scale) {
    const std::size_t columns = columns_beside_menu(scale);
    if (!ImGui::BeginMenu("Examples")) return;
    load();
    if (examples_.empty()) ImGui::TextDisabled("They are not installed.");
    const ImVec2 picture{kPictureWidth * scale, kPictureHeight * scale};
    const ImVec2 size{picture.x, picture.y + ImGui::GetTextLineHeightWithSpacing()};
    for (std::size_t i = 0; i < examples_.size(); ++i) {
        const auto& [example, texture] = examples_[i];
        if (i % columns > 0) ImGui::SameLine(0.0f, kPictureGap * scale);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        if (ImGui::Selectable(("##" + example.name).c_str(), false, 0, size)) state.files.open(example.scene);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (texture)
            list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture->id())), at,
                          {at.x + picture.x, at.y + picture.y});
        const float width = ImGui::CalcTextSize(example.name.c_str()).x;
        list.AddText({at.x + 0.5f * (picture.x - width), at.y + picture.y}, ImGui::GetColorU32(ImGuiCol_Text),
                     example.name.c_str());
    }
    ImGui::EndMenu();
}

}  // namespace elastolab
