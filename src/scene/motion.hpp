#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>

#include "mesh/surface_mesh.hpp"
#include "scene/document.hpp"

namespace elastolab {

using Motion = std::variant<AffineMotion, VertexMotion>;

/// u(x) = matrix x + translate, x the rest position.
struct AffineMap {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d translate = Eigen::Vector3d::Zero();  ///< [L]

    Eigen::Vector3d displacement(const Eigen::Vector3d& x) const { return matrix * x + translate; }
};
/// Where a motion ends, whatever the way there. Whole turns leave nothing, not even rounding.
AffineMap map_of(const AffineMotion& motion);

/// A rotation about `center`, which is shifted.
AffineMotion rigid_motion(const Eigen::Vector3d& shift, const Eigen::Vector3d& turn, const Eigen::Vector3d& center);

/// Displacements of vertices at these rest positions, one column each, where the motion ends.
Eigen::Matrix3Xd displacements(const Motion& motion, const Positions& rest);

/// A motion that takes vertices from rest to these places, to a hundredth of the patch's size: the affine one that is
/// nearest, which turns the patch as little as it can, or, where the patch is deformed in other ways, one of single
/// vertices. rest, present: 3 x n, n > 0.
Motion motion_to(const Positions& rest, const Positions& present);

/// `motion`, followed by a shift of every vertex by `shift` [L].
Motion translated(const Motion& motion, const Eigen::Vector3d& shift);

/// `motion`, followed by the linear map `map` about the point `center`: x + u becomes center + map (x + u - center).
/// `rest` holds the rest positions of the vertices that a VertexMotion moves, in its order.
Motion transformed(const Motion& motion, const Eigen::Matrix3d& map, const Eigen::Vector3d& center,
                   const Positions& rest);

/// `motion`, followed by a turn about the point `center` as it is after `motion`. `turn`: a rotation vector, along the
/// axis and as long as the angle, which may be any [radians]. Turns about one axis add up; one about another axis gives
/// the rotation of the nearest angle, or, where there is none near (after about a full turn), goes before what has been
/// turned so far.
Motion turned(const Motion& motion, const Eigen::Vector3d& turn, const Eigen::Vector3d& center, const Positions& rest);

/// A part of the way that a motion takes, 0 (at rest) to 1 (all of it): turns go through all angles between, about
/// their centre; the middle of the vertices goes straight where nothing turns it; a rotation in the matrix is turned
/// through, too, stretches grow evenly.
Motion part_of(const Motion& motion, double part, const Positions& rest);

/// The angle that the rotations of two motions lie apart, full turns included [degree].
double turn_between(const Motion& from, const Motion& to);

/// A part of the way from one motion to another: 0 gives the first, 1 the second. Where both turn about one axis, it
/// goes through the angles between; nothing where they turn about different ones.
std::optional<Motion> between(const Motion& from, const Motion& to, double part);

/// A motion as a person thinks of it: the middle of the vertices moves, and they are turned and scaled about it.
struct Placement {
    Eigen::Vector3d move = Eigen::Vector3d::Zero();  ///< [L]
    /// A rotation vector in the axes of the world: (0, 0, 720) are two full turns about z [degree].
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    double scale = 1.0;  ///< > 0
};
/// Nothing for a motion that shears or mirrors, for one of single vertices, and for two turns about different axes.
std::optional<Placement> placement_of(const Motion& motion, const Positions& rest);
AffineMotion motion_of(const Placement& placement, const Positions& rest);

/// Mean displacement of the vertices at these rest positions.
Eigen::Vector3d mean_displacement(const Motion& motion, const Positions& rest);

}  // namespace elastolab
