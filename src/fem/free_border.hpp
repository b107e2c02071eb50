#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "deform/reduced_solver.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Borders the compliance columns of a free body (docs/formulation.md section 2): displacements whose surface moves by
/// no rigid motion, over what the forces lack of balance. That is taken by forces R c on the surface.
class FreeBorder {
public:
    /// positions  of all nodes, those of the surface first
    /// R          orthonormal rigid motions of the surface, 3*n_surface x 6; or, of a body that is held, 3*n_surface x
    ///            0: then forces are as they are, and nothing borders the compliance columns
    FreeBorder(const Positions& positions, Eigen::MatrixXd R);

    /// The motions of all nodes that are R on the surface.
    const Eigen::MatrixXd& motions() const { return motions_; }
    /// Takes from forces at all nodes what they lack of balance, and returns it: c, 6 x m.
    Eigen::MatrixXd balance(Eigen::MatrixXd& forces) const;
    /// Takes from displacements of all nodes, or of the first ones, the rigid motion of the surface.
    void remove_motion(Eigen::MatrixXd& displacements) const;

    /// Displacements of balanced forces at all nodes, up to a rigid motion: of all nodes, or of the first ones.
    using Solve = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& forces)>;
    /// Compliance columns for forces at all nodes, over c: (3*n_nodes + 6) x m for the nodes that `solve` is of.
    Eigen::MatrixXd compliance_columns(Eigen::MatrixXd forces, const Solve& solve) const;

private:
    Eigen::MatrixXd on_surface_, motions_;
};

/// The capacitance system of a set whose compliance columns are bordered like this. motions: of the nodes that the
/// compliance columns are of (or none).
ReducedSystem bordered_system(std::shared_ptr<const ComplianceColumns> compliance_columns,
                              const Eigen::MatrixXd& motions, std::vector<int> nodes);

}  // namespace elastolab
