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
    /// The same where only the shown surface has been deformed: its vertices lie on the rims of the holes, and those
    /// between follow them, the nearest most.
    Positions following(const Positions& shown) const;

private:
    /// A vertex, and where it is at rest from the middle of those on the rim that it follows, which are of the shown
    /// surface. On the rim itself: that vertex alone.
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
