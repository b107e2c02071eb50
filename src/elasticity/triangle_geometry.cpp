#include "elasticity/triangle_geometry.hpp"

#include <algorithm>
#include <array>
#include <Eigen/Geometry>

namespace elastolab {

namespace {

template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;

template <class Real>
BasicTriangleGeometry<Real> geometry_of(const std::array<Vector3<Real>, 3>& corners, int index) {
    const Vector3<Real> scaled_normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const Vector3<Real> n = scaled_normal.normalized();
    const Vector3<Real> e1 = (corners[1] - corners[0]).normalized();
    const Vector3<Real> e2 = n.cross(e1);

    BasicTriangleGeometry<Real> triangle{};
    triangle.index = index;
    triangle.double_area = scaled_normal.norm();
    for (int i = 0; i < 3; ++i) {
        const Vector3<Real> edge = corners[(i + 1) % 3] - corners[i];
        const Vector3<Real> opposite = corners[(i + 2) % 3] - corners[(i + 1) % 3];
        // grad phi_i is perpendicular to the opposite edge: n x (opposite edge) / (2 area).
        const Vector3<Real> gradient = n.cross(opposite) / triangle.double_area;
        triangle.length[i] = edge.norm();
        triangle.tx[i] = edge.dot(e1) / triangle.length[i];
        triangle.ty[i] = edge.dot(e2) / triangle.length[i];
        triangle.gx[i] = gradient.dot(e1);
        triangle.gy[i] = gradient.dot(e2);
        for (int axis = 0; axis < 3; ++axis) triangle.corner[i][axis] = corners[i][axis];
        triangle.e1[i] = e1[i];
        triangle.e2[i] = e2[i];
        triangle.n[i] = n[i];
        triangle.centroid[i] = (corners[0][i] + corners[1][i] + corners[2][i]) / Real(3);
    }
    triangle.longest_edge = std::max({triangle.length[0], triangle.length[1], triangle.length[2]});
    return triangle;
}

}  // namespace

TriangleGeometry make_triangle_geometry(const Eigen::Vector3d& v0, const Eigen::Vector3d& v1, const Eigen::Vector3d& v2,
                                        int index) {
    return geometry_of<double>({v0, v1, v2}, index);
}

bool has_sliver_potential(const TriangleGeometry& triangle) {
    return triangle.double_area < kSliverAltitudeOfPotential * triangle.longest_edge * triangle.longest_edge;
}

BasicTriangleGeometry<long double> extended_geometry(const TriangleGeometry& triangle) {
    std::array<Vector3<long double>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = Eigen::Map<const Eigen::Vector3d>(triangle.corner[i]).cast<long double>();
    return geometry_of<long double>(corners, triangle.index);
}

}  // namespace elastolab
