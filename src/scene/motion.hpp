#pragma once

#include <Eigen/Core>
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

/// Mean displacement of the vertices at these rest positions.
Eigen::Vector3d mean_displacement(const Motion& motion, const Positions& rest);

}  // namespace elastolab
