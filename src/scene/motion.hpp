#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>

#include "mesh/surface_mesh.hpp"
#include "scene/document.hpp"

namespace elastolab {

using Motion = std::variant<AffineMotion, VertexMotion>;

/// `motion`, followed by a shift of every vertex by `shift` [L].
Motion translated(const Motion& motion, const Eigen::Vector3d& shift);

/// `motion`, followed by the linear map `map` about the point `center`: x + u becomes center + map (x + u - center).
/// `rest` holds the rest positions of the vertices that a VertexMotion moves, in its order.
Motion transformed(const Motion& motion, const Eigen::Matrix3d& map, const Eigen::Vector3d& center,
                   const Positions& rest);

/// `motion` with every displacement multiplied by `factor`.
Motion scaled(const Motion& motion, double factor);

/// A motion as a person thinks of it: the middle of the vertices moves, and they are turned and scaled about it.
struct Placement {
    Eigen::Vector3d move = Eigen::Vector3d::Zero();  ///< [L]
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< about x, then y, then z of the world [degree]
    double scale = 1.0;                              ///< > 0
};
/// Nothing for a motion that shears or mirrors, and for one of single vertices.
std::optional<Placement> placement_of(const Motion& motion, const Positions& rest);
AffineMotion motion_of(const Placement& placement, const Positions& rest);

/// Mean displacement of the vertices at these rest positions.
Eigen::Vector3d mean_displacement(const Motion& motion, const Positions& rest);

}  // namespace elastolab
