#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The inside of one solid, for methods that have nodes there. Immutable; any thread may use it.
class Interior {
public:
    virtual ~Interior() = default;

    /// The surface vertices first, in the order of the solid.
    virtual const TetMesh& tetrahedra() const = 0;
    /// Displacements of all nodes, 3*n [L], from those of the surface vertices, 3*n_surface.
    virtual Eigen::VectorXd extend(const Eigen::VectorXd& surface) const = 0;
};

}  // namespace elastolab
