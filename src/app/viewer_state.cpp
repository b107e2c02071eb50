#include "app/viewer_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/recent_files.hpp"
#include "app/input/usual_base.hpp"
#include "mesh/input/export.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/user_text.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr double kPatchPart = 0.07;   ///< default radius of a patch: of the body's diagonal,
constexpr double kPatchEdges = 1.6;   ///< but so many edges, so that it has whole triangles
constexpr double kLowestPart = 0.06;  ///< of a bare mesh that is held, of its height

double diagonal(const MeshReport& report) { return (report.max_corner - report.min_corner).norm(); }

/// Holds the lowest part of a body that nothing holds yet.
void hold_lowest(LiveScene& scene, const Eigen::Vector3d& up) {
    const Eigen::RowVectorXd heights = up.transpose() * scene.mesh().vertices;
    const double limit = heights.minCoeff() + kLowestPart * (heights.maxCoeff() - heights.minCoeff());
    std::vector<int> lowest;
    for (Eigen::Index v = 0; v < heights.size(); ++v)
        if (heights[v] <= limit) lowest.push_back(static_cast<int>(v));
    scene.fix(lowest);
    scene.commit();
}

/// Our scenes have Z up; bare meshes mostly Y, as most modelling programs have it.
std::shared_ptr<LoadedScene> load(const fs::path& file) {
    if (is_scene_file(file))
        return std::make_shared<LoadedScene>(
            LoadedScene{std::make_unique<LiveScene>(load_scene(file), file), Eigen::Vector3d::UnitZ()});
    auto scene = std::make_unique<LiveScene>(document_for_mesh(file), file.parent_path() / "scene.json");
    const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
    hold_lowest(*scene, up);
    return std::make_shared<LoadedScene>(LoadedScene{std::move(scene), up});
}

/// As in the timings file: a frame shows what belongs to the scene, or that is being computed, or nothing is done.
std::string recorded_name(MethodRunner::State state) {
    switch (state) {
        case MethodRunner::State::ready:
            return "ready";
        case MethodRunner::State::precomputing:
        case MethodRunner::State::preparing:
            return "precomputing";
        case MethodRunner::State::idle:
        case MethodRunner::State::failed:
            return "idle";
    }
    return "idle";
}

}  // namespace

Document default_document() {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = 13, .size = {}};
    document.fixed = Selector{PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-6}};
    return document;
}

Document document_for_mesh(const fs::path& mesh) {
    Document document;
    document.mesh = MeshFile{fs::absolute(mesh).string()};
    return document;
}

ViewerState::ViewerState(const std::function<void()>& wake)
    : simulation(wake), recent_(load_recent_files()), volume_(wake), load_job_(wake) {
    take_scene({std::make_unique<LiveScene>(default_document(), fs::path("cube.json"))});
}

template <class Action>
void ViewerState::attempt(const Action& action) {
    try {
        action();
    } catch (const std::exception& error) {
        messages.error(user_text(error));
    }
}

const ShownBody* ViewerState::body(MethodKind kind) const {
    const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const ShownBody& b) { return b.kind() == kind; });
    return found == bodies.end() ? nullptr : &*found;
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

const MethodRunner* ViewerState::reference() const {
    const std::vector<MethodKind> kinds = needed_kinds();
    const bool is_there = std::find(kinds.begin(), kinds.end(), compare.reference) != kinds.end();
    return is_there && (comparing() || display.field == Field::difference) ? &simulation.runner(compare.reference)
                                                                           : nullptr;
}

std::pair<double, double> ViewerState::field_range() const {
    if (!display.auto_range) return {display.range_low, display.range_high};
    double high = 0.0;
    for (const ShownBody& shown : bodies) high = std::max(high, shown.max_value());
    return {0.0, high > 0.0 ? high : 1.0};
}

void ViewerState::open(const fs::path& file) {
    finish_gesture();
    load_job_.start([file](Control&) { return load(file); });
    pending_file_ = file;
}

void ViewerState::open_now(const fs::path& file) {
    take_scene(std::move(*load(file)));
    add_recent(file);
}

void ViewerState::start_with(MethodKind kind) {
    method = kind;
    if (loading()) first_method_ = kind;
}

void ViewerState::open_document(Document document, const fs::path& scene_file) {
    finish_gesture();
    attempt([&] { take_scene({std::make_unique<LiveScene>(std::move(document), scene_file)}); });
}

void ViewerState::open_primitive(const Primitive& primitive) {
    Document document;
    document.mesh = primitive;
    document.material = scene_->document().material;
    document.method = method;
    finish_gesture();
    attempt([&] {
        document.fixed = usual_base(primitive);
        take_scene({std::make_unique<LiveScene>(std::move(document), primitive.name + ".json")});
    });
}

void ViewerState::take_scene(LoadedScene loaded) {
    gestures.reset();
    scene_ = std::move(loaded.scene);
    graph_ = std::make_unique<VertexGraph>(scene_->mesh());
    ++scene_number_;
    method = std::exchange(first_method_, std::nullopt).value_or(scene_->document().method);
    tools.patch_radius = std::max(kPatchPart * diagonal(scene_->report()), kPatchEdges * scene_->report().mean_edge);
    bodies.clear();
    volume_.forget();
    camera.set_scene(frame_of(scene_->mesh().vertices));
    camera.set_up_axis(loaded.up_axis);
    camera.set_view(ViewDirection::isometric);
    frame_body();
    for (const Defect& defect : scene_->report().defects) messages.note(scene_->name() + ": " + defect.text);
}

void ViewerState::frame_body() {
    std::vector<const Positions*> all = {&scene_->mesh().vertices};
    for (const ShownBody& shown : bodies) all.push_back(&shown.positions());
    Positions points(3, 0);
    for (const Positions* positions : all) {
        points.conservativeResize(Eigen::NoChange, points.cols() + positions->cols());
        points.rightCols(positions->cols()) = *positions;
    }
    camera.fit(points, viewports.empty() ? 1.3 : viewports.front().place.aspect());
}

void ViewerState::save_scene(const fs::path& file) {
    finish_gesture();
    attempt([&] {
        write_scene(file);
        scene_->mark_saved();
        add_recent(file);
        messages.note("Saved " + file.string());
    });
}

void ViewerState::write_scene(const fs::path& file) const {
    Document document = scene_->document();
    document.method = method;
    if (auto* mesh = std::get_if<MeshFile>(&document.mesh)) {
        const fs::path absolute = fs::absolute(scene_->file().parent_path() / mesh->file).lexically_normal();
        const fs::path relative = absolute.lexically_relative(fs::absolute(file).parent_path());
        mesh->file = relative.empty() ? absolute.string() : relative.string();
    }
    elastolab::save_scene(file, document);
}

void ViewerState::export_mesh(const fs::path& file) {
    attempt([&] {
        write_mesh(file);
        messages.note("Exported " + file.string());
    });
}

void ViewerState::write_mesh(const fs::path& file) const {
    SurfaceMesh mesh = scene_->mesh();
    const Eigen::VectorXd& u = simulation.runner(method).displacement();
    if (u.size() == mesh.vertices.size())
        mesh.vertices += Eigen::Map<const Eigen::Matrix3Xd>(u.data(), 3, u.size() / 3);
    save_surface(file, mesh);
}

void ViewerState::cancel_workers() {
    load_job_.cancel();
    volume_.cancel();
    simulation.cancel();
}

void ViewerState::record_timings(const fs::path& file) {
    attempt([&] {
        stop_timings();
        timings = std::make_unique<TimingsRecorder>(file);
    });
}

void ViewerState::stop_timings() {
    attempt([&] {
        const std::unique_ptr<TimingsRecorder> ended = std::move(timings);
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
                           .deformation_scale = display.deformation_scale,
                           .targets = {}};
    for (const SceneViewport& viewport : viewports) {
        const ShownBody* shown = body(viewport.kinds.front());
        if (shown == nullptr) continue;
        if (const auto& section = shown->section())
            context.targets.push_back({viewport.place, &section->positions, &section->triangles});
        else
            context.targets.push_back({viewport.place, &shown->positions(), &scene_->mesh().triangles});
    }
    return context;
}

void ViewerState::finish_gesture() {
    GestureContext context = gesture_context();
    gestures.finish(context);
}

void ViewerState::undo() {
    finish_gesture();
    if (scene_->can_undo()) scene_->undo();
    gestures.select_handle(-1);
}

void ViewerState::redo() {
    finish_gesture();
    if (scene_->can_redo()) scene_->redo();
    gestures.select_handle(-1);
}

void ViewerState::remove_handle(int handle) {
    if (handle < 0 || handle >= scene_->n_handles()) return;
    const int vertex = scene_->vertices(handle).front();
    finish_gesture();  // which may remove another one: numbers change, vertices do not
    if (scene_->owner(vertex) < 0) return;
    scene_->remove_handle(scene_->owner(vertex));
    scene_->commit();
    gestures.select_handle(-1);
}

void ViewerState::clear_handles() {
    finish_gesture();
    scene_->clear_handles();
    scene_->commit();
    gestures.select_handle(-1);
}

FrameRecord ViewerState::frame_record(const FrameTimes& times, double now) const {
    const ConstrainedSet& set = scene_->constraints().set;
    const auto n_handle = static_cast<int>(set.handles.size());
    return {.frame = frame,
            .time_s = now,
            .method = std::string(name(method)),
            .vertices = scene_->mesh().n_vertices(),
            .constrained_vertices = static_cast<int>(set.base.size()) + n_handle,
            .handle_vertices = n_handle,
            .state = recorded_name(simulation.runner(method).state()),
            .times = times};
}

void ViewerState::set_young_modulus(double value) {
    if (!(value > 0.0 && std::isfinite(value))) {
        messages.error("Young's modulus must be positive. Enter a force per area above 0.");
        return;
    }
    Material material = scene_->document().material;
    material.young_modulus = value;
    scene_->set_material(material);
    scene_->commit();
}

void ViewerState::select_method(MethodKind kind) { method = kind; }

void ViewerState::add_recent(const fs::path& file) {
    recent_ = with_recent_file(recent_, fs::absolute(file));
    save_recent_files(recent_);
}

void ViewerState::poll_loading() {
    switch (load_job_.poll()) {
        case JobEvent::finished:
            take_scene(std::move(*load_job_.take()));
            add_recent(pending_file_);
            break;
        case JobEvent::failed:
            messages.error(load_job_.failure());
            first_method_.reset();
            break;
        case JobEvent::cancelled:
            first_method_.reset();
            break;
        case JobEvent::none:
            break;
    }
}

bool ViewerState::update_displacements() {
    poll_loading();
    const bool has_new_volume = volume_.poll();
    if (has_new_volume && !volume_.failure().empty()) messages.error(volume_.failure());
    if (loading() && !simulated_) return false;  // the default scene would be computed for nothing
    simulated_ = true;
    const bool changed = simulation.update(*scene_, needed_kinds(), choices) || has_new_volume;
    const std::vector<int>& patch = gestures.hover().patch;
    if (gestures.action() == Gestures::Action::none && !patch.empty() && patch != prefetched_)
        simulation.prefetch(scene_->set_with_handle(patch));
    prefetched_ = patch;
    return changed;
}

/// The inside of a method's body, when it is to be cut open.
const Volume* ViewerState::volume(MethodKind kind) {
    const MethodRunner& runner = simulation.runner(kind);
    return display.section && runner.surface() == &scene_->mesh() ? volume_.of(runner) : nullptr;
}

bool ViewerState::update_bodies() {
    if (!display.section) volume_.forget();
    const std::vector<MethodKind> kinds = shown_kinds();
    std::erase_if(bodies,
                  [&](const ShownBody& b) { return std::find(kinds.begin(), kinds.end(), b.kind()) == kinds.end(); });
    bool changed = false;
    for (const MethodKind kind : kinds) {
        if (body(kind) == nullptr) bodies.emplace_back(kind);
        ShownBody& shown =
            *std::find_if(bodies.begin(), bodies.end(), [&](const ShownBody& b) { return b.kind() == kind; });
        changed = shown.update(*scene_, simulation.runner(kind), reference(), volume(kind), display) || changed;
    }
    return changed;
}

}  // namespace elastolab
