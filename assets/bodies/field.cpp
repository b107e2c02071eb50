#include "bodies/field.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>

namespace elastolab::bodies {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Minimum of two, its kink rounded where they differ by less than `blend`.
double smooth_min(double a, double b, double blend) {
    const double h = std::max(blend - std::abs(a - b), 0.0);
    return std::min(a, b) - (blend > 0.0 ? h * h * h / (6.0 * blend * blend) : 0.0);
}

double to_capsule(const Vector3d& p, const Ball& a, const Ball& b) {
    const Vector3d axis = b.center - a.center;
    const double t = std::clamp((p - a.center).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    return (p - a.center - t * axis).norm() - (a.radius + t * (b.radius - a.radius));
}

/// p in the axes of the ellipsoid. To first order the distance, near the surface.
double to_ellipsoid(const Vector3d& p, const Vector3d& radii) {
    const double k0 = p.cwiseQuotient(radii).norm();
    const double k1 = p.cwiseQuotient(radii.cwiseProduct(radii)).norm();
    return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -radii.minCoeff();
}

}  // namespace

Vector3d gradient(const Field& field, const Vector3d& p) {
    constexpr double kStep = 1e-5;
    Vector3d g;
    for (int i = 0; i < 3; ++i) {
        const Vector3d step = kStep * Vector3d::Unit(i);
        g[i] = (field(p + step) - field(p - step)) / (2.0 * kStep);
    }
    return g;
}

Field limb(const std::vector<Ball>& balls, double blend) {
    return [=](const Vector3d& p) {
        double value = to_capsule(p, balls[0], balls[1]);
        for (std::size_t i = 2; i < balls.size(); ++i)
            value = smooth_min(value, to_capsule(p, balls[i - 1], balls[i]), blend);
        return value;
    };
}

Field ellipsoid(const Vector3d& center, const Vector3d& radii) {
    return [=](const Vector3d& p) { return to_ellipsoid(p - center, radii); };
}

Field ellipsoid(const Vector3d& center, const Vector3d& radii, const Vector3d& axis) {
    Matrix3d to_axes;
    to_axes.row(2) = axis.normalized().transpose();
    to_axes.row(0) = Vector3d::UnitY().cross(axis).normalized().transpose();
    to_axes.row(1) = to_axes.row(2).cross(to_axes.row(0));
    return [=](const Vector3d& p) { return to_ellipsoid(to_axes * (p - center), radii); };
}

Field rounded_box(const Vector3d& center, const Vector3d& half_size, double radius) {
    return [=](const Vector3d& p) {
        const Vector3d d = (p - center).cwiseAbs() - half_size + Vector3d::Constant(radius);
        return d.cwiseMax(0.0).norm() + std::min(d.maxCoeff(), 0.0) - radius;
    };
}

Field half_space(const Vector3d& point, const Vector3d& normal) {
    return [=](const Vector3d& p) { return (p - point).dot(normal); };
}

Field round_bar(const Vector3d& point, int axis, double radius) {
    return [=](const Vector3d& p) {
        Vector3d d = p - point;
        d[axis] = 0.0;
        return d.norm() - radius;
    };
}

Field unite(const std::vector<Field>& parts, double blend) {
    return [=](const Vector3d& p) {
        double value = std::numeric_limits<double>::max();
        for (const Field& part : parts) value = smooth_min(value, part(p), blend);
        return value;
    };
}

Field subtract(Field from, Field what, double blend) {
    return [=](const Vector3d& p) { return -smooth_min(-from(p), what(p), blend); };
}

Field outside(Field field) {
    return [=](const Vector3d& p) { return -field(p); };
}

Field mirrored(Field field) {
    return [=](const Vector3d& p) { return std::min(field(p), field({-p[0], p[1], p[2]})); };
}

}  // namespace elastolab::bodies
