#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The points x with normal . x = offset.
struct Plane {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of length 1
    double offset = 0.0;                                ///< [L]
    bool operator==(const Plane&) const = default;
};

/// Points of a surface as weighted means of its vertices: they follow its displacements.
struct Anchors {
    Triangles nodes;           ///< 3 x n
    Eigen::Matrix3Xd weights;  ///< 3 x n, each column adding up to 1

    Eigen::Index size() const { return nodes.cols(); }
    /// The same mean of values at the vertices, columns of a matrix: rows x n.
    Eigen::MatrixXd mean(const Eigen::Ref<const Eigen::MatrixXd>& of_vertices) const;
};

/// What a plane leaves of a surface: the part that its normal points away from.
struct OpenedSurface {
    /// A piece of the line along which a triangle is cut, from one vertex of `vertices` to another. The body is on its
    /// left, seen against the plane's normal.
    struct Segment {
        int from, to, triangle;  ///< triangle of the whole surface
    };
    Anchors vertices;          ///< whole vertices, then points on cut edges
    Triangles triangles;       ///< whole ones and parts, counter-clockwise seen from outside
    std::vector<int> origins;  ///< for each of these, the triangle of the whole surface; ascending
    std::vector<Segment> outline;
};

/// Cuts edge by edge, so that a closed surface has closed outlines; a vertex on the plane counts as above it.
OpenedSurface open_surface(const SurfaceMesh& surface, const Plane& plane);

}  // namespace elastolab
