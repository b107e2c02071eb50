#include "render/geometry/surface_geometry.hpp"

#include <cassert>
#include <cmath>
#include <Eigen/Geometry>

namespace elastolab {

namespace {

Eigen::Matrix3Xf corner_angles(const PositionsView& positions, const TrianglesView& triangles) {
    Eigen::Matrix3Xf angles(3, triangles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d corner = positions.col(triangles(i, t));
            const Eigen::Vector3d a = positions.col(triangles((i + 1) % 3, t)) - corner;
            const Eigen::Vector3d b = positions.col(triangles((i + 2) % 3, t)) - corner;
            angles(i, t) = static_cast<float>(std::atan2(a.cross(b).norm(), a.dot(b)));
        }
    return angles;
}

/// `vector` at length 1; zero if it has none to speak of.
Eigen::Vector4f unit_or_zero(const Eigen::Vector4f& vector) {
    const float square = vector.squaredNorm();
    return square > 1e-36f ? Eigen::Vector4f(vector * (1.0f / std::sqrt(square))) : Eigen::Vector4f::Zero();
}

}  // namespace

SurfaceGeometry::SurfaceGeometry(const PositionsView& rest, const TrianglesView& triangles)
    : groups_(smoothing_groups(rest, triangles)),
      corner_weights_(corner_angles(rest, triangles)),
      vertices_(groups_.vertices.size()) {}

void SurfaceGeometry::update(const PositionsView& positions, const SceneFrame& frame) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        assert(groups_.vertices[i] < positions.cols());
        vertices_[i].position.head<3>() = frame.local(positions.col(groups_.vertices[i]));
        vertices_[i].normal.setZero();
    }
    for (Eigen::Index t = 0; t < groups_.corners.cols(); ++t) {
        DrawnVertex* corner[3];
        for (int i = 0; i < 3; ++i) corner[i] = &vertices_[static_cast<std::size_t>(groups_.corners(i, t))];
        const Eigen::Vector4f ab = corner[1]->position - corner[0]->position;
        const Eigen::Vector4f ac = corner[2]->position - corner[0]->position;
        const Eigen::Vector4f normal = unit_or_zero(ab.cross3(ac));
        for (int i = 0; i < 3; ++i) corner[i]->normal += corner_weights_(i, t) * normal;
    }
    for (DrawnVertex& vertex : vertices_) vertex.normal = unit_or_zero(vertex.normal);
}

}  // namespace elastolab
