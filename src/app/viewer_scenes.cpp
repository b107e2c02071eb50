// How a ViewerState comes to its scenes, and where it leaves them.
#include <algorithm>
#include <utility>

#include "app/input/default_support.hpp"
#include "app/picture/view_point.hpp"
#include "app/viewer_state.hpp"
#include "app/window/recent_files.hpp"
#include "render/drawing/legend.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr double kPatchPart = 0.07;     ///< default radius of a patch: of the body's diagonal,
constexpr double kPatchEdges = 1.6;     ///< but at least so many edges, so that it has whole triangles
constexpr double kPressurePart = 0.01;  ///< default of a pressure: of Young's modulus
constexpr double kSpringPart = 1.0;     ///< default of a spring: of Young's modulus times the radius of a patch
constexpr int kDenseVertices = 2000;    ///< above, a wireframe hides more than it shows

double diagonal(const MeshReport& report) { return (report.max_corner - report.min_corner).norm(); }

}  // namespace

void ViewerState::open(const fs::path& file) {
    finish_gesture();
    unsaved.guard(scene_->modified(), [this, file] { begin_loading(file); });
}

void ViewerState::recover() {
    if (recoverable.empty()) return;
    recovering_ = std::move(recoverable.front());
    recoverable.erase(recoverable.begin());
    load_job_.start([file = recovering_->file, origin = recovering_->origin](Control& control) {
        return std::make_shared<LoadedScene>(load_autosaved(file, origin, control));
    });
    pending_file_ = recovering_->origin;
    revision_at_open_ = scene_->revision();
}

void ViewerState::discard_recoverable() {
    if (recoverable.empty()) return;
    recoverable.front().remove();
    recoverable.erase(recoverable.begin());
}

void ViewerState::begin_loading(const fs::path& file) {
    recovering_.reset();  // another one is wanted now; it is offered again at the next start
    load_job_.start(
        [file](Control& control) { return std::make_shared<LoadedScene>(load_scene_or_mesh(file, control)); });
    pending_file_ = file;
    revision_at_open_ = scene_->revision();
}

void ViewerState::open_now(const fs::path& file, Control& control) {
    take_scene(load_scene_or_mesh(file, control));
    add_recent(file);
}

void ViewerState::start_with(MethodKind kind) {
    method = kind;
    if (loading()) first_method_ = kind;
    scene_->start_with(method, choices.settings());
}

void ViewerState::open_document(Document document, const fs::path& scene_file) {
    finish_gesture();
    attempt([&] { take_scene({.scene = std::make_unique<LiveScene>(std::move(document), scene_file), .file = {}}); });
}

void ViewerState::open_primitive(const Primitive& primitive) {
    finish_gesture();
    unsaved.guard(scene_->modified(), [this, primitive] { make_primitive_scene(primitive); });
}

void ViewerState::make_primitive_scene(const Primitive& primitive) {
    Document document;
    document.mesh = primitive;
    document.material = scene_->document().material;
    document.method = method;
    if (attempt([&] { document.fixed = {{.select = default_support(primitive)}}; }))
        open_document(std::move(document), primitive.name + ".json");
}

void ViewerState::quit() {
    finish_gesture();
    unsaved.guard(scene_->modified(), [this] { requests.quit = true; });
}

/// A save that fails leaves the question: there is still time to choose otherwise.
void ViewerState::answer_unsaved(UnsavedAnswer answer) {
    if (answer == UnsavedAnswer::cancel) return unsaved.cancel();
    if (answer == UnsavedAnswer::save) {
        requests.scene_name = scene_file_.empty();
        if (requests.scene_name || !save_scene(fs::path(scene_file_))) return;
    }
    unsaved.proceed();
}

void ViewerState::take_scene(LoadedScene loaded) {
    gestures.reset();
    scene_ = std::move(loaded.scene);
    scene_file_ = std::move(loaded.file);
    owns_scene_file_ = false;
    graph_ = std::make_unique<VertexGraph>(scene_->mesh());
    ++scene_number_;
    if (!first_method_ && !loaded.note.empty()) messages.note(loaded.note);
    method = std::exchange(first_method_, std::nullopt).value_or(scene_->document().method);
    scene_->start_with(method, choices.settings());
    tools.patch_radius = std::max(kPatchPart * diagonal(scene_->report()), kPatchEdges * scene_->report().mean_edge);
    tools.pressure = round_step(kPressurePart * scene_->document().material.young_modulus);
    tools.spring = round_step(kSpringPart * scene_->document().material.young_modulus * tools.patch_radius);
    shown.forget();
    probes.clear();
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
    for (const Defect& defect : scene_->report().defects) messages.note(scene_->name() + ": " + defect.text);
}

void ViewerState::take_loaded(LoadedScene loaded, const fs::path& file) {
    if (loaded.recovered) recovered_ = std::exchange(recovering_, std::nullopt);
    take_scene(std::move(loaded));
    add_recent(file);
}

bool ViewerState::save_scene(const fs::path& file) {
    finish_gesture();
    return attempt([&] {
        write_scene(file, *scene_, method, view_point_of(camera));
        scene_->mark_saved();
        scene_file_ = fs::absolute(file);
        owns_scene_file_ = true;
        add_recent(file);
        messages.note("Saved " + file.string());
    });
}

void ViewerState::save_probes(const fs::path& file) {
    attempt([&] {
        probes.write_csv(file);
        messages.note(std::to_string(probes.n_samples()) + " samples of the probes in " + file.string());
    });
}

void ViewerState::add_recent(const fs::path& file) {
    if (file.empty()) return;  // a primitive
    recent_ = with_recent_file(recent_, fs::absolute(file));
    save_recent_files(recent_);
}

void ViewerState::poll_loading() {
    switch (load_job_.poll()) {
        case JobEvent::finished:
            // What was changed while it was being loaded counts, too.
            unsaved.guard(
                scene_->modified() && scene_->revision() != revision_at_open_,
                [this, loaded = load_job_.take(), file = pending_file_] { take_loaded(std::move(*loaded), file); });
            break;
        case JobEvent::failed:
            messages.error(load_job_.failure());
            first_method_.reset();
            recovering_.reset();
            break;
        case JobEvent::cancelled:
            first_method_.reset();
            break;
        case JobEvent::none:
            break;
    }
}

}  // namespace elastolab
