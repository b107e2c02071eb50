#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/control.hpp"
#include "elasticity/material.hpp"
#include "fem/element.hpp"
#include "fem/quadratic_mesh.hpp"

namespace elastolab {

/// Products with the stiffness of quadratic elements, element by element without the matrix: for meshes on which a few
/// are wanted. Integrated by four points, which is exact.
class StiffnessProduct {
public:
    /// mesh: kept; poisson_ratio < 1/2. Throws MeshError where a tetrahedron has no positive volume.
    StiffnessProduct(const QuadraticMesh& mesh, const Material& material);

    /// Forces for displacements [L] of all nodes, 3*n_nodes, node-major; the same for any number of threads.
    Eigen::VectorXd operator()(const Eigen::VectorXd& u) const;
    /// The blocks on the diagonal, one node after the other: 3 x 3 n_nodes.
    Eigen::Matrix3Xd diagonal() const;

private:
    const QuadraticMesh& mesh_;
    double lambda_, mu_;
    std::vector<TetElement> elements_;
};

}  // namespace elastolab
