#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "render/gl/arrays.hpp"
#include "render/camera.hpp"

namespace elastolab {

/// Where a ray meets a triangle.
struct RayHit {
    int triangle = -1;
    Eigen::Vector3d barycentric;
    double distance = 0.0;  ///< along the ray [L], > 0
};

/// The first triangle along the ray, seen from either side. Triangles that meet along an edge leave no gap.
std::optional<RayHit> first_hit(const Ray& ray, const PositionsView& positions, const TrianglesView& triangles);

/// Whether no triangle lies between the vertex and the eye, those that it is a corner of aside.
bool is_visible(const Eigen::Vector3d& eye, int vertex, const PositionsView& positions, const TrianglesView& triangles);

/// Those of `vertices` that is_visible() finds, in their order. For many: triangles are sorted into cells of the
/// screen, around these vertices, and each vertex looks only at those of its own cell. Every vertex must be in front of
/// the eye.
std::vector<int> visible_of(std::span<const int> vertices, const Camera& camera, const Viewport& viewport,
                            const PositionsView& positions, const TrianglesView& triangles);

}  // namespace elastolab
