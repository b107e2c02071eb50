#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "render/gl/arrays.hpp"
#include "render/scene_frame.hpp"
#include "render/geometry/smoothing_groups.hpp"

namespace elastolab {

/// A vertex as the graphics card gets it, in the units of its SceneFrame. The fourth components are only padding.
struct DrawnVertex {
    Eigen::Vector4f position = Eigen::Vector4f::Zero();
    Eigen::Vector4f normal = Eigen::Vector4f::Zero();  ///< unit length; zero where all triangles have collapsed
};

/// Positions and normals of a deforming surface, split at the creases of its rest shape.
class SurfaceGeometry {
public:
    SurfaceGeometry() = default;
    SurfaceGeometry(const PositionsView& rest, const TrianglesView& triangles);

    const SmoothingGroups& groups() const { return groups_; }
    /// Recomputes all vertices. Normals are means of the triangles' normals, weighted by the corner angles at rest.
    void update(const PositionsView& positions, const SceneFrame& frame);
    std::span<const DrawnVertex> vertices() const { return vertices_; }

private:
    SmoothingGroups groups_;
    Eigen::Matrix3Xf corner_weights_;  // angles at rest
    std::vector<DrawnVertex> vertices_;
};

}  // namespace elastolab
