// What a ViewerState begins with in a new scene, and how a new body comes about.
#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "app/input/default_support.hpp"
#include "app/job_notes.hpp"
#include "app/picture/load_arrows.hpp"
#include "app/picture/view_point.hpp"
#include "app/viewer_state.hpp"
#include "base/error.hpp"
#include "render/drawing/legend.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr double kPatchPart = 0.07;     ///< default radius of a patch: of the body's diagonal,
constexpr double kPatchEdges = 1.6;     ///< but at least so many edges, so that it has whole triangles
constexpr double kPressurePart = 0.01;  ///< default of a pressure: of Young's modulus
/// Default of a spring: of Young's modulus times the radius of a patch, or of the bending of a whole body.
constexpr double kSpringPart = 1.0;
constexpr int kDenseVertices = 2000;  ///< above, a wireframe hides more than it shows

double diagonal(const MeshReport& report) { return (report.max_corner - report.min_corner).norm(); }

/// The largest distance of a vertex from the middle of the fixed part; infinite where nothing is fixed.
double farthest_from_support(const LiveScene& scene) {
    const std::span<const int> fixed = scene.vertices(LiveScene::kFixed);
    if (fixed.empty()) return std::numeric_limits<double>::infinity();
    const Positions& all = scene.mesh().vertices;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int v : fixed) middle += all.col(v) / static_cast<double>(fixed.size());
    return (all.colwise() - middle).colwise().norm().maxCoeff();
}

/// What a person is told of a surface's defects as it is loaded. Where a closed surface stands for it, nothing has to
/// be done about them; the panel lists them.
void note_defects(const LiveScene& scene, MethodKind method, Messages& messages) {
    const std::vector<Defect>& defects = scene.report().defects;
    const std::string name = fs::path(scene.name()).filename().string() + ": ";
    const auto is_fatal = [](const Defect& defect) { return defect.fatal && !defect.repaired; };
    const auto fatal = std::ranges::find_if(defects, is_fatal);
    if (!scene.needs_proxy(method) || fatal == defects.end()) {
        for (const Defect& defect : defects) messages.note(name + defect.text);
        return;
    }
    const bool has_more = std::ranges::count_if(defects, is_fatal) > 1;
    messages.note(name + fatal->found + (has_more ? " and other defects" : "") +
                  ". A closed surface is simulated in its place.");
}

void show_asked(const AskedFor& asked, DisplaySettings& display) {
    if (asked.field) display.field = *asked.field;
    if (!asked.cut_axis) return;
    display.section = true;
    display.cut = {.axis = *asked.cut_axis};
}

}  // namespace

void ViewerState::start_with(const AskedFor& asked) {
    files.begin_with(asked);
    show_asked(asked, display);
    if (!asked.method) return;
    method = *asked.method;
    scene_->start_with(method, choices.settings());
}

void ViewerState::open_primitive(const Primitive& primitive) {
    files.guard([this, primitive] { make_primitive_scene(primitive); });
}

void ViewerState::make_primitive_scene(const Primitive& primitive) {
    Document document;
    document.mesh = primitive;
    document.material = scene_->document().material;
    document.method = method;
    if (attempt(messages, [&] { document.fixed = {{.select = default_support(primitive)}}; }))
        files.open_document(std::move(document), primitive.name + ".json");
}

void ViewerState::quit() {
    files.guard([this] { requests.quit = true; });
}

/// As it is seen without a legend, which is no part of a scene: beside one the eye is farther away.
Document ViewerState::document_to_save() const {
    if (posed_for_film)
        throw Error("The scene is not saved: a film is being made, which moves the handles. Save when it is done.");
    Camera seen = camera;
    if (!shown.viewports.empty()) {
        const Viewport& place = shown.viewports.front().place;
        CameraPose pose = seen.pose();
        pose.distance *= std::min(1.0, place.free_aspect()) / std::min(1.0, place.aspect());
        seen.set_pose(pose);
    }
    return movable_document(*scene_, method, view_point_of(seen), shown_by(display));
}

void ViewerState::take_scene(LoadedScene loaded) {
    gestures.reset();
    scene_ = std::move(loaded.scene);
    graph_ = std::make_unique<VertexGraph>(scene_->mesh());
    ++scene_number_;
    if (!loaded.asked.method && !loaded.note.empty()) messages.note(loaded.note);
    method = loaded.asked.method.value_or(scene_->document().method);
    scene_->start_with(method, choices.settings());
    tools.patch_radius = std::max(kPatchPart * diagonal(scene_->report()), kPatchEdges * scene_->report().mean_edge);
    tools.pressure = round_step(kPressurePart * scene_->document().material.young_modulus);
    tools.spring = round_step(kSpringPart * std::min(scene_->document().material.young_modulus * tools.patch_radius,
                                                     bending_stiffness(*scene_, farthest_from_support(*scene_))));
    shown.forget();
    probes.clear();
    moved_by_force_.clear();
    from_rest_.reset();
    if (const auto& of_scene = scene_->document().shown) show(*of_scene, display);
    show_asked(loaded.asked, display);
    display.wireframe = scene_->mesh().n_vertices() <= kDenseVertices;
    camera.set_scene(frame_of(scene_->mesh().vertices));
    const std::optional<ViewPoint>& saved = scene_->document().camera;
    has_saved_view_ = saved && can_see(*saved, camera.scene());
    if (loaded.recovered) scene_->mark_unsaved();
    if (has_saved_view_) {
        look_from(*saved, camera);
    } else {
        camera.set_up_axis(loaded.up_axis);
        camera.set_view(ViewDirection::isometric);
        frame_body();
    }
    note_defects(*scene_, method, messages);
}

void ViewerState::record_probes(double now) {
    const ShownBody* body = shown.body(method);
    const EmbeddedRunner& answer = simulation.answer(method);
    const MethodRunner& runner = answer.runner();
    if (body == nullptr || !runner.answers() || !answer.shows(scene_->mesh())) return;
    const std::string state = simulation.previewing(method) ? "preview"
                              : runner.following()          ? "following"
                              : runner.converged()          ? "exact"
                                                            : "converging";
    probes.record(now, scene_->mesh().vertices, *body, display, compare.reference,
                  {std::string(name(runner.method().kind)), state});
}

void ViewerState::save_probes(const fs::path& file) {
    attempt(messages, [&] {
        probes.write_csv(file);
        messages.note(std::to_string(probes.n_samples()) + " samples of the probes in " + file.string());
    });
}

}  // namespace elastolab
