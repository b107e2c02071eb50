#include "bem/galerkin/hat_curls.hpp"

namespace elastolab {

Eigen::Matrix3d hat_curls(const TriangleGeometry& triangle) {
    Eigen::Matrix3d curls;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Map<const Eigen::Vector3d> from(triangle.corner[(k + 1) % 3]), to(triangle.corner[(k + 2) % 3]);
        curls.col(k) = (from - to) / triangle.double_area;
    }
    return curls;
}

}  // namespace elastolab
