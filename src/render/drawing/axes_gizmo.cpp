#include "render/drawing/axes_gizmo.hpp"

#include <epoxy/gl.h>

#include <cmath>

namespace elastolab {

namespace {

constexpr double kLabelPlace = 1.22;  // along an axis of length 1
constexpr float kShaft = 0.045f;      // of the width of the gizmo
constexpr double kSize = 72.0, kGap = 8.0;
constexpr double kReach = 13.0;  // of a letter, for the cursor [pixels]

Camera gizmo_camera(const Camera& camera) {
    Camera own = camera;
    const SceneFrame ball{Eigen::Vector3d::Zero(), 1.35};
    own.set_scene(ball);
    own.frame(ball, 1.0);
    return own;
}

}  // namespace

AxesGizmo::AxesGizmo(const std::array<Colour, 3>& colours) {
    std::array<Arrow, 3> arrows;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        arrows[k] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(i), colours[k]};
    }
    arrows_.update(arrows, SceneFrame{});
}

void AxesGizmo::draw(const Camera& camera, const Viewport& viewport, const Viewport& place, double pixel_ratio) {
    const auto pixels = [pixel_ratio](double x) { return static_cast<int>(std::lround(x * pixel_ratio)); };
    const int x = pixels(place.x - viewport.x), width = pixels(place.width), height = pixels(place.height);
    const int y = pixels(viewport.y + viewport.height - place.y - place.height);
    GLint whole[4];
    glGetIntegerv(GL_VIEWPORT, whole);
    apply({});
    glEnable(GL_SCISSOR_TEST);
    glScissor(x, y, width, height);
    glClear(GL_DEPTH_BUFFER_BIT);
    glViewport(x, y, width, height);
    arrows_.draw(SceneView(gizmo_camera(camera), place, pixel_ratio),
                 {.width = kShaft * static_cast<float>(place.width)});
    glViewport(whole[0], whole[1], whole[2], whole[3]);
}

Viewport AxesGizmo::place_in(const Viewport& viewport) {
    return {viewport.x + kGap, viewport.y + viewport.height - kSize - kGap, kSize, kSize};
}

std::optional<int> AxesGizmo::axis_at(const Camera& camera, const Viewport& place, const Eigen::Vector2d& cursor) {
    const Labels all = labels(camera, place);
    std::optional<int> nearest;
    double depth = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        if ((all.pixel[k] - cursor).norm() > kReach || (nearest && all.depth[k] > depth)) continue;
        nearest = axis;
        depth = all.depth[k];
    }
    return nearest;
}

AxesGizmo::Labels AxesGizmo::labels(const Camera& camera, const Viewport& place) {
    const Camera own = gizmo_camera(camera);
    Labels labels;
    for (int i = 0; i < 3; ++i) {
        const ProjectedPoint seen = own.project(kLabelPlace * Eigen::Vector3d::Unit(i), place);
        labels.pixel[static_cast<std::size_t>(i)] = seen.pixel;
        labels.depth[static_cast<std::size_t>(i)] = seen.depth;
    }
    return labels;
}

}  // namespace elastolab
