#include "elasticity/triangle_geometry.hpp"

#include <algorithm>
#include <array>
#include <Eigen/Geometry>

namespace elastolab {

TriangleGeometry make_triangle_geometry(const Eigen::Vector3d& v0, const Eigen::Vector3d& v1, const Eigen::Vector3d& v2,
                                        int index) {
    const std::array<Eigen::Vector3d, 3> corners = {v0, v1, v2};
    const Eigen::Vector3d scaled_normal = (v1 - v0).cross(v2 - v0);
    const Eigen::Vector3d n = scaled_normal.normalized();
    const Eigen::Vector3d e1 = (v1 - v0).normalized();
    const Eigen::Vector3d e2 = n.cross(e1);

    TriangleGeometry triangle{};
    triangle.index = index;
    triangle.double_area = scaled_normal.norm();
    for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d edge = corners[(i + 1) % 3] - corners[i];
        const Eigen::Vector3d opposite = corners[(i + 2) % 3] - corners[(i + 1) % 3];
        // grad phi_i is perpendicular to the opposite edge: n x (opposite edge) / (2 area).
        const Eigen::Vector3d gradient = n.cross(opposite) / triangle.double_area;
        triangle.length[i] = edge.norm();
        triangle.tx[i] = edge.dot(e1) / triangle.length[i];
        triangle.ty[i] = edge.dot(e2) / triangle.length[i];
        triangle.gx[i] = gradient.dot(e1);
        triangle.gy[i] = gradient.dot(e2);
        for (int axis = 0; axis < 3; ++axis) triangle.corner[i][axis] = corners[i][axis];
        triangle.e1[i] = e1[i];
        triangle.e2[i] = e2[i];
        triangle.n[i] = n[i];
        triangle.centroid[i] = (v0[i] + v1[i] + v2[i]) / 3.0;
    }
    triangle.longest_edge = std::max({triangle.length[0], triangle.length[1], triangle.length[2]});
    return triangle;
}

}  // namespace elastolab
