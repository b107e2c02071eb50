#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace elastolab::bodies {

/// A smooth function of space, negative inside a body and zero on its surface. Near the surface about the distance to
/// it; nowhere is more than that needed. Uses only what IEEE arithmetic rounds the same everywhere (+ - * / sqrt).
using Field = std::function<double(const Eigen::Vector3d&)>;

/// Central differences.
Eigen::Vector3d gradient(const Field& field, const Eigen::Vector3d& p);

/// One ball of a chain.
struct Ball {
    Eigen::Vector3d center;
    double radius;
};
/// A limb: balls joined by capsules that taper, rounded where they meet over a distance `blend` [L].
Field limb(const std::vector<Ball>& balls, double blend = 0.0);
/// Axes along those of space.
Field ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii);
/// An ellipsoid whose third axis points along `axis`, its second as far along y as that allows.
Field ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii, const Eigen::Vector3d& axis);
/// Edges rounded with `radius`; half_size includes the rounding.
Field rounded_box(const Eigen::Vector3d& center, const Eigen::Vector3d& half_size, double radius);
/// Everything below the plane: inside where (p - point) . normal < 0; unit normal.
Field half_space(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
/// An endless round bar along an axis of space (0, 1, 2).
Field round_bar(const Eigen::Vector3d& point, int axis, double radius);

/// Smooth (twice differentiable) where the parts are closer than `blend` [L] to each other; a fillet.
Field unite(const std::vector<Field>& parts, double blend);
Field subtract(Field from, Field what, double blend);
Field outside(Field field);
/// The body and its image under x -> -x.
Field mirrored(Field field);

}  // namespace elastolab::bodies
