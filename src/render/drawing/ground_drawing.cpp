#include "render/drawing/ground_drawing.hpp"

#include <epoxy/gl.h>

#include <cmath>
#include <Eigen/Geometry>

namespace elastolab {

namespace {

/// The direction perpendicular to `normal` that the lines of the grid follow.
Eigen::Vector3d first_axis(const Eigen::Vector3d& normal) {
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), across = x - normal * normal.x();
    return across.norm() > 0.1 ? Eigen::Vector3d(across.normalized()) : Eigen::Vector3d(normal.unitOrthogonal());
}

/// Where the middle of `area` is within its cell of the world's grid, in cells.
Eigen::Vector2f phase(const SceneFrame& area, const Eigen::Vector3d& u, const Eigen::Vector3d& v, double spacing) {
    const auto within = [](double cells) { return static_cast<float>(cells - 5.0 * std::floor(cells / 5.0)); };
    return {within(area.center.dot(u) / spacing), within(area.center.dot(v) / spacing)};
}

}  // namespace

GroundDrawing::GroundDrawing()
    : array_(make_gl_vertex_array()), shader_(shared_shader({"ground.vert", "ground.frag"})) {}

Eigen::Matrix<double, 3, 2> GroundDrawing::axes(const Eigen::Vector3d& normal) {
    Eigen::Matrix<double, 3, 2> axes;
    axes << first_axis(normal), normal.cross(first_axis(normal));
    return axes;
}

void GroundDrawing::draw(const SceneView& view, const SceneFrame& area, const Eigen::Vector3d& normal,
                         const GroundStyle& style) {
    const Eigen::Vector3d u = axes(normal).col(0), v = axes(normal).col(1);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, style.shadow);
    apply({.blend = true, .write_depth = false});
    shader_->use();
    view.set_uniforms(*shader_, area);
    shader_->set("first_axis", Eigen::Vector3f(u.cast<float>()));
    shader_->set("second_axis", Eigen::Vector3f(v.cast<float>()));
    shader_->set("phase", phase(area, u, v, style.spacing));
    shader_->set("cells", static_cast<float>(area.radius / style.spacing));
    shader_->set("line", style.line);
    shader_->set("shadow", 0);
    shader_->set("shadow_part", static_cast<float>(style.shadow_part));
    shader_->set("shadow_opacity", style.shadow == 0 ? 0.0f : static_cast<float>(style.shadow_opacity));
    glBindVertexArray(array_.id());
    glEnable(GL_DEPTH_CLAMP);  // it reaches before the nearest plane of depth, which is laid at the body
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDisable(GL_DEPTH_CLAMP);
    glBindVertexArray(0);
}

}  // namespace elastolab
