#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// An irregular closed mesh of a smooth, organic shape, with a patch to hold it by and a small one to pull.
struct OrganicBody {
    std::string name;
    SurfaceMesh surface;
    std::vector<int> fixed;          ///< at the bottom; every vertex belongs to a triangle of fixed vertices
    std::vector<int> pull;           ///< a cap at the tip of an ear; likewise
    Eigen::Vector3d pull_direction;  ///< outward at the cap, unit

    /// Fixed set, then pull; and their displacements: the fixed set at rest, pull moved by `distance` along its
    /// direction [L].
    std::vector<int> constrained() const;
    Positions values(double distance) const;
    /// The same with the pull turned by a finite angle [rad], as by a wrist, about an axis through its middle that is
    /// perpendicular to its direction.
    Positions turned_values(double angle) const;
};

/// The bodies, about 2 units high, vertices placed at random (seeded) at even distances, valences 4 to 9:
///   rabbit  a body with a head and two ears, pulled at an ear
///   potato  a lump without features, pulled at a bump
///   cactus  a stem with three arms, pulled at an arm
OrganicBody make_rabbit(int n_vertices = 600);
OrganicBody make_potato(int n_vertices = 350);
OrganicBody make_cactus(int n_vertices = 850);
std::vector<OrganicBody> organic_bodies();

}  // namespace elastolab
