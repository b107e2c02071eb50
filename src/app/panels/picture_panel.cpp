#include "app/panels/picture_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/panels/file_questions.hpp"
#include "app/panels/panel_context.hpp"
#include "app/panels/widgets.hpp"
#include "app/picture/film.hpp"

namespace elastolab {

namespace {

constexpr const char* kPictureTitle = "Picture";
constexpr int kLargestPicture = 32768, kMostFrames = 3600;

void draw_number(const char* label, int& value, int low, int high, float scale) {
    ImGui::SetNextItemWidth(110.0f * scale);
    ImGui::InputInt(label, &value, 0, 0);
    value = std::clamp(value, low, high);
    tooltip((std::to_string(low) + " to " + std::to_string(high)).c_str());
}

/// A single picture, or what film; whether it is one.
bool draw_film_choice(PictureRequest& picture) {
    int chosen = picture.n_frames == 0 ? 0 : picture.kind == FilmKind::turn ? 1 : 2;
    const int before = chosen;
    ImGui::RadioButton("one picture", &chosen, 0);
    ImGui::RadioButton("turntable: one turn as numbered frames", &chosen, 1);
    ImGui::RadioButton("pull: from rest to here and back, as numbered frames", &chosen, 2);
    if (chosen != before) picture.n_frames = chosen == 0 ? 0 : std::max(picture.n_frames, 120);
    if (chosen != 0) picture.kind = chosen == 1 ? FilmKind::turn : FilmKind::pull;
    return chosen != 0;
}

const char* film_ending(const PictureRequest& picture) {
    if (picture.n_frames == 0) return ".png";
    return picture.kind == FilmKind::turn ? "-turn.png" : "-pull.png";
}

}  // namespace

void PicturePanel::draw(const PanelContext& context, FileQuestions& files) {
    draw_question(context, files);
    draw_progress(context);
}

/// Size and kind of a picture, before its name is asked for.
void PicturePanel::draw_question(const PanelContext& context, FileQuestions& files) {
    ViewerState& state = context.state;
    if (std::exchange(asks_, false)) {
        ImGui::OpenPopup(kPictureTitle);
        video_obstacle_ = video_obstacle();
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float scale = context.gui.scale();
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(kPictureTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
        return;
    draw_number("##width", picture_.size.x(), 16, kLargestPicture, scale);
    ImGui::SameLine();
    ImGui::TextUnformatted("x");
    ImGui::SameLine();
    draw_number("pixels", picture_.size.y(), 16, kLargestPicture, scale);
    ImGui::Checkbox("transparent background", &picture_.transparent);
    ImGui::Checkbox("legend", &picture_.legend);
    tooltip("The colours of the field that is shown, at the lower right.");
    const bool is_film = draw_film_choice(picture_);
    if (is_film) {
        draw_number("frames", picture_.n_frames, 2, kMostFrames, scale);
        if (video_obstacle_.empty())
            ImGui::Checkbox("and as a video (MP4, 30 frames a second)", &picture_.video);
        else
            ImGui::TextDisabled("No video: %s", video_obstacle_.c_str());
    }
    const bool enter = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) && !ImGui::IsWindowAppearing();
    if (ImGui::Button("Save as...") || enter) {
        picture_.video = picture_.video && is_film && video_obstacle_.empty();
        ImGui::CloseCurrentPopup();
        files.ask_picture(state, picture_, film_ending(picture_));
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

/// While the frames of a film are drawn. No key or button reaches anything else: what is changed would be in the film.
void PicturePanel::draw_progress(const PanelContext& context) {
    constexpr const char* kTitle = "##pictures";
    ViewerState& state = context.state;
    if (state.pictures_under_way && !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId)) ImGui::OpenPopup(kTitle);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    constexpr ImGuiWindowFlags kFixed =
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove;
    if (!ImGui::BeginPopupModal(kTitle, nullptr, kFixed)) return;
    if (state.pictures_under_way) {
        const auto [done, wanted] = *state.pictures_under_way;
        ImGui::Text("Frame %d of %d", done, wanted);
        ImGui::ProgressBar(static_cast<float>(done) / static_cast<float>(wanted), {260.0f * context.gui.scale(), 0.0f});
        if (ImGui::Button("Stop")) state.requests.stop_pictures = true;
    } else {
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

}  // namespace elastolab
