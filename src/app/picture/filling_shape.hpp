#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mesh/surface_mesh.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// What fills the holes of a surface that is simulated with its holes filled: the triangles that it has not itself, and
/// their vertices. Immutable.
class FillingShape {
public:
    /// `filled.is_filled()`.
    explicit FillingShape(const Proxy& filled);

    const std::shared_ptr<const SurfaceMesh>& surface() const { return surface_; }  ///< the filled one
    const Positions& rest() const { return rest_; }
    const Triangles& triangles() const { return triangles_; }  ///< of the columns of rest()
    /// Its vertices, moved by `scale` times the displacements of all vertices of the filled surface, 3 * n [L].
    Positions displaced(const Eigen::VectorXd& of_surface, double scale) const;

private:
    std::shared_ptr<const SurfaceMesh> surface_;
    std::vector<int> vertices_;  ///< their numbers on the filled surface
    Positions rest_;
    Triangles triangles_;
};

}  // namespace elastolab
