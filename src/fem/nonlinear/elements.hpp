#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "deform/element_degree.hpp"
#include "elasticity/material.hpp"
#include "fem/nonlinear/element_kernels.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// An element and the place of a node in it.
struct ElementCorner {
    int element = 0, local = 0;
};

/// Buffers of an evaluation, made once and used again: no assembly allocates.
struct ElementWork {
    std::vector<double> forces;     ///< of every element, n x 3
    std::vector<double> stiffness;  ///< of every element, n (n + 1) / 2 blocks of 9, column by column; see PackResult
    std::vector<double> energies, least_J;
};

/// Energy of a state.
struct BodyEnergy {
    double energy = 0.0;   ///< [force * L]; infinite where an element is inverted
    double least_J = 1.0;  ///< smallest ratio of volumes after and before
    int element = -1;      ///< where
};

/// Neo-Hookean tetrahedra with straight edges at rest. All functions run on all threads, with the same result for every
/// number of them. Displacements u are 3*n_nodes, node-major [L].
class FiniteElements {
public:
    /// elements: nodes of each, 4 or 10 rows (corners, then midpoints by kTetEdges), positively oriented.
    /// Throws MeshError when a tetrahedron has no positive volume.
    FiniteElements(const Positions& positions, Eigen::MatrixXi elements);

    int n_nodes() const { return static_cast<int>(positions_.cols()); }
    int n_elements() const { return static_cast<int>(elements_.cols()); }
    int nodes_per_element() const { return static_cast<int>(elements_.rows()); }
    ElementDegree degree() const { return elements_.rows() == 4 ? ElementDegree::linear : ElementDegree::quadratic; }
    const Positions& positions() const { return positions_; }
    const Eigen::MatrixXi& elements() const { return elements_; }
    /// Elements around a node, ascending.
    std::span<const ElementCorner> around(int node) const;
    /// Typical length of an edge.
    double edge() const { return edge_; }

    /// with_stiffness: for stiffness(), which takes far more than the rest.
    ElementWork make_work(bool with_stiffness = true) const;
    BodyEnergy energy(const Eigen::VectorXd& u, const Material& material, ElementWork& work, Control& control) const;
    /// Gradient of the energy: the force on the body at every node that u takes. Needs J > 0.
    Eigen::VectorXd forces(const Eigen::VectorXd& u, const Material& material, ElementWork& work,
                           Control& control) const;
    /// Change of the forces with u along `change`, to first order.
    Eigen::VectorXd force_change(const Eigen::VectorXd& u, const Eigen::VectorXd& change, const Material& material,
                                 ElementWork& work, Control& control) const;
    /// Fills work.stiffness and work.forces; projected: by NeoHookean::projected_tangent.
    void stiffness(const Eigen::VectorXd& u, const Material& material, bool projected, ElementWork& work,
                   Control& control) const;
    /// Sum of work.forces over the elements of each node.
    Eigen::VectorXd gathered(const ElementWork& work, Control& control) const;

    int n_points() const { return nodes_per_element() == 4 ? 1 : 4; }
    /// Gradients of the shape functions of an element at a Gauss point, n x 3 [1/L].
    using ShapeGradients = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 10>;
    ShapeGradients shape_gradients(int element, int point) const;
    /// Displacement gradient there.
    Eigen::Matrix3d gradient(const Eigen::VectorXd& u, int element, int point) const {
        return gradient(u, element, shape_gradients(element, point));
    }
    Eigen::Matrix3d gradient(const Eigen::VectorXd& u, int element, const ShapeGradients& shapes) const;
    /// The largest ratio of a length after and before, at any Gauss point; at least 1.
    double largest_stretch(const Eigen::VectorXd& u, Control& control) const;
    double volume(int element) const;

private:
    void evaluate(int pack, const double* u, const Material& material, const PackResult& result) const;
    template <class Use>
    void for_each_pack(Control& control, const Use& use) const;
    void gather(int pack, const Eigen::VectorXd& u, double* packed) const;
    int element_of(int pack, int lane) const { return pack * kPack + lane; }
    void project(int element, const Eigen::VectorXd& u, const Material& material, double* blocks) const;

    Positions positions_;
    Eigen::MatrixXi elements_;
    std::vector<ElementPack> packs_;
    std::vector<int> first_around_;
    std::vector<ElementCorner> around_;
    double edge_ = 1.0;
};

/// Nodes of one element times 3.
inline constexpr int kMostElementNumbers = 30;
/// Blocks (a, b), b <= a.
inline int block_count(int n_nodes) { return n_nodes * (n_nodes + 1) / 2; }
inline int block_index(int a, int b) { return a * (a + 1) / 2 + b; }

}  // namespace elastolab
