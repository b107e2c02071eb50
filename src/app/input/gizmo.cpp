#include "app/input/gizmo.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>

#include "app/picture/section_shape.hpp"
#include "elasticity/rotation.hpp"
#include "render/drawing/legend.hpp"

namespace elastolab {

namespace {

// In lengths of the arrows.
constexpr double kRing = 0.68, kArrowBegin = 0.78, kFree = 0.3;
constexpr double kReach = 7.0;        ///< how near the cursor must be [pixels]
constexpr double kShortArrow = 12.0;  ///< on the screen; a shorter one points at the eye [pixels]
constexpr int kRingSteps = 64;
constexpr double kEdgeOn = 0.15;  ///< cosine between the viewing direction and the axis of a ring

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d ab = b - a;
    const double t = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-30), 0.0, 1.0);
    return (p - a - t * ab).norm();
}

/// Length of an arrow [L]; 0 behind the eye.
double length_of(const Gizmo& gizmo, const Camera& camera, const Viewport& viewport) {
    const double depth = camera.project(gizmo.center, viewport).depth;
    return depth > 0.0 ? gizmo.pixels * camera.pixel_size(depth, viewport) : 0.0;
}

Eigen::Vector3d axis_of(const Gizmo& gizmo, const GizmoPart& part) { return gizmo.axes.col(part.axis); }

/// Normal of a handle's surface as shown: of its triangles, else of those around its vertices.
Eigen::Vector3d surface_normal(const LiveScene& scene, int handle, const Positions& positions) {
    Eigen::Vector3d whole = Eigen::Vector3d::Zero(), around = whole;
    for (const auto& t : scene.mesh().triangles.colwise()) {
        const auto n_own = std::count_if(t.begin(), t.end(), [&](int v) { return scene.owner(v) == handle; });
        if (n_own == 0) continue;
        const Eigen::Vector3d normal =
            (positions.col(t[1]) - positions.col(t[0])).cross(positions.col(t[2]) - positions.col(t[0]));
        around += normal;
        if (n_own == 3) whole += normal;
    }
    const Eigen::Vector3d normal = whole.squaredNorm() > 0.0 ? whole : around;
    return normal.squaredNorm() > 0.0 ? normal.stableNormalized() : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
}

/// Third axis along the normal, the first as near to a world axis as can be.
Eigen::Matrix3d axes_on(const Eigen::Vector3d& normal) {
    const Eigen::Vector3d side = std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    Eigen::Matrix3d axes;
    axes.col(2) = normal;
    axes.col(0) = (side - side.dot(normal) * normal).normalized();
    axes.col(1) = normal.cross(axes.col(0));
    return axes;
}

/// The rotation part of a handle's motion; the identity for motions of single vertices.
Eigen::Matrix3d own_axes(const Motion& motion) {
    const auto* affine = std::get_if<AffineMotion>(&motion);
    if (affine == nullptr) return Eigen::Matrix3d::Identity();
    return nearest_rotation(Eigen::Matrix3d::Identity() + map_of(*affine).matrix);
}

/// Where the ray meets the plane of a ring, from its centre.
Eigen::Vector3d on_plane(const Gizmo& gizmo, const Eigen::Vector3d& axis, const Ray& ray) {
    const double t = axis.dot(gizmo.center - ray.origin) / axis.dot(ray.direction);
    return ray.origin + t * ray.direction - gizmo.center;
}

double turned_about(const Gizmo& gizmo, const Eigen::Vector3d& axis, const Camera& camera, const Viewport& viewport,
                    const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector3d view = (camera.eye() - gizmo.center).stableNormalized();
    if (std::abs(view.dot(axis)) < kEdgeOn) {  // seen from its edge: a roller
        const Eigen::Vector3d rim = axis.cross(view);
        const double length = length_of(gizmo, camera, viewport);
        return dragged_along(camera, viewport, gizmo.center, rim.normalized(), from, to) / (kRing * length);
    }
    const Eigen::Vector3d a = on_plane(gizmo, axis, camera.ray(from, viewport));
    const Eigen::Vector3d b = on_plane(gizmo, axis, camera.ray(to, viewport));
    return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

}  // namespace

Gizmo handle_gizmo(const LiveScene& scene, int handle, const Positions& positions, GizmoAxes axes) {
    const std::span<const int> vertices = scene.vertices(handle);
    Gizmo gizmo{.handle = handle};
    for (const int v : vertices) gizmo.center += positions.col(v) / static_cast<double>(vertices.size());
    if (axes == GizmoAxes::surface) gizmo.axes = axes_on(surface_normal(scene, handle, positions));
    if (axes == GizmoAxes::own)
        gizmo.axes = own_axes(scene.document().handles[static_cast<std::size_t>(handle)].motion);
    for (int axis = 0; axis < 3; ++axis) {
        gizmo.parts.push_back({GizmoPart::Kind::arrow, axis});
        if (vertices.size() > 1) gizmo.parts.push_back({GizmoPart::Kind::ring, axis});  // a point has no turn
    }
    return gizmo;
}

Gizmo gravity_gizmo(const Positions& positions) {
    Gizmo gizmo{.handle = Gizmo::kGravity, .center = positions.rowwise().mean()};
    for (int axis = 0; axis < 3; ++axis) gizmo.parts.push_back({GizmoPart::Kind::ring, axis});
    return gizmo;
}

Gizmo plane_gizmo(const Positions& rest, const DisplaySettings& display) {
    const Plane plane = section_plane(rest, display);
    const Eigen::Vector3d middle = 0.5 * (rest.rowwise().minCoeff() + rest.rowwise().maxCoeff());
    const double sign = display.cut.flip ? -1.0 : 1.0;
    Gizmo gizmo;
    gizmo.center = middle + (plane.offset - plane.normal.dot(middle)) * plane.normal;
    gizmo.axes.col(0) = sign * plane.normal;
    gizmo.axes.rightCols<2>() = section_hinges(display);
    gizmo.parts = {{GizmoPart::Kind::arrow, 0}, {GizmoPart::Kind::ring, 1}, {GizmoPart::Kind::ring, 2}};
    return gizmo;
}

std::vector<Eigen::Vector2d> outline(const Gizmo& gizmo, const GizmoPart& part, const Camera& camera,
                                     const Viewport& viewport) {
    const double length = length_of(gizmo, camera, viewport);
    std::vector<Eigen::Vector2d> line;
    if (length == 0.0) return line;
    const Eigen::Vector3d axis = axis_of(gizmo, part);
    const auto add = [&](const Eigen::Vector3d& offset) {
        const ProjectedPoint projected = camera.project(gizmo.center + length * offset, viewport);
        if (projected.depth > 0.0) line.push_back(projected.pixel);
    };
    if (part.kind == GizmoPart::Kind::arrow) {
        add(kArrowBegin * axis);
        add(axis);
        const Eigen::Vector2d middle = camera.project(gizmo.center, viewport).pixel;
        if (line.size() < 2 || (line.back() - middle).norm() < kShortArrow) line.clear();
        return line;
    }
    const Eigen::Vector3d view = (camera.eye() - gizmo.center).stableNormalized();
    const bool whole = std::abs(view.dot(axis)) > 0.98;
    // The half towards the eye begins and ends where the ring turns away: perpendicular to the view.
    const Eigen::Vector3d begin = whole ? Eigen::Vector3d(axes_on(axis).col(0)) : view.cross(axis).normalized();
    const double angle = (whole ? 2.0 : 1.0) * std::numbers::pi;
    const Eigen::Vector3d side = axis.cross(begin);
    for (int i = 0; i <= kRingSteps; ++i) {
        const double a = angle * i / kRingSteps;
        add(kRing * (std::cos(a) * begin + std::sin(a) * side));
    }
    return line;
}

std::optional<GizmoPart> part_at(const Gizmo& gizmo, const Camera& camera, const Viewport& viewport,
                                 const Eigen::Vector2d& cursor) {
    const ProjectedPoint middle = camera.project(gizmo.center, viewport);
    if (middle.depth <= 0.0 || (cursor - middle.pixel).norm() < kFree * gizmo.pixels) return std::nullopt;
    std::optional<GizmoPart> nearest;
    double least = kReach;
    for (const GizmoPart& part : gizmo.parts) {
        const std::vector<Eigen::Vector2d> line = outline(gizmo, part, camera, viewport);
        for (std::size_t i = 1; i < line.size(); ++i) {
            const double distance = distance_to_segment(cursor, line[i - 1], line[i]);
            if (distance >= least) continue;
            least = distance;
            nearest = part;
        }
    }
    return nearest;
}

double dragged(const Gizmo& gizmo, const GizmoPart& part, const Camera& camera, const Viewport& viewport,
               const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector3d axis = axis_of(gizmo, part);
    if (part.kind == GizmoPart::Kind::arrow) return dragged_along(camera, viewport, gizmo.center, axis, from, to);
    return turned_about(gizmo, axis, camera, viewport, from, to);
}

double dragged_along(const Camera& camera, const Viewport& viewport, const Eigen::Vector3d& point,
                     const Eigen::Vector3d& direction, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    // Where the line comes nearest to the ray of the cursor.
    const auto place = [&](const Eigen::Vector2d& cursor) {
        const Ray ray = camera.ray(cursor, viewport);
        const double cosine = ray.direction.dot(direction);
        const double denominator = 1.0 - cosine * cosine;
        if (denominator < 1e-4) return 0.0;
        const Eigen::Vector3d to_point = point - ray.origin;
        return (cosine * ray.direction.dot(to_point) - direction.dot(to_point)) / denominator;
    };
    return place(to) - place(from);
}

double snap_length(const LiveScene& scene) {
    return round_step(0.01 * (scene.report().max_corner - scene.report().min_corner).stableNorm());
}

double snapped(double value, double step) { return step > 0.0 ? step * std::round(value / step) : value; }

}  // namespace elastolab
