#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mesh/topology.hpp"
#include "scene/constraints.hpp"
#include "scene/proxy/followers.hpp"
#include "scene/proxy/proxy.hpp"

namespace elastolab {

/// Constraints of the shown surface, carried over to its proxy, and displacements of the proxy, carried back.
///
/// A vertex of the proxy is constrained when it is within ProxyOwner::kReach mean edges of the constrained part of the
/// shown surface: the triangles of which all corners are constrained, and single constrained vertices. It follows the
/// same motion. A handle or fixed set that is smaller than the proxy's triangles holds the corners of the nearest one.
/// A force on a handle acts where it does on the shown surface.
/// Of the fixed part, a vertex of the proxy belongs to the set of the shown vertex that it is nearest to.
///
/// Shown vertices follow their places on the proxy, but constrained ones go exactly where they were put; the difference
/// between the two fades out around them within one edge of the proxy. Where the proxy is the shown surface with its
/// holes filled, vertices are carried to themselves.
class CarriedConstraints {
public:
    explicit CarriedConstraints(std::shared_ptr<const Proxy> proxy);

    const Proxy& proxy() const { return *proxy_; }
    /// Carries them over; cheap when only values are new.
    void set(const Constraints& shown);
    /// Those of the last set(), for a body with the proxy's surface.
    const Constraints& constraints() const { return carried_; }

    /// Displacements of the shown vertices, 3 * n_shown [L], from those of the proxy under constraints(), 3 *
    /// n_proxy.
    Eigen::VectorXd displacement(const Eigen::VectorXd& of_proxy) const;
    /// The same where those of the proxy are of other constraints: constrained vertices follow it, too.
    Eigen::VectorXd places(const Eigen::VectorXd& of_proxy) const;

    /// Findings of an answer under constraints(), for the shown constraints: point constraints are shown vertices, and
    /// handles that the proxy has no vertex for are named.
    Findings as_shown(Findings of_proxy) const;

private:
    void choose_vertices();
    void carry_values();
    void carry_forces();
    Eigen::Vector3d value_of(const Follower& follower) const;

    std::shared_ptr<const Proxy> proxy_;
    VertexTriangles around_;  ///< of the shown surface
    Constraints shown_, carried_;
    Findings own_findings_;  ///< of the shown constraints, and of what the proxy has no vertex for
    bool chosen_ = false;
    std::vector<Eigen::Vector3i> origins_;         ///< of each carried handle vertex: places in its handle,
    std::vector<Eigen::Vector3d> origin_weights_;  ///< whose weighted mean is nearest to it
    std::vector<Follower> followers_;
    std::vector<AffineMap> maps_;  ///< of every handle; nothing for motions of single vertices
};

/// One value a proxy vertex, carried to the shown vertices.
Eigen::VectorXd carried_values(const Proxy& proxy, const Eigen::VectorXd& of_proxy);

}  // namespace elastolab
