#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "deform/unit_load.hpp"
#include "fem/nonlinear/elements.hpp"

namespace elastolab {

/// A triangle of the surface with the nodes of its element, three or six, under a pressure.
struct PressedFace {
    int load = 0;
    double pressure = 1.0;  ///< for a factor of one [force / L^2]
    int element = 0;
    std::vector<int> nodes;  ///< corners, seen from outside counter-clockwise; then midpoints of 0-1, 1-2, 2-0
    std::vector<int> local;  ///< their places in the element
};

/// Loads on a body under large deformations. Body forces, tractions and total forces are dead: nodal forces of constant
/// size and direction. A pressure follows the surface (UnitLoad::follows): -p n on its present area, where the forces
/// at the nodes are -p int N_a (x_xi cross x_eta) over each triangle, exactly integrated (docs/formulation.md section
/// 12). Factors: one for each load; displacements u: 3*n_nodes, node-major [L].
class NonlinearLoads {
public:
    /// None.
    NonlinearLoads() = default;
    /// surface: triangles in the order by which the loads number them; midpoints: nodes between their vertices 0 and 1,
    /// 1 and 2, 2 and 0, of ten-node elements, else none.
    NonlinearLoads(std::shared_ptr<const FiniteElements> elements, const Triangles& surface, const Triangles& midpoints,
                   std::span<const UnitLoad> loads);

    int size() const { return static_cast<int>(dead_.cols()); }
    Eigen::VectorXd none() const { return Eigen::VectorXd::Zero(size()); }
    /// Whether some load follows the surface, so that forces depend on u.
    bool follow() const { return !faces_.empty(); }

    /// Forces on the nodes of the loads that do not follow the surface, 3*n_nodes.
    Eigen::VectorXd dead_forces(const Eigen::VectorXd& factors) const { return dead_ * factors; }
    /// Forces on the nodes, 3*n_nodes.
    Eigen::VectorXd forces(const Eigen::VectorXd& u, const Eigen::VectorXd& factors) const;
    /// Their change with u along `motion` and with the factors, to first order.
    Eigen::VectorXd force_change(const Eigen::VectorXd& u, const Eigen::VectorXd& factors,
                                 const Eigen::VectorXd& motion, const Eigen::VectorXd& factor_change) const;
    /// Subtracts the symmetric part of d forces / d u from work.stiffness. The rest of it is zero but where the rim of
    /// a pressed part is free to move.
    void add_tangent(const Eigen::VectorXd& u, const Eigen::VectorXd& factors, ElementWork& work) const;
    /// Work that the loads do while u changes by `motion` along a straight way [force * L].
    double work(const Eigen::VectorXd& u, const Eigen::VectorXd& motion, const Eigen::VectorXd& factors) const;
    /// Force over moment about the origin of each load, at present positions: 6 x size().
    Eigen::MatrixXd resultants(const Eigen::VectorXd& u, const Eigen::VectorXd& factors) const;

private:
    void press(const PressedFace& face, const Eigen::VectorXd& u, double factor, Eigen::VectorXd& forces) const;
    Eigen::Matrix3Xd positions_of(const PressedFace& face, const Eigen::VectorXd& u) const;

    std::shared_ptr<const FiniteElements> elements_;
    Eigen::MatrixXd dead_;  ///< 3*n_nodes x size(), zero for those that follow
    std::vector<PressedFace> faces_;
};

}  // namespace elastolab
