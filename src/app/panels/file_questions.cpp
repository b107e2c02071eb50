#include "app/panels/file_questions.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "app/viewer_state.hpp"

namespace elastolab {

namespace {

const std::vector<std::string> kMeshFiles = {".obj", ".ply", ".stl", ".off", ".gltf", ".glb"};

std::vector<std::string> with_scenes(std::vector<std::string> extensions) {
    extensions.insert(extensions.begin(), ".json");
    return extensions;
}

}  // namespace

std::string suggested_name(const ViewerState& state, const std::string& ending) {
    return std::filesystem::path(state.scene().name()).stem().string() + ending;
}

/// Where the body or scene on the screen is from; empty where it is from no file.
std::filesystem::path folder_of_body(const ViewerState& state) {
    const std::filesystem::path file =
        state.files.file().empty() ? std::filesystem::path(state.scene().name()) : state.files.file();
    std::error_code error;
    return std::filesystem::exists(file, error) ? std::filesystem::absolute(file, error).parent_path() : "";
}

void FileQuestions::ask_open(ViewerState& state) {
    dialog_.open({.title = "Open a mesh or scene",
                  .extensions = with_scenes(kMeshFiles),
                  .suggestion = "",
                  .done = [&](const auto& file) { state.files.open(file); },
                  .folder = folder_of_body(state)});
}

void FileQuestions::save(ViewerState& state) {
    if (state.files.owns_file())
        state.files.save(std::filesystem::path(state.files.file()));
    else
        save_as(state);
}

void FileQuestions::ask_name_of_scene(ViewerState& state, std::function<void(const std::filesystem::path&)> done,
                                      std::function<void()> cancelled) {
    const std::filesystem::path& present = state.files.file();
    dialog_.open({.title = "Save the scene",
                  .extensions = {".json"},
                  .suggestion = present.empty() ? suggested_name(state, ".json") : present.filename().string(),
                  .done = std::move(done),
                  .cancelled = std::move(cancelled),
                  .folder = present.parent_path()});
}

void FileQuestions::save_as(ViewerState& state) {
    ask_name_of_scene(state, [&](const auto& file) { state.files.save(file); });
}

void FileQuestions::ask_name_of_unsaved(ViewerState& state) {
    ask_name_of_scene(
        state,
        [&](const auto& file) {
            if (state.files.save(file)) state.files.unsaved.proceed();
        },
        [&] { state.files.unsaved.cancel(); });
}

void FileQuestions::ask_export(ViewerState& state, const std::string& ending) {
    dialog_.open({.title = "Export (" + ending + ")",
                  .extensions = {ending},
                  .suggestion = suggested_name(state, "-deformed" + ending),
                  .done = [&](const auto& file) { state.export_mesh(file); }});
}

void FileQuestions::ask_screenshot(ViewerState& state) {
    dialog_.open({"Save a screenshot", {".png"}, suggested_name(state, ".png"), [&](const auto& file) {
                      state.requests.screenshot = file;
                  }});
}

void FileQuestions::ask_probes(ViewerState& state) {
    dialog_.open({"Save the probes", {".csv"}, suggested_name(state, "-probes.csv"), [&](const auto& file) {
                      state.save_probes(file);
                  }});
}

void FileQuestions::ask_timings(ViewerState& state) {
    dialog_.open({"Record frame timings", {".csv"}, suggested_name(state, "-timings.csv"), [&](const auto& file) {
                      state.record_timings(file);
                  }});
}

void FileQuestions::ask_picture(ViewerState& state, const PictureRequest& picture, const std::string& ending) {
    dialog_.open({.title = picture.n_frames > 0 ? "Save the frames of a film" : "Save a picture",
                  .extensions = {".png"},
                  .suggestion = suggested_name(state, ending),
                  .done = [&state, picture = picture](const auto& file) mutable {
                      picture.file = file;
                      state.requests.picture = picture;
                  }});
}

}  // namespace elastolab
