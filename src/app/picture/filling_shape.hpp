#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mesh/surface_mesh.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// What fills the holes of a surface that is simulated with its holes filled: the added triangles, and their vertices.
/// Immutable.
class FillingShape {
public:
    /// `filled.is_filled()`.
    explicit FillingShape(const Proxy& filled);

    const std::shared_ptr<const SurfaceMesh>& surface() const { return surface_; }  ///< the filled one
    const Positions& rest() const { return rest_; }
    const Triangles& triangles() const { return triangles_; }  ///< of the columns of rest()
    /// Its vertices, moved by `scale` times the displacements of all vertices of the filled surface, 3 * n [L].
    Positions displaced(const Eigen::VectorXd& of_surface, double scale) const;
    /// The same from the deformed shown surface alone: vertices on the rims of the holes are its own, and those between
    /// follow them, the nearest most.
    Positions following(const Positions& shown) const;

private:
    /// A vertex: the shown vertices on the rim that it follows, and where it is at rest from their weighted mean. On
    /// the rim: itself alone.
    struct Follower {
        std::vector<int> leaders;
        std::vector<double> shares;  ///< their sum is 1
        Eigen::Vector3d offset;      ///< [L]
    };
    void find_leaders(const Proxy& filled);

    std::shared_ptr<const SurfaceMesh> surface_;
    std::vector<int> vertices_;  ///< their numbers on the filled surface
    Positions rest_;
    Triangles triangles_;
    std::vector<Follower> followers_;  ///< for each column of rest()
};

}  // namespace elastolab
