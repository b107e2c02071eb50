#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "deform/interior.hpp"
#include "deform/model.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The inside of a body, for methods that have one. Immutable; any thread may use it.
class Volume {
public:
    /// Null when the method of the model has nodes on the surface only. Throws SolveError, Cancelled.
    static std::shared_ptr<const Volume> of(const std::shared_ptr<const Model>& model, Control& control);

    /// All solids in one: the vertices of the body first, in their order, then those inside.
    const TetMesh& mesh() const { return mesh_; }
    /// Displacements of all vertices of mesh(), 3*n [L], from those of the body's, 3*n_vertices.
    Eigen::VectorXd displace(const Eigen::VectorXd& surface) const;

private:
    struct Part {
        std::vector<int> vertices;  ///< in mesh(), for each node of the solid
        int n_surface = 0;
        double unit = 1.0;  ///< displacements in the solid over those in the body
        std::shared_ptr<const Interior> interior;
    };
    Volume() = default;

    TetMesh mesh_;
    std::vector<Part> parts_;
};

}  // namespace elastolab
