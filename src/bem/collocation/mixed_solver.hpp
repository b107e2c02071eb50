#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>

#include "base/lapack.hpp"
#include "base/refined_lu.hpp"
#include "bem/collocation/system.hpp"
#include "bem/collocation/traction_space.hpp"
#include "deform/dense_solvers.hpp"
#include "deform/node_solver.hpp"

namespace elastolab {

/// The mixed boundary problem of one constrained set, with the traction coefficients q of a load space:
///     H0 u = G0 q   at the free nodes,      A u = Gp q   at the collocated constrained nodes and the interior points
/// For the traction models whose ansatz depends on the constrained set there is no K that serves all sets; these are
/// the rows from which Eqns. 7 and 9 are formed then. As one matrix for the unknowns (u0, q):
struct MixedProblem {
    Partition partition;
    std::vector<int> at;      ///< nodes of its first rows, three each; interior points follow
    Eigen::MatrixXd unknown;  ///< [H00 -G0; A0 -Gp], square, 3*free + 3*slots
    Eigen::MatrixXd known;    ///< [H01; A1], columns of the prescribed displacements, without those of the fixed set
    Eigen::MatrixXd given;    ///< single layer of the given loads, a column each

    /// The first n_fixed nodes rest. Integrates in strips, so that nothing of the matrix's size is held beside it.
    MixedProblem(const BemSystem& system, const TractionSpace& space, const std::vector<int>& nodes, int n_fixed,
                 std::span<const UnitLoad> loads, Control& control);

    /// For the prescribed displacements of all constrained nodes, over the factors of the given loads.
    Eigen::MatrixXd right_side(const Eigen::MatrixXd& prescribed) const {
        const Eigen::Index m = given.cols();
        Eigen::MatrixXd right = -(known * prescribed.middleRows(prescribed.rows() - m - known.cols(), known.cols()));
        if (m > 0) right.noalias() += given * prescribed.bottomRows(m);
        return right;
    }
};

/// Bytes that a MixedProblem of this many constrained nodes takes while it is made.
std::uint64_t mixed_memory(const BemSystem& system, const TractionSpace& space, int n_constrained, int n_fixed);

/// Eqn. 7 with the tractions kept: the mixed system for free displacements and q, factorised afresh.
class MixedSolver : public NodeSolver {
public:
    MixedSolver(const BemSystem& system, const TractionSpace& space, const std::vector<int>& nodes, int n_fixed,
                std::span<const UnitLoad> loads, Control& control);
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;

private:
    MixedProblem problem_;  ///< its matrix `unknown` is moved into the factorisation
    double traction_scale_ = 1.0;
    RefinedLu lu_;
};

/// Eqn. 9 applied to H: H00^-1 = D'00 - D'01 D'11^-1 D'10, then q from the capacitance system Gp - A0 H00^-1 G0.
class BoundaryEqn9Solver : public NodeSolver {
public:
    BoundaryEqn9Solver(const BemSystem& system, const TractionSpace& space, const std::vector<int>& nodes, int n_fixed,
                       std::span<const UnitLoad> loads, Control& control);
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;

private:
    MixedProblem problem_;
    Eigen::MatrixXd H00_inverse_;
    LuFactorization tractions_;
};

/// Relative residual |H u - G q| / | |H| |u| + |G| |q| |, q with the given tractions, in the Euclidean norm, with
/// integrals computed afresh, over a sample of the collocated equations: those of at least 128 nodes and 128 interior
/// points, evenly spread, or of all.
double boundary_residual(const BemSystem& system, const TractionSpace& space, std::span<const UnitLoad> loads,
                         const NodeSolution& solution, Control& control);

}  // namespace elastolab
