#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "deform/interior.hpp"
#include "deform/model.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The inside of a body, for methods that have one: all solids in one mesh.
class Volume {
public:
    /// Null when the method of the model has nodes on the surface only. Throws SolveError, Cancelled.
    static std::shared_ptr<const Volume> of(const std::shared_ptr<const Model>& model, Control& control);

    /// The vertices of the body first, in their order, then those inside; elements of second degree are split in eight.
    const TetMesh& mesh() const { return mesh_; }
    /// The elements on these vertices: 4 x n, or 10 x n as in TenNodeElements.
    const Eigen::MatrixXi& elements() const { return elements_; }

    /// Displacements of all vertices of mesh(), 3*n [L], from those of the body's, 3*n_vertices; nodes inside, and
    /// midpoints on the surface, bear no load. Those of a solution are in Deformer::interior_field.
    Eigen::VectorXd displace(const Eigen::VectorXd& surface) const;

    /// The stress in the middle of each element, 6 x n [force / L^2], for displacements of all vertices, 3 x n [L]: in
    /// an element of first degree the stress everywhere, else (by Hooke's law) its mean. With large deformations the
    /// Cauchy stress of the neo-Hookean material.
    Eigen::MatrixXd element_stresses(const Eigen::Matrix3Xd& u, const Material& material,
                                     bool large_deformations) const;

private:
    struct Part {
        std::vector<int> vertices;  ///< in mesh(), for each node of the solid
        int n_surface = 0;
        double unit = 1.0;  ///< displacements in the solid over those in the body
        std::shared_ptr<const Interior> interior;
    };
    Volume() = default;

    TetMesh mesh_;
    Eigen::MatrixXi elements_;
    std::vector<Part> parts_;
};

}  // namespace elastolab
