#include "app/files/scene_io.hpp"

#include <utility>

#include "app/files/up_axis.hpp"
#include "app/names.hpp"
#include "base/text.hpp"
#include "findings/cost.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// Holds the lowest part of a body that nothing holds yet. The person has changed nothing by that.
void hold_lowest(LiveScene& scene, const Eigen::Vector3d& up) {
    scene.fix(first_held_vertices(scene.mesh(), up));
    scene.commit();
    scene.mark_saved();
}

constexpr double kLongSeconds = 15.0, kFarSooner = 4.0;  ///< times
constexpr int kSmall = 2000;                             ///< vertices up to which nothing takes so long

/// A body does not begin with a method that takes long where another one is exact far sooner. Returns what is to be
/// said of that; empty where it begins as usual.
std::string begin_with_what_is_soon(LiveScene& scene) {
    const MethodKind usual = scene.document().method;
    const auto cost_of = [&](MethodKind kind) { return predict_cost(scene.mesh(), {.kind = kind}); };
    if (scene.needs_proxy(usual) || scene.mesh().n_vertices() <= kSmall) return "";  // a proxy has few vertices
    const Cost own = cost_of(usual);
    if (own.seconds() < kLongSeconds) return "";
    MethodKind soonest = usual;
    double seconds = own.seconds() / kFarSooner;
    for (const MethodKind kind : all_methods())
        if (const double its = cost_of(kind).seconds(); !scene.needs_proxy(kind) && its < seconds) {
            soonest = kind;
            seconds = its;
        }
    if (soonest == usual) return "";
    scene.start_with(soonest, scene.document().settings);
    return title(soonest) + " comes first: exact in about " + readable_prediction(seconds) + ". " + title(usual) +
           " would take about " + readable_prediction(own.seconds()) + " and " +
           readable_bytes(static_cast<double>(own.memory_bytes)) + "; choose it in the panel.";
}

}  // namespace

/// Our scenes have Z up.
LoadedScene load_scene_or_mesh(const fs::path& file, Control& control) {
    if (is_scene_file(file))
        return {std::make_unique<LiveScene>(load_scene(file), file, control), Eigen::Vector3d::UnitZ(),
                fs::absolute(file)};
    auto scene = std::make_unique<LiveScene>(document_for_mesh(file), file.parent_path() / "scene.json", control);
    const Eigen::Vector3d up = up_axis_of(scene->mesh());
    hold_lowest(*scene, up);
    std::string note = begin_with_what_is_soon(*scene);
    return {std::move(scene), up, {}, std::move(note)};
}

LoadedScene load_autosaved(const fs::path& file, const fs::path& origin, Control& control) {
    LoadedScene loaded;
    loaded.scene = std::make_unique<LiveScene>(load_scene(file), origin.empty() ? "recovered.json" : origin, control);
    loaded.file = origin;
    loaded.recovered = true;
    return loaded;
}

Document movable_document(const LiveScene& scene, MethodKind method, const ViewPoint& camera, const Shown& shown) {
    Document document = scene.document();
    document.method = method;
    document.camera = camera;
    document.shown = shown;
    if (auto* mesh = std::get_if<MeshFile>(&document.mesh))
        mesh->file = fs::absolute(scene.file().parent_path() / mesh->file).lexically_normal().string();
    return document;
}

void write_scene(const fs::path& file, Document document) {
    if (auto* mesh = std::get_if<MeshFile>(&document.mesh)) {
        const fs::path relative =
            fs::path(mesh->file).lexically_relative(fs::absolute(file).lexically_normal().parent_path());
        if (!relative.empty()) mesh->file = relative.string();
    }
    save_scene(file, document);
}

Document default_document() {
    Document document;
    document.method = first_method();
    document.mesh = Primitive{.name = "cube", .resolution = 13, .size = {}};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-6}}}};
    return document;
}

Document document_for_mesh(const fs::path& mesh) {
    Document document;
    document.method = first_method();
    document.mesh = MeshFile{fs::absolute(mesh).string()};
    return document;
}

}  // namespace elastolab
