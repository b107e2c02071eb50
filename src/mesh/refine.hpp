#pragma once

#include <array>
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

using SurfaceWeights = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A new vertex on an edge.
struct EdgeCut {
    std::array<int, 2> ends;  ///< vertices of the edge, ascending
    double share = 0.5;       ///< how far it is from the first, as a part of the edge

    double weight(std::size_t end) const { return end == 0 ? 1.0 - share : share; }
};

/// A finer triangulation of the same polyhedron. The vertices of the coarse one come first, unmoved.
struct RefinedSurface {
    SurfaceMesh mesh;
    std::vector<EdgeCut> cuts;  ///< where every new vertex is, from n_vertices of the coarse mesh onward
    /// For every triangle, the coarse triangle that it is a part of.
    std::vector<int> coarse_triangle;

    /// Extends values at the coarse vertices (3 x n_coarse) to all, linearly on every coarse triangle.
    Eigen::Matrix3Xd interpolate(const Eigen::Matrix3Xd& coarse) const;
    /// The transpose: takes loads at all vertices (3 x n) to those at the coarse ones that do the same work.
    Eigen::Matrix3Xd gather(Eigen::Matrix3Xd loads) const;
    /// Interpolation as a matrix: what each coarse vertex contributes to each vertex, n x n_coarse.
    SurfaceWeights weights() const;
};

/// The mesh itself, as the beginning of a chain of refinements.
RefinedSurface unrefined(const SurfaceMesh& mesh);

/// Cuts edges, none of them twice, and the triangles beside them from the new vertices, so that the surface stays
/// closed.
RefinedSurface cut_edges(const RefinedSurface& surface, const std::vector<EdgeCut>& cuts);

/// Splits the marked triangles in four by the midpoints of their edges; a neighbour that gets one or two midpoints is
/// cut from them, so that the surface stays closed.
RefinedSurface refine_marked(const RefinedSurface& surface, const std::vector<char>& marked);

/// Every triangle in four.
RefinedSurface refine_all(const RefinedSurface& surface);

/// Every tetrahedron in eight, the octahedron in its middle cut along its shortest diagonal. `fine` is refine_all of
/// the surface of the mesh; its vertices are the surface vertices of the result.
TetMesh refine_tetrahedra(const TetMesh& mesh, const RefinedSurface& fine);

}  // namespace elastolab
