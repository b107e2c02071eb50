#pragma once

#include <Eigen/Core>

#include "elasticity/triangle_kernels.hpp"

namespace elastolab {

/// Prepares one triangle for the kernels. Corners counter-clockwise seen from outside; `index` is the number by which a
/// source in its interior names it (SourceLanes::own_triangle). The triangle must not be degenerate.
TriangleGeometry make_triangle_geometry(const Eigen::Vector3d& v0, const Eigen::Vector3d& v1, const Eigen::Vector3d& v2,
                                        int index);

/// Whether its potential is that of a sliver (kSliverAltitudeOfPotential): far more expensive.
bool has_sliver_potential(const TriangleGeometry& triangle);

/// The same triangle with everything computed in extended precision from its corners.
BasicTriangleGeometry<long double> extended_geometry(const TriangleGeometry& triangle);

}  // namespace elastolab
