#pragma once

#include <Eigen/Core>
#include <memory>

#include "base/control.hpp"
#include "deform/model.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The inside of a body, for methods that have one: all solids in one mesh.
class Volume {
public:
    /// Null when the method of the model has nodes on the surface only. Throws Cancelled.
    static std::shared_ptr<const Volume> of(const std::shared_ptr<const Model>& model, Control& control);

    /// The vertices of the body first, in their order, then those inside; elements of second degree are split in eight.
    const TetMesh& mesh() const { return mesh_; }
    /// The elements on these vertices: 4 x n, or 10 x n, as those of Interior. Displacements of the vertices are in
    /// Deformer::interior_field.
    const Eigen::MatrixXi& elements() const { return elements_; }

    /// The stress in the middle of each element, 6 x n [force / L^2], for displacements of all vertices, 3 x n [L]: in
    /// an element of first degree the stress everywhere, else (by Hooke's law) its mean. With large deformations the
    /// Cauchy stress of the neo-Hookean material.
    Eigen::MatrixXd element_stresses(const Eigen::Matrix3Xd& u, const Material& material,
                                     bool large_deformations) const;

private:
    Volume() = default;

    TetMesh mesh_;
    Eigen::MatrixXi elements_;
};

}  // namespace elastolab
