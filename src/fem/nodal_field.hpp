#pragma once

#include <Eigen/Core>
#include <memory>

#include "deform/interior_field.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The inside of a solid of unit Young's modulus out of the displacements of all nodes. Both displacements and stresses
/// are linear in each tetrahedron; a node's stress is that of a linear fit to the tetrahedra around it (patch recovery,
/// O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Methods Eng. 33, 1992), so that it is continuous and better than that
/// of a tetrahedron. Quadratic elements are taken as split in eight on their nodes.
class NodalField : public InteriorField {
public:
    /// displacements: 3*n_nodes x m [L], nodes are the vertices of `tets`;  poisson_ratio < 1/2
    NodalField(std::shared_ptr<const TetMesh> tets, double poisson_ratio, Eigen::MatrixXd displacements);

    InteriorValues at(const Positions& points, Control& control) const override;

private:
    struct Place {
        int tetrahedron = 0;
        Eigen::Vector4d weights = Eigen::Vector4d::Zero();  ///< of its corners, not negative, adding up to 1
    };
    Place place_of(const Eigen::Vector3d& point) const;

    std::shared_ptr<const TetMesh> tets_;
    Eigen::MatrixXd displacements_;  ///< 3*n_nodes x m
    double edge_;                    ///< a typical one [L]
    Eigen::MatrixXd stresses_;       ///< 6*n_nodes x m
    BoxTree boxes_;
};

}  // namespace elastolab
