#include "fem/element.hpp"

#include <Eigen/LU>
#include <string>

#include "base/error.hpp"

namespace elastolab {

TetElement make_element(const Eigen::Matrix<double, 3, 4>& corners, Eigen::Index number) {
    const Eigen::Matrix3d edges = corners.rightCols<3>().colwise() - corners.col(0);
    const double determinant = edges.determinant();
    if (!(determinant > 0.0))
        throw MeshError("tetrahedron " + std::to_string(number) +
                        ": has no positive volume. Repair slivers of the surface and fill it again.");
    TetElement element;
    element.volume = determinant / 6.0;
    element.gradients.rightCols<3>() = edges.inverse().transpose();
    element.gradients.col(0) = -element.gradients.rightCols<3>().rowwise().sum();
    return element;
}

}  // namespace elastolab
