#include "app/viewer_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/job_notes.hpp"
#include "app/names.hpp"
#include "findings/cost.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

/// As in the timings file: a frame shows the scene's answer, or that is being computed, or nothing is being done.
std::string recorded_name(MethodRunner::State state, bool following) {
    switch (state) {
        case MethodRunner::State::ready:
            return "ready";
        case MethodRunner::State::precomputing:
        case MethodRunner::State::preparing:
            return following ? "ready" : "precomputing";
        case MethodRunner::State::idle:
        case MethodRunner::State::failed:
            return "idle";
    }
    return "idle";
}

/// What a comparison may wait for a method that nobody chose.
constexpr double kComparisonSeconds = 15.0;

/// The handles' vertices where they are shown once a method has answered.
Positions handles_put(const LiveScene& scene, double scale) {
    const Constraints& constraints = scene.constraints();
    Positions places = scene.mesh().vertices(Eigen::all, constraints.set.handles);
    places.reshaped() += scale * constraints.values.head(places.size());
    return places;
}

}  // namespace

ViewerState::ViewerState(const std::function<void()>& wake)
    : simulation(wake),
      shown(wake),
      files({.scene = [this]() -> LiveScene& { return *scene_; },
             .document = [this] { return document_to_save(); },
             .finish_gesture = [this] { finish_gesture(); },
             .replace = [this](LoadedScene loaded) { take_scene(std::move(loaded)); }},
            messages, wake),
      exports_(wake) {
    take_scene({.scene = std::make_unique<LiveScene>(default_document(), fs::path("cube.json")), .file = {}});
}

/// Those of the paper and the reference, but for what nobody would wait for.
void ViewerState::toggle_comparison(CompareMode mode) {
    finish_gesture();
    compare.mode = compare.mode == mode ? CompareMode::off : mode;
    if (!comparing() || compare.chosen) return;
    compare.kinds.clear();
    for (const MethodKind kind : compared_methods()) {
        const SurfaceMesh* surface = simulation.simulated_surface(kind, *scene_);
        const bool is_ready = simulation.runner(kind).model() != nullptr;
        if (is_ready || surface == nullptr || predict_cost(*surface, choices.of(kind)).seconds() <= kComparisonSeconds)
            compare.kinds.push_back(kind);
    }
}

std::vector<MethodKind> ViewerState::shown_kinds() const {
    std::vector<MethodKind> kinds = {method};
    if (comparing())
        for (const MethodKind kind : compare.kinds)
            if (kind != method) kinds.push_back(kind);
    return kinds;
}

std::vector<MethodKind> ViewerState::needed_kinds() const {
    std::vector<MethodKind> kinds = shown_kinds();
    const bool needs_reference = comparing() || display.field == Field::difference;
    if (needs_reference && method != compare.reference) {  // right after the active one: all differences wait for it
        std::erase(kinds, compare.reference);
        kinds.insert(kinds.begin() + 1, compare.reference);
    }
    return kinds;
}

const EmbeddedRunner* ViewerState::reference() const {
    const std::vector<MethodKind> kinds = needed_kinds();
    const bool is_there = std::find(kinds.begin(), kinds.end(), compare.reference) != kinds.end();
    return is_there && (comparing() || display.field == Field::difference) ? &simulation.embedded(compare.reference)
                                                                           : nullptr;
}

void ViewerState::frame_body() {
    const Positions handles = handles_put(*scene_, display.deformation_scale);  // known before any method answers
    std::vector<const Positions*> all = {&scene_->mesh().vertices, &handles};
    for (const ShownBody& body : shown.bodies()) {
        all.push_back(&body.positions());
        if (body.filling() && display.defects) all.push_back(&body.filling()->positions);
    }
    Positions points(3, 0);
    for (const Positions* positions : all) {
        points.conservativeResize(Eigen::NoChange, points.cols() + positions->cols());
        points.rightCols(positions->cols()) = *positions;
    }
    camera.fit(points, shown.viewports.empty() ? 1.3 : shown.viewports.front().place.free_aspect());
}

void ViewerState::frame_in_viewports(bool first_time) {
    if (!first_time || !has_saved_view_) frame_body();
}

void ViewerState::cancel_workers() {
    files.cancel();
    exports_.cancel();
    shown.cancel();
    simulation.cancel();
}

ExportSource ViewerState::export_source_now() const {
    return export_source(*scene_, simulation.answer(method), camera.up_axis());
}

void ViewerState::export_mesh(const fs::path& file) {
    const MethodRunner& runner = simulation.runner(method);
    const bool is_former =
        simulation.is_of_former_model(method) || (runner.state() != MethodRunner::State::ready && !runner.answers());
    exports_.start(
        file, [this] { return export_source_now(); },
        simulation.previewing(method) ? ", the preview: the method is not ready yet"
        : is_former                   ? ", as it is shown: the method is not ready yet"
                                      : "",
        messages);
}

void ViewerState::record_timings(const fs::path& file) {
    attempt(messages, [&] {
        stop_timings();
        measurements.timings = std::make_unique<TimingsRecorder>(file);
    });
}

void ViewerState::stop_timings() {
    attempt(messages, [&] {
        const std::unique_ptr<TimingsRecorder> ended = std::move(measurements.timings);
        if (!ended) return;
        ended->finish();
        messages.note(std::to_string(ended->n_rows()) + " frames in " + ended->file().string());
    });
}

GestureContext ViewerState::gesture_context() {
    GestureContext context{.scene = *scene_,
                           .camera = camera,
                           .graph = *graph_,
                           .tools = tools,
                           .display = display,
                           .targets = {},
                           .gizmos = gizmos(),
                           .load_arrows = {}};
    if (const ShownBody* body = shown.body(method); body != nullptr && display.constraints)
        context.load_arrows = load_arrows_at(*body);
    for (const SceneViewport& viewport : shown.viewports) {
        const ShownBody* body = shown.body(viewport.kinds.front());
        if (body == nullptr) continue;
        if (const auto& section = body->section())
            context.targets.push_back({viewport.place, &section->positions, &section->shape->triangles()});
        else
            context.targets.push_back({viewport.place, &body->positions(), &scene_->mesh().triangles});
    }
    return context;
}

std::vector<Gizmo> ViewerState::gizmos() const {
    std::vector<Gizmo> all;
    const int handle = gestures.selected_handle();
    const ShownBody* body = shown.body(method);
    if (tools.gizmo && tools.tool == Tool::pull && body != nullptr && handle >= 0 && handle < scene_->n_handles() &&
        body->positions().cols() == scene_->mesh().n_vertices())
        all.push_back(handle_gizmo(*scene_, handle, body->positions(), tools.gizmo_axes));
    if (display.section && display.section_gizmo && (tools.tool == Tool::pull || tools.tool == Tool::probe))
        all.push_back(plane_gizmo(scene_->mesh().vertices, display));
    const bool turns_gravity = scene_->document().gravity && gestures.selected_load() == LiveScene::kGravity;
    if (tools.gizmo && turns_gravity && body != nullptr && (tools.tool == Tool::pull || tools.tool == Tool::force))
        all.push_back(gravity_gizmo(body->positions()));
    for (Gizmo& gizmo : all) gizmo.pixels *= display.ui_scale;
    return all;
}

void ViewerState::finish_gesture() {
    GestureContext context = gesture_context();
    gestures.finish(context);
}

FrameRecord ViewerState::frame_record(const FrameTimes& times, double now) const {
    const ConstrainedSet& set = scene_->constraints().set;
    const auto n_handle = static_cast<int>(set.handles.size());
    return {.frame = measurements.frame,
            .time_s = now,
            .method = std::string(name(method)),
            .vertices = scene_->mesh().n_vertices(),
            .constrained_vertices = static_cast<int>(set.fixed.size()) + n_handle,
            .handle_vertices = n_handle,
            .state = recorded_name(simulation.runner(method).state(), simulation.runner(method).following()),
            .times = times};
}

bool ViewerState::update_displacements() {
    files.poll();
    const bool has_exported = exports_.poll(messages);
    keep_method();
    if (blank()) return has_exported;  // the default scene would be computed for nothing
    simulated_ = true;
    const bool changed = simulation.update(*scene_, needed_kinds(), choices) || has_exported;
    place_grips();
    tell_from_rest();
    for (const MethodKind kind : simulation.take_dropped())
        messages.note(title(kind) + " was let go to keep memory free. It is computed again when it is chosen.");
    const std::vector<int>& patch = gestures.hover().patch;
    const bool springs = tools.pull_mode == PullMode::spring;  // whose stiffness belongs to the set
    if (gestures.action() == Gestures::Action::none && !springs && !patch.empty() && patch != prefetched_)
        simulation.prefetch(scene_->constraints_with_handle(patch));
    prefetched_ = patch;
    return changed;
}

/// Handles under a force are where the answer has them, unless that is still one to other handles.
void ViewerState::place_grips() {
    const EmbeddedRunner& answer = simulation.answer(method);
    const std::vector<AffineMotion>& motions = answer.grip_motions();
    const std::vector<std::size_t> gripped = answer.gripped();
    if (gripped.empty() || motions.size() != gripped.size()) return;
    const Constraints &answered = answer.shown_constraints(), &present = scene_->constraints();
    if (answered.set.handles != present.set.handles || answered.gripped() != present.gripped()) return;
    for (std::size_t g = 0; g < gripped.size(); ++g) scene_->set_equilibrium(static_cast<int>(gripped[g]), motions[g]);
}

bool ViewerState::answering() const {
    if (waiting()) return true;
    const std::vector<MethodKind> kinds = needed_kinds();
    return std::any_of(kinds.begin(), kinds.end(), [&](MethodKind kind) {
        return (simulation.previewing(kind) && simulation.problem(kind).empty()) ||
               simulation.runner(kind).converging();
    });
}

/// The force that moves a handle as it is moved now; nothing where it is not known, as by a preview.
std::optional<GripForce> ViewerState::present_force(int handle) const {
    const MethodRunner& runner = simulation.runner(method);
    const bool is_present = runner.answers() && runner.converged() && !runner.following() && !runner.converging();
    if (simulation.previewing(method) || simulation.is_of_former_model(method) || shown.solving() || !is_present)
        return std::nullopt;
    const ShownBody* body = shown.body(method);
    if (body == nullptr) return std::nullopt;
    for (const ShownReaction& reaction : body->reactions())
        if (!reaction.fixed && reaction.name == scene_->handle_name(handle))
            return GripForce{.force = reaction.force, .moment = reaction.moment_about_middle()};
    return std::nullopt;
}

void ViewerState::move_by_force(int handle) {
    moved_by_force_ = scene_->handle_name(handle);  // the next frame knows whether the forces are of this scene
}

void ViewerState::take_wanted_force() {
    if (moved_by_force_.empty()) return;
    int handle = 0;
    while (handle < scene_->n_handles() && scene_->handle_name(handle) != moved_by_force_) ++handle;
    const bool is_there = handle < scene_->n_handles();
    const std::string& failure = shown.reaction_failure(method);
    if (is_there && failure.empty()) {
        const std::optional<GripForce> force = present_force(handle);
        if (!force) return;
        scene_->set_force(handle, force);
        scene_->commit();
    } else if (is_there) {
        messages.error(failure);
    }
    moved_by_force_.clear();
}

bool ViewerState::update_picture() {
    const bool changed = shown.update({.scene = *scene_,
                                       .simulation = simulation,
                                       .kinds = shown_kinds(),
                                       .reference = reference(),
                                       .display = display,
                                       .probed = tools.tool == Tool::probe || !probes.vertices().empty(),
                                       .forces_wanted = !moved_by_force_.empty(),
                                       .pulling = gestures.dragging()});
    take_wanted_force();  // by the forces of this answer
    return changed;
}

}  // namespace elastolab
