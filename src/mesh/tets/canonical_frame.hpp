#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A closed surface in a frame that does not depend on its place, size and numbering, nor on reflections and rotations
/// by right angles: the same body after any of these gives the same mesh, bit by bit, where they are exact (scaling by
/// other factors than powers of two, and translations, round, which the grid below mostly absorbs). A symmetric body
/// may come out as one of its symmetric images. What depends on ties, such as the tetrahedra of points on one sphere,
/// is then the same, too.
///
/// The box around the body is centred and scaled to 1 along its longest side, its points are rounded to a grid, and one
/// of the 48 axis permutations with signs is chosen by the body's shape.
class CanonicalFrame {
public:
    /// grid_bits: points are multiples of 2^-grid_bits, at most 52.
    CanonicalFrame(const SurfaceMesh& solid, int grid_bits);

    /// Vertices and triangles in ascending order, triangles beginning with their smallest vertex, outward.
    const SurfaceMesh& mesh() const { return mesh_; }
    /// Vertex of the solid for each of mesh().
    const std::vector<int>& vertices() const { return vertices_; }
    /// Points from the frame back to where the solid is.
    Positions to_solid(const Positions& points) const;

private:
    Eigen::Vector3d centre_;
    double size_;
    Eigen::Matrix3d axes_;  ///< signed permutation: frame from solid
    SurfaceMesh mesh_;
    std::vector<int> vertices_;
};

}  // namespace elastolab
