#include "app/window/file_dialog.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "app/window/recent_files.hpp"
#include "base/text.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// Enter, where no field takes it.
bool enter_is_pressed() {
    return !ImGui::IsAnyItemActive() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
}

bool has_extension_of(const fs::path& file, const FileDialog::Purpose& purpose) {
    const auto& wanted = purpose.extensions;
    const std::string extension = lower_case(file.extension().string());
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), extension) != wanted.end();
}

}  // namespace

fs::path with_extension(const fs::path& file, const FileDialog::Purpose& purpose) {
    if (has_extension_of(file, purpose)) return file;
    fs::path whole = file;
    return whole += fs::path(purpose.suggestion).extension();
}

void FileDialog::open(Purpose purpose) {
    purpose_ = std::move(purpose);
    name_ = purpose_.suggestion;
    problem_.clear();
    to_replace_.clear();
    all_files_ = false;
    std::error_code error;
    if (fs::path last = purpose_.folder.empty() ? load_last_folder(kind()) : purpose_.folder; !last.empty())
        folder_ = std::move(last);
    if (folder_.empty()) folder_ = fs::current_path(error);
    list_folder();
    open_ = opening_ = opened_by_enter_ = true;
}

/// What folders are remembered by.
std::string FileDialog::kind() const {
    return is_saving() ? fs::path(purpose_.suggestion).extension().string() : "open";
}

void FileDialog::list_folder() {
    entries_.clear();
    std::error_code error;
    for (fs::directory_iterator i(folder_, fs::directory_options::skip_permission_denied, error), end;
         !error && i != end; i.increment(error)) {
        const fs::path path = i->path();
        const std::string name = path.filename().string();
        if (name.starts_with('.')) continue;
        std::error_code ignored;
        const bool is_folder = i->is_directory(ignored);
        if (!is_folder && !all_files_ && !has_extension_of(path, purpose_)) continue;
        entries_.push_back({path, is_folder ? name + "/" : name, is_folder});
    }
    problem_ = error ? folder_.string() + ": " + error.message() : "";
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.is_folder != b.is_folder ? a.is_folder : lower_case(a.shown) < lower_case(b.shown);
    });
}

void FileDialog::accept(const fs::path& typed) {
    std::error_code error;
    if (fs::is_directory(typed, error)) {
        folder_ = fs::weakly_canonical(typed, error);
        list_folder();
        name_ = purpose_.suggestion;
        asks_name_ = true;
        return;
    }
    const fs::path file = is_saving() ? with_extension(typed, purpose_) : typed;
    const bool exists = fs::exists(file, error);
    if (!is_saving() && !exists) {
        problem_ = file.string() + " is not there.";
        return;
    }
    if (const fs::path folder = fs::absolute(file, error).parent_path();
        is_saving() && !fs::is_directory(folder, error)) {
        problem_ = folder.string() + " is no folder. Make it, or save elsewhere.";
        return;
    }
    if (is_saving() && exists && to_replace_ != file) {
        to_replace_ = file;
        return;
    }
    open_ = false;
    ImGui::CloseCurrentPopup();
    save_last_folder(kind(), fs::absolute(file, error).parent_path());
    purpose_.done(file);
}

void FileDialog::draw_places() {
    if (ImGui::Button("Up")) {
        folder_ = folder_.parent_path();
        list_folder();
    }
    ImGui::SameLine();
    if (const char* home = std::getenv("HOME"); home != nullptr && ImGui::Button("Home")) {
        folder_ = home;
        list_folder();
    }
    ImGui::SameLine();
    std::string text = folder_.string();
    ImGui::SetNextItemWidth(-1.0f);
    enter_was_used_ = ImGui::InputText("##folder", &text, ImGuiInputTextFlags_EnterReturnsTrue);
    if (enter_was_used_) accept(text);
}

void FileDialog::draw_entries() {
    const float below = 2.6f * ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("entries", {0.0f, std::max(80.0f, ImGui::GetContentRegionAvail().y - below)}, true);
    for (const Entry& entry : std::vector<Entry>(entries_)) {  // a copy: a click may list another folder
        const bool chosen = !entry.is_folder && entry.shown == name_;
        const bool clicked = ImGui::Selectable(entry.shown.c_str(), chosen, ImGuiSelectableFlags_AllowDoubleClick);
        const bool entered = entry.is_folder && ImGui::IsItemFocused() && enter_is_pressed();
        if (!clicked && !entered) continue;
        if (!entry.is_folder) name_ = entry.shown;
        to_replace_.clear();
        enter_was_used_ = enter_was_used_ || entered;
        if (!entry.is_folder && !ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) continue;
        accept(entry.path);
        break;
    }
    if (entries_.empty()) ImGui::TextDisabled("No such file here.");
    ImGui::EndChild();
}

void FileDialog::draw_name(float scale) {
    const bool appears = ImGui::IsWindowAppearing();
    if (std::exchange(asks_name_, false) || appears) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(std::min(360.0f * scale, 0.5f * ImGui::GetContentRegionAvail().x));
    bool go =
        ImGui::InputText("##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    if (ImGui::IsItemEdited()) to_replace_.clear();
    ImGui::SameLine();
    const bool replaces = !to_replace_.empty();
    // The field has let go of the keys at the first Enter, or a file was chosen in the list.
    if (!ImGui::IsKeyDown(ImGui::GetKeyIndex(ImGuiKey_Enter))) opened_by_enter_ = false;
    go = (!enter_was_used_ && !opened_by_enter_ && !name_.empty() && enter_is_pressed()) || go;
    go = ImGui::Button(replaces ? "Replace" : is_saving() ? "Save" : "Open") || go;
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
        open_ = false;
        ImGui::CloseCurrentPopup();
        if (purpose_.cancelled) purpose_.cancelled();
    } else if (go && !name_.empty()) {
        accept(fs::path(name_).is_absolute() ? fs::path(name_) : folder_ / name_);
        asks_name_ = asks_name_ || !problem_.empty();  // it is typed again
    }
    if (!is_saving() && !purpose_.extensions.empty()) {
        ImGui::SameLine();
        if (ImGui::Checkbox("all files", &all_files_)) list_folder();
    }
    if (replaces)
        ImGui::TextUnformatted("There is a file of that name. Replace, or Enter again, writes over it.");
    else
        ImGui::TextUnformatted(problem_.c_str());
}

void FileDialog::draw(float scale) {
    if (!open_) return;
    const std::string id = purpose_.title + "###file-dialog";
    if (std::exchange(opening_, false)) ImGui::OpenPopup(id.c_str());
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(590.0f * scale, screen.x), std::min(440.0f * scale, 0.95f * screen.y)});
    if (!ImGui::BeginPopupModal(id.c_str(), nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) return;
    draw_places();
    draw_entries();
    draw_name(scale);
    ImGui::EndPopup();
}

void FileDialog::visit_texts(const std::function<void(std::string_view)>& visit) const {
    if (!open_) return;
    visit(folder_.string());
    visit(name_);
    visit(problem_);
    for (const Entry& entry : entries_) visit(entry.shown);
}

}  // namespace elastolab
