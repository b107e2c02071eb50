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
    /// The shown surface with its holes filled: its vertices, then those of the filling that are not its own; its
    /// triangles, then the filling's. All face outward, whichever way the shown ones do.
    const std::shared_ptr<const SurfaceMesh>& closed() const { return closed_; }
    /// Values of the vertices of closed(), as columns, from those of the shown surface and of the filling.
    Eigen::MatrixXd joined(const Eigen::Ref<const Eigen::MatrixXd>& of_shown,
                           const Eigen::Ref<const Eigen::MatrixXd>& of_filling) const;
    /// Values of its vertices from those of all vertices of the filled surface, rows x n.
    Eigen::MatrixXd taken(const Eigen::Ref<const Eigen::MatrixXd>& of_surface) const;
    /// The same from those of the shown surface alone, spread from the rims of the holes.
    Eigen::MatrixXd spread(const Eigen::Ref<const Eigen::MatrixXd>& of_shown) const;
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
    void close(const SurfaceMesh& shown);

    std::shared_ptr<const SurfaceMesh> surface_, closed_;
    std::vector<int> vertices_;  ///< their numbers on the filled surface,
    std::vector<int> places_;    ///< and on the closed one
    Positions rest_;
    Triangles triangles_;
    std::vector<Follower> followers_;  ///< for each column of rest()
};

}  // namespace elastolab
