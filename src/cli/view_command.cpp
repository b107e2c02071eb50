#include <algorithm>
#include <charconv>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/files/series.hpp"
#include "app/picture/film.hpp"
#include "app/viewer.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/solve_outputs.hpp"
#include "cli/threads.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxWindow = 16384;
constexpr const char* kInterrupted = "Interrupted; no picture, scene or mesh was written.";

/// What the command line says, word for word.
struct ViewWords {
    std::string input, method, screenshot, timings, timeline, replay, record, scene_out, mesh_out, size, picture,
        picture_size, field, cut, series;
    int frames = 0, threads = 0, turntable = 0, pull_film = 0;
    bool hidden = false, transparent = false, legend = false;
};

Eigen::Vector2i parse_size(const std::string& option, const std::string& text) {
    Eigen::Vector2i size;
    const char* end = text.data() + text.size();
    const auto [cross, first] = std::from_chars(text.data(), end, size.x());
    if (first == std::errc() && cross != end && *cross == 'x') {
        const auto [last, second] = std::from_chars(cross + 1, end, size.y());
        if (second == std::errc() && last == end && size.minCoeff() >= 1 && size.maxCoeff() <= kMaxWindow) return size;
    }
    throw UsageError(option + " " + text + ": give width and height in pixels, as in 1280x800.");
}

/// The scene that is opened; nothing where it cannot be read, of which the viewer tells.
std::optional<Document> scene_of(const ViewWords& words) {
    Document document;
    try {
        if (!words.input.empty() && is_scene_file(words.input)) return load_scene(words.input);
    } catch (const Error&) {
        return std::nullopt;
    }
    if (!words.input.empty()) document.mesh = MeshFile{words.input};
    return document;
}

/// A film is written as numbered pictures.
std::vector<fs::path> pictures_of(const ViewWords& words) {
    const int n = std::max(words.turntable, words.pull_film);
    if (n == 0) return {words.picture};
    std::vector<fs::path> frames;
    for (int frame = 1; frame <= n; ++frame) frames.push_back(frame_file(words.picture, frame));
    return frames;
}

/// A scene may be written back to where it was read, but not to its mesh.
void require_distinct_files(const ViewWords& words, const std::optional<Document>& scene) {
    std::vector<fs::path> outputs = {words.screenshot, words.timings,  words.timeline,
                                     words.record,     words.mesh_out, words.series};
    for (fs::path& picture : pictures_of(words)) outputs.push_back(std::move(picture));
    std::vector<fs::path> inputs = {words.replay};
    if (scene && !words.input.empty()) {
        const std::vector<fs::path> files = files_of_scene(words.input, scene->mesh);
        inputs.insert(inputs.end(), files.begin() + 1, files.end());
    }
    for (const fs::path& output : outputs)
        if (is_part_of_series(words.series, output))
            throw UsageError(output.string() + ": is a part of --series " + words.series + ". Name another file.");
    require_distinct(outputs, {words.input});
    outputs.emplace_back(words.scene_out);
    require_distinct(outputs, inputs);
}

/// What cannot be written is refused before the window opens, where nobody can change the scene in it.
void require_mesh(const ViewWords& words, const std::optional<Document>& scene) {
    if (words.mesh_out.empty()) return;
    require_mesh_extension(words.mesh_out);
    if (!scene || !words.hidden || !words.replay.empty()) return;
    const MethodKind method = parse_method_kind(words.method).value_or(scene->method);
    require_inside(method, words.mesh_out);
    OutputPaths paths;
    paths.mesh = words.mesh_out;
    require_figure(method, *scene, paths);
}

/// A legend is of a field: one that is asked for, or the scene's, or one that a replay may choose.
void require_colours(const ViewWords& words, const std::optional<Document>& scene) {
    if (!words.legend || !scene || !words.replay.empty()) return;
    const Field of_scene = scene->shown ? scene->shown->field : Field::none;
    if (parse_field(words.field).value_or(of_scene) == Field::none)
        throw UsageError("--legend: no field colours the body. Add --field NAME.");
}

void require_png(const std::string& option, const std::string& file) {
    if (!file.empty() && lower_case(fs::path(file).extension().string()) != ".png")
        throw UsageError(option + " " + file + ": pictures are written as .png. Choose that extension.");
}

ViewerOptions options_of(const ViewWords& words) {
    ViewerOptions options;
    options.input = words.input;
    options.asked.method = parse_method_kind(words.method);
    options.n_frames = words.frames;
    options.screenshot = words.screenshot;
    options.timings = words.timings;
    options.timeline = words.timeline;
    options.replay = words.replay;
    options.record = words.record;
    options.scene_out = words.scene_out;
    options.mesh_out = words.mesh_out;
    options.series = words.series;
    if (!words.series.empty() && lower_case(options.series.extension().string()) != ".pvd")
        throw UsageError("--series " + words.series + ": a series for ParaView is called .pvd. Choose that extension.");
    options.hidden = words.hidden;
    require_png("--screenshot", words.screenshot);
    require_png("--picture", words.picture);
    const std::optional<Document> scene = scene_of(words);
    require_distinct_files(words, scene);
    require_mesh(words, scene);
    if (!words.size.empty()) options.size = parse_size("--size", words.size);
    options.picture = words.picture;
    options.transparent = words.transparent;
    options.legend = words.legend;
    options.asked.field = parse_field(words.field);
    if (!words.cut.empty()) options.asked.cut_axis = words.cut.front() - 'x';
    require_colours(words, scene);
    options.film_frames = std::max(words.turntable, words.pull_film);
    options.film = words.pull_film > 0 ? FilmKind::pull : FilmKind::turn;
    if (!words.picture_size.empty()) options.picture_size = parse_size("--picture-size", words.picture_size);
    if (options.hidden && options.n_frames == 0 && options.replay.empty())
        throw UsageError("--hidden: nobody could close that window. Add --frames N or --replay FILE.");
    return options;
}

}  // namespace

Command add_view_command(CLI::App& program) {
    const auto words = std::make_shared<ViewWords>();
    CLI::App* parser = program.add_subcommand("view", "opens the viewer on a scene or a mesh (default: a cube)");
    const CLI::Validator path([](std::string& text) { return text.empty() ? "the name is empty" : ""; }, "PATH");
    parser->add_option("input", words->input, "scene file (.json) or mesh")->check(path);
    parser->add_option("--method", words->method, "default: the scene's own")->check(CLI::IsMember(method_names()));
    parser->add_option("--field", words->field, "field that colours the body")->check(CLI::IsMember(field_names()));
    parser->add_option("--cut", words->cut, "cuts the body open through its middle, across this axis")
        ->check(CLI::IsMember({"x", "y", "z"}));
    parser->add_option("--frames", words->frames, "quit after so many frames")->check(CLI::Range(1, 1000000000));
    parser->add_option("--screenshot", words->screenshot, "PNG of the last frame")->check(path);
    parser->add_option("--timeline", words->timeline, "CSV: when the window, the body and its answers are first seen")
        ->check(path);
    parser->add_option("--timings", words->timings, "CSV: records frame timings from the start")->check(path);
    CLI::Option* const replay =
        parser->add_option("--replay", words->replay, "repeats a recorded interaction")->check(path);
    parser->add_option("--series", words->series, "PVD for ParaView: the fields of every step of the replay")
        ->needs(replay)
        ->check(path);
    parser->add_option("--record", words->record, "records the interaction")->check(path);
    parser->add_option("--scene-out", words->scene_out, "JSON: the scene as it is at the end")->check(path);
    parser
        ->add_option(
            "--mesh-out", words->mesh_out,
            "the deformed mesh at the end: OBJ, STL or PLY; VTP, VTU: at rest, with the displacement; GLB: at rest, "
            "with morph targets")
        ->check(path);
    CLI::Option* const picture =
        parser->add_option("--picture", words->picture, "PNG of the scene alone, as it is at the end")->check(path);
    parser->add_option("--picture-size", words->picture_size, "in pixels (default 1920x1080)")->needs(picture);
    parser->add_flag("--transparent", words->transparent, "that picture without background")->needs(picture);
    parser->add_flag("--legend", words->legend, "that picture with the colours of the field")->needs(picture);
    CLI::Option* const turntable =
        parser
            ->add_option("--turntable", words->turntable,
                         "this many frames of one turn instead of one picture: FILE-0001.png, ...")
            ->needs(picture)
            ->check(CLI::Range(2, 3600));
    parser
        ->add_option("--pull-film", words->pull_film, "this many frames of the pull, from rest to where it is and back")
        ->needs(picture)
        ->excludes(turntable)
        ->check(CLI::Range(2, 3600));
    parser->add_option("--size", words->size, "size of the window in pixels, as in 1280x800");
    add_threads_option(*parser, words->threads);
    parser->add_flag("--hidden", words->hidden, "no visible window; still real OpenGL");
    return {parser, [words] {
                apply_threads_option(words->threads);
                Control control;
                const InterruptGuard interrupt(control, kInterrupted, wake_viewer);
                try {
                    run_viewer(options_of(*words), control);
                } catch (const Cancelled&) {
                    throw Interrupted(kInterrupted);
                }
            }};
}

}  // namespace elastolab
