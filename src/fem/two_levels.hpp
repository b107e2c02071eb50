#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "deform/iteration.hpp"
#include "fem/quadratic_mesh.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// Quadratic elements, and a space inside theirs whose nodes are the corners of their tetrahedra: what second answers
/// of finite elements are computed by, without a factor or a matrix of all nodes.
class TwoLevels {
public:
    /// mesh: kept. prolongation: from the coarse nodes, in the order of the corners, to all. prescribed: nodes of the
    /// mesh.
    TwoLevels(const QuadraticMesh& mesh, const SparseMatrix& prolongation, std::span<const int> prescribed);

    const SparseMatrix& prolongation() const { return prolongation_; }
    /// Zero at the prescribed nodes, else these values.
    Eigen::VectorXd free_part(Eigen::VectorXd all) const;

    using Product = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
    struct Operators {
        Product stiffness;                             ///< forces for displacements of all nodes
        Product solve_coarse;                          ///< by the stiffness of the coarse nodes, prescribed ones zero
        std::function<Eigen::Matrix3d(int)> diagonal;  ///< block of a node on the diagonal of the stiffness
        bool symmetric = true;
    };
    /// Of GMRES: it keeps twice as many vectors.
    static constexpr int kBasis = 30;
    /// Displacements at the free nodes that give these forces there, by conjugate gradients, which both levels
    /// precondition: the coarse stiffness, and the diagonal blocks of the nodes that it does not have. They end when
    /// the energy norm of the error has fallen to `enough` of what it was. Where the stiffness is not symmetric, by
    /// GMRES, until the residual has fallen to a tenth of that; where it
    /// does not, this throws SolveError. Throws Cancelled.
    Eigen::VectorXd solve(const Operators& apply, const Eigen::VectorXd& forces, double enough, Control& control,
                          IterationReport* report = nullptr) const;

private:
    class FreeStiffness;
    class Preconditioner;

    SparseMatrix prolongation_;
    std::vector<char> is_prescribed_, is_midpoint_;
};

/// Linear elements inside quadratic ones on the same tetrahedra: a midpoint is the mean of its ends.
SparseMatrix from_corners(const QuadraticMesh& mesh);

}  // namespace elastolab
