#pragma once

#include <Eigen/Core>
#include <memory>

#include "deform/element_degree.hpp"
#include "deform/interior_field.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The inside of a solid of unit Young's modulus from the displacements of all nodes. In each element displacements and
/// stresses interpolate values at the nodes with the element's degree, and so are continuous. A node's stress is, with
/// linear elements, that of a linear fit to the tetrahedra around it (patch recovery, O. C. Zienkiewicz, J. Z. Zhu,
/// Int. J. Numer. Methods Eng. 33, 1992); with quadratic ones the mean of the stresses that the elements around it have
/// there, weighted by volume.
class NodalField : public InteriorField {
public:
    /// tets           their vertices are the nodes; quadratic elements are split in eight (QuadraticMesh::split)
    /// displacements  3*n_nodes x m [L];  poisson_ratio < 1/2
    /// large_deformations  Cauchy stresses of the neo-Hookean material, not Hooke's
    NodalField(std::shared_ptr<const TetMesh> tets, ElementDegree degree, double poisson_ratio,
               Eigen::MatrixXd displacements, bool large_deformations = false);

    InteriorValues at(const Positions& points, Control& control) const override;

private:
    struct Place {
        int tetrahedron = -1;
        Eigen::Vector4d weights = Eigen::Vector4d::Zero();  ///< of its corners, not negative, adding up to 1
    };
    Place place_of(const Eigen::Vector3d& point) const;

    /// Calls each(node, weight) for the nodes whose values make up the value at a place.
    template <class Each>
    void for_each_node(const Place& place, const Each& each) const;

    std::shared_ptr<const TetMesh> tets_;
    Eigen::Matrix<int, 10, Eigen::Dynamic> elements_;  ///< of second degree, eight tetrahedra each; else none
    Eigen::MatrixXd displacements_;                    ///< 3*n_nodes x m
    double edge_;                                      ///< a typical one [L]
    Eigen::MatrixXd stresses_;                         ///< 6*n_nodes x m
    BoxTree boxes_;
};

}  // namespace elastolab
