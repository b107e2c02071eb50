#pragma once

#include <Eigen/Core>
#include <vector>

#include "elasticity/material.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A triangle at rest, and how the displacements of its corners change over it.
struct TriangleStrain {
    TriangleStrain(const SurfaceMesh& surface, Eigen::Index triangle, const Eigen::Ref<const Eigen::Matrix3Xd>& u);

    Eigen::Matrix3d axes;                  ///< orthonormal: two in its plane, then its normal
    Eigen::Matrix<double, 3, 2> gradient;  ///< of the displacement, along the two in its plane
    double area = 0.0;                     ///< [L^2]
    /// The strain within its plane, of small displacements.
    Eigen::Matrix2d small() const;
};
std::vector<TriangleStrain> triangle_strains(const SurfaceMesh& surface, const Eigen::Ref<const Eigen::Matrix3Xd>& u);

/// Tractions on the triangles whose corners all have one, 3 x n_triangles [force / L^2]; zero on others. Those of the
/// vertices (as vertex_tractions has them) are means over all such triangles around them, whatever their normals. Where
/// these differ, as at an edge inside a constrained patch, one stress at the vertex is found that fits the strains of
/// these triangles and, times their mean normal, the vertex's traction (by least squares), and it gives each triangle
/// its own. large_deformations: neo-Hookean, tractions per rest area.
Eigen::Matrix3Xd triangle_tractions(const SurfaceMesh& surface, const Material& material,
                                    const std::vector<TriangleStrain>& strains, const Eigen::Matrix3Xd& tractions,
                                    bool large_deformations);

}  // namespace elastolab
