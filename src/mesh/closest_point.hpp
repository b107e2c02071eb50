#pragma once

#include <Eigen/Core>

#include "base/control.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A point of a surface: in a triangle, with the weights of its corners, which are not negative and add up to 1.
struct SurfacePoint {
    int triangle = -1;
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
    double distance = 0.0;  ///< of the point that was asked for [L]
};

/// The point of a triangle that is closest to `point`; also for triangles without area.
SurfacePoint closest_in_triangle(const Eigen::Vector3d& point, const SurfaceMesh& mesh, int triangle);

/// Finds the closest points of a surface with a tree of boxes: about log n steps each. Keeps a reference to the mesh,
/// which has a triangle at least, and finite vertices.
class ClosestPoint {
public:
    explicit ClosestPoint(const SurfaceMesh& mesh);
    /// Of triangles at the same distance, one of them. `near`: a triangle that may be close, which saves time.
    SurfacePoint operator()(const Eigen::Vector3d& point, int near = 0) const;

private:
    const SurfaceMesh& mesh_;
    BoxTree tree_;
};

/// Where points are on a surface.
struct SurfacePlaces {
    Triangles nodes;           ///< 3 x n_points: the corners of the triangle of each
    Eigen::Matrix3Xd weights;  ///< 3 x n_points: of these corners
    Eigen::VectorXd distance;  ///< n_points [L]
};
/// The closest points of `mesh`, on all threads. `control` learns the progress of the present stage. Throws Cancelled.
SurfacePlaces closest_points(const SurfaceMesh& mesh, const Positions& points, Control& control);

}  // namespace elastolab
