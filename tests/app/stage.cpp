#include "app/stage.hpp"

#include <algorithm>

#include "support/wait_until.hpp"

namespace elastolab::test {

namespace {

constexpr Viewport kScene{320, 23, 960, 750};
constexpr double kEventSeconds = 0.01;

}  // namespace

Document cube_document(int cells) {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = cells, .size = {}};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    return document;
}

Document cube_document_with_handle(int cells) {
    Document document = cube_document(cells);
    document.handles.push_back(
        {.name = "end", .select = {PlaneSelector{{1, 0, 0}, {1, 0, 0}, 1e-9}}, .motion = AffineMotion{}});
    return document;
}

std::string test_name(MethodKind kind) {
    std::string text(name(kind));
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
}

int n_errors(const ViewerState& state) {
    const auto& all = state.messages.all();
    return static_cast<int>(std::count_if(all.begin(), all.end(), [](const auto& m) { return m.is_error; }));
}

Stage::Stage(int cells) {
    state.choices.complete_up_to = 0;
    open(cube_document(cells));
}

void Stage::open(const Document& document) {
    state.files.open_document(document, "scene.json");
    state.tools.patch_radius = 0.0;
    frame();
    state.frame_body();
    settle();
}

void Stage::frame() {
    state.shown.viewports = viewports_of(state, kScene);
    state.update_displacements();
    state.update_picture();
}

void Stage::settle() {
    test::wait_for([&] {
        frame();
        return !state.waiting() && !state.simulation.busy();
    });
    frame();
}

Eigen::Vector2d Stage::pixel(const Eigen::Vector3d& point, std::size_t viewport) const {
    return state.camera.project(point, state.shown.viewports[viewport].place).pixel;
}

Eigen::Vector3d Stage::place(int vertex, std::size_t viewport) const {
    return state.shown.body(state.shown.viewports[viewport].kinds.front())->positions().col(vertex);
}

Eigen::Vector2d Stage::pixel(int vertex, std::size_t viewport) const {
    return pixel(place(vertex, viewport), viewport);
}

Eigen::Vector2d Stage::empty_place() const { return {kScene.x + 20.0, kScene.y + 20.0}; }

void Stage::send(InputEvent event) {
    seconds += kEventSeconds;
    event.modifiers = modifiers;
    event.seconds = seconds;
    GestureContext context = state.gesture_context();
    state.gestures.handle(event, context);
}

void Stage::move(const Eigen::Vector2d& cursor) {
    cursor_ = cursor;
    send({.kind = InputEvent::Kind::cursor, .cursor = cursor});
}

void Stage::press(int button) {
    send({.kind = InputEvent::Kind::button, .cursor = cursor_, .code = button, .pressed = true});
}

void Stage::release(int button) { send({.kind = InputEvent::Kind::button, .cursor = cursor_, .code = button}); }

void Stage::key(int code, bool pressed) {
    send({.kind = InputEvent::Kind::key, .cursor = cursor_, .code = code, .pressed = pressed});
}

void Stage::scroll(double steps) { send({.kind = InputEvent::Kind::scroll, .cursor = {0.0, steps}}); }

void Stage::drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int button) {
    wait(1.0);  // so that no two drags are a double click
    move(from);
    press(button);
    for (const double t : {0.3, 0.7, 1.0}) move(from + t * (to - from));
    release(button);
}

void Stage::click(const Eigen::Vector2d& at) { drag(at, at); }

int Stage::vertex_near(const Eigen::Vector3d& point) const {
    int nearest = 0;
    (state.scene().mesh().vertices.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
    return nearest;
}

AffineMotion Stage::motion(int handle) const {
    return std::get<AffineMotion>(state.scene().document().handles[static_cast<std::size_t>(handle)].motion);
}

}  // namespace elastolab::test
