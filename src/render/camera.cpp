#include "render/camera.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace elastolab {

namespace {

constexpr double kFieldOfView = 0.6, kNarrowFieldOfView = 0.002;  // vertical [radians]
constexpr double kNearestZoom = 1e-4, kFarthestZoom = 1e3;        // distance / scene radius
constexpr double kFramedDistance = 3.5;                           // scene radii, when all of it is in sight
constexpr double kFrameMargin = 1.08;                             // room around a framed ball
constexpr double kInFront = 1.6, kBehind = 8.0;  // scene radii in sight in front of its centre and behind
constexpr double kNearestPlane = 0.02;           // of the distance
constexpr double kRounding = 1e-9;               // of an orientation, after many turns

Eigen::Quaterniond turn(double angle, const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

/// Any direction perpendicular to this one.
Eigen::Vector3d across(const Eigen::Vector3d& direction) {
    Eigen::Index smallest = 0;
    direction.cwiseAbs().minCoeff(&smallest);
    return direction.cross(Eigen::Vector3d::Unit(smallest));
}

}  // namespace

/// From the middle of the picture to its upper edge, at depth 1. A lens that zooms in on a part of the scene is the
/// longer: the eye stays as far from the whole of it.
double Camera::slope() const {
    if (kind_ == Projection::perspective) return std::tan(0.5 * kFieldOfView);
    return std::tan(0.5 * kNarrowFieldOfView) / std::max(1.0, kFramedDistance * scene_.radius / pose_.distance);
}

double Camera::remoteness() const { return std::tan(0.5 * kFieldOfView) / slope(); }

/// Eye coordinates, at depth 1, of what a pixel shows.
Eigen::Vector3d Camera::eye_direction(const Eigen::Vector2d& pixel, const Viewport& viewport) const {
    const Eigen::Vector2d offset = (pixel - viewport.center()) * slope_per_pixel(viewport);
    return {offset.x(), -offset.y(), -1.0};
}

Eigen::Matrix4d Camera::view() const {
    const Eigen::Matrix3d to_eye = pose_.orientation.conjugate().toRotationMatrix();
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = to_eye;
    matrix.topRightCorner<3, 1>() = -(to_eye * eye());
    return matrix;
}

Eigen::Matrix4d Camera::projection(const Viewport& viewport, double unit) const {
    const double depth = (eye() - scene_.center).dot(backward());
    const double least = kNearestPlane * eye_distance();
    const double near = std::max(depth - kInFront * scene_.radius, least) / unit;
    const double far = std::max((depth + kBehind * scene_.radius) / unit, 2.0 * near);
    const double scale = 1.0 / slope();
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    matrix(0, 0) = scale / viewport.aspect();
    matrix(0, 2) = viewport.covered / viewport.width;  // half of it, times the width, which is 2 in clip coordinates
    matrix(1, 1) = scale;
    matrix(2, 2) = -(far + near) / (far - near);
    matrix(2, 3) = -2.0 * far * near / (far - near);
    matrix(3, 2) = -1.0;
    return matrix;
}

void Camera::orbit(double dx, double dy, const Viewport& viewport) {
    const double per_pixel = std::numbers::pi / viewport.height;
    pose_.orientation = turn(-dx * per_pixel, up_axis_) * pose_.orientation;
    const double upright = up().dot(up_axis_);
    const double side = upright >= -kRounding ? 1.0 : -1.0;  // -1: upside down, by set_pose()
    // 0 when looking down. From its sine and cosine, as near the poles an arc cosine keeps half the digits; a camera
    // that is upright but for rounding may be just beyond a pole.
    double polar = std::atan2(side * upright, backward().dot(up_axis_));
    if (polar < -0.5 * std::numbers::pi) polar += 2.0 * std::numbers::pi;
    const double wanted = std::clamp(polar - side * dy * per_pixel, 0.0, std::numbers::pi);
    pose_.orientation = (turn(side * (wanted - polar), right()) * pose_.orientation).normalized();
}

void Camera::pan(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Viewport& viewport) {
    pose_.target -= drag_in_plane(pose_.target, from, to, viewport);
}

void Camera::zoom_to(const Eigen::Vector2d& cursor, double factor, const Eigen::Vector3d& anchor,
                     const Viewport& viewport) {
    const double distance =
        std::clamp(pose_.distance / factor, kNearestZoom * scene_.radius, kFarthestZoom * scene_.radius);
    const double depth = (eye() - anchor).dot(backward());
    const Eigen::Vector3d fixed = unproject(cursor, depth > 0.0 ? depth : eye_distance(), viewport);
    pose_.target = fixed + (pose_.target - fixed) * (distance / pose_.distance);
    pose_.distance = distance;
    const double new_depth = (eye() - fixed).dot(backward());
    if (kind_ == Projection::orthographic) pose_.target += fixed - unproject(cursor, new_depth, viewport);
}

void Camera::fit(const PositionsView& points, double aspect) {
    constexpr double kMargin = 0.86;  // of half the picture
    const double slope_y = kMargin * slope(), slope_x = slope_y * aspect;
    const Eigen::Matrix3d axes = pose_.orientation.toRotationMatrix();
    const Eigen::Vector3d origin = points.col(0);
    const Eigen::Matrix3Xd local = axes.transpose() * (points.colwise() - origin);
    // The four sides of the viewing frustum are to touch the points: each pair of opposite sides gives the eye a place
    // across and a distance, of which the larger is taken.
    const auto side = [&](Eigen::Index axis, double slope) {
        const double high = (local.row(axis) + slope * local.row(2)).maxCoeff();
        const double low = (local.row(axis) - slope * local.row(2)).minCoeff();
        return std::pair(0.5 * (high + low), 0.5 * (high - low) / slope);  // place across, height of the eye
    };
    const auto [x, z_of_x] = side(0, slope_x);
    const auto [y, z_of_y] = side(1, slope_y);
    const double middle = 0.5 * (local.row(2).maxCoeff() + local.row(2).minCoeff());
    const double distance = std::max(z_of_x, z_of_y) - middle;
    pose_.target = origin + axes * Eigen::Vector3d(x, y, middle);
    pose_.distance = std::max(distance / remoteness(), 1e-3 * scene_.radius);
}

void Camera::frame(const SceneFrame& ball, double aspect) {
    const double half = std::atan(slope() * std::min(aspect, 1.0));
    pose_.target = ball.center;
    pose_.distance = kFrameMargin * ball.radius / std::sin(half) / remoteness();
}

void Camera::set_view(ViewDirection from) {
    const bool y_up = up_axis_.y() > 0.5;
    const Eigen::Vector3d front = y_up ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(across(up_axis_).normalized());
    const Eigen::Vector3d facing = !y_up && up_axis_.z() > 0.5 ? Eigen::Vector3d(0, -1, 0) : front;
    const Eigen::Vector3d side = up_axis_.cross(facing);
    switch (from) {
        case ViewDirection::front:
            return look_from(facing, up_axis_);
        case ViewDirection::back:
            return look_from(-facing, up_axis_);
        case ViewDirection::left:
            return look_from(-side, up_axis_);
        case ViewDirection::right:
            return look_from(side, up_axis_);
        case ViewDirection::top:
            return look_from(up_axis_, -facing);
        case ViewDirection::bottom:
            return look_from(-up_axis_, facing);
        case ViewDirection::isometric:
            return look_from(1.1 * facing + 0.75 * side + 0.7 * up_axis_, up_axis_);
    }
}

void Camera::look_along(const Eigen::Vector3d& direction) {
    const double along = direction.normalized().dot(up_axis_);
    if (std::abs(along) < 1.0 - kRounding) return look_from(direction, up_axis_);
    set_view(along > 0.0 ? ViewDirection::top : ViewDirection::bottom);
}

void Camera::look_from(const Eigen::Vector3d& direction, const Eigen::Vector3d& top) {
    Eigen::Matrix3d axes;
    axes.col(2) = direction.normalized();
    Eigen::Vector3d side = top.cross(axes.col(2));
    if (side.norm() < 1e-9 * top.norm()) side = across(axes.col(2));
    axes.col(0) = side.normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    pose_.orientation = Eigen::Quaterniond(axes).normalized();
}

Ray Camera::ray(const Eigen::Vector2d& cursor, const Viewport& viewport) const {
    return {eye(), (pose_.orientation * eye_direction(cursor, viewport)).normalized()};
}

ProjectedPoint Camera::project(const Eigen::Vector3d& point, const Viewport& viewport) const {
    const Eigen::Vector3d seen = pose_.orientation.conjugate() * (point - eye());
    const double depth = -seen.z(), per_slope = 1.0 / slope_per_pixel(viewport);
    return {viewport.center() + Eigen::Vector2d(seen.x(), -seen.y()) * (per_slope / depth), depth};
}

Eigen::Vector3d Camera::unproject(const Eigen::Vector2d& pixel, double depth, const Viewport& viewport) const {
    return eye() + pose_.orientation * (depth * eye_direction(pixel, viewport));
}

Eigen::Vector3d Camera::drag_in_plane(const Eigen::Vector3d& anchor, const Eigen::Vector2d& from,
                                      const Eigen::Vector2d& to, const Viewport& viewport) const {
    const double depth = (eye() - anchor).dot(backward());
    assert(depth > 0.0);
    const Eigen::Vector2d offset = (to - from) * pixel_size(depth, viewport);
    return offset.x() * right() - offset.y() * up();
}

double Camera::pixel_size(double depth, const Viewport& viewport) const { return depth * slope_per_pixel(viewport); }

}  // namespace elastolab
