#pragma once

#include <Eigen/Core>

namespace elastolab {

/// What integrals over a tetrahedron with straight edges need of its shape.
struct TetElement {
    Eigen::Matrix<double, 3, 4> gradients;  ///< of the barycentric coordinates [1/L]
    double volume = 0.0;                    ///< [L^3]
};

/// number: for the message. Throws MeshError where it has no positive volume.
TetElement make_element(const Eigen::Matrix<double, 3, 4>& corners, Eigen::Index number);

}  // namespace elastolab
