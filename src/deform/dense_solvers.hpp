#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/lapack.hpp"
#include "deform/node_solver.hpp"

namespace elastolab {

/// A stiffness K and its bordered inverse, dense, over n nodes.
struct DenseOperators {
    Eigen::MatrixXd K;        ///< 3n square, T = K U
    Eigen::MatrixXd Khatinv;  ///< inverse of [K B; C^T 0]: [D E; F^T J], (3n + 6) square

    auto D() const { return Khatinv.topLeftCorner(K.rows(), K.cols()); }
};

/// The two parts into which constrained nodes split the degrees of freedom: "0" free, "1" constrained (the paper's U
/// and K).
struct Partition {
    std::vector<Eigen::Index> free, constrained;
    Partition(Eigen::Index n_dofs, const std::vector<int>& nodes);
};

/// Factors (LuFactorization or RefinedLu) of a matrix that is singular when the constraints do not hold the body: then
/// throws NotHeldError.
template <class Factors>
Factors factorise_held(Eigen::MatrixXd&& A, const char* name, Control* control = nullptr) {
    constexpr double kSingular = 1e-14;
    try {
        Factors factors(std::move(A), name, control);
        if (factors.size() > 0 && factors.reciprocal_condition() < kSingular) throw NotHeldError();
        return factors;
    } catch (const SingularMatrixError&) {
        throw NotHeldError();
    }
}

/// K00^-1 by Eqn. 9, D00 - D01 D11^-1 D10, from the inverse of a bordered matrix; the border belongs to part 1.
/// Throws SolveError when D11 is singular: the constraints do not hold the body.
Eigen::MatrixXd inverse_by_eqn9(const Eigen::MatrixXd& bordered_inverse, const Partition& partition);

/// Eqn. 7 afresh: U0 = K00^-1 (G0 - K01 U1), G the given loads, with K00 factorised for this constrained set. Throws
/// SolveError when K00 is singular: the constraints do not hold the body.
class DirectSolver : public NodeSolver {
public:
    /// given: 3n x n_loads, what unit loads add to T
    DirectSolver(std::shared_ptr<const DenseOperators> operators, const std::vector<int>& nodes,
                 Eigen::MatrixXd given = {}, Control* control = nullptr);
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;

private:
    std::shared_ptr<const DenseOperators> operators_;
    Partition partition_;
    Eigen::MatrixXd given_;
    LuFactorization K00_;
};

/// Eqn. 9 as the paper writes it: K00^-1 is formed from D, then U0 = K00^-1 (G0 - K01 U1). The paper prefers it where
/// fewer displacements are known than unknown; make_paper_solver follows that rule.
class Eqn9Solver : public NodeSolver {
public:
    Eqn9Solver(std::shared_ptr<const DenseOperators> operators, const std::vector<int>& nodes,
               Eigen::MatrixXd given = {});
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;

private:
    std::shared_ptr<const DenseOperators> operators_;
    Partition partition_;
    Eigen::MatrixXd given_, K00_inverse_;
};

/// Eqn. 9 where fewer displacements are known than unknown, else Eqn. 7.
std::unique_ptr<NodeSolver> make_paper_solver(std::shared_ptr<const DenseOperators> operators,
                                              const std::vector<int>& nodes, Eigen::MatrixXd given, Control& control);

}  // namespace elastolab
