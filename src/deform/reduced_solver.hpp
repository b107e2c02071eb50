#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/control.hpp"
#include "base/lapack.hpp"
#include "deform/columns.hpp"
#include "deform/node_solver.hpp"

namespace elastolab {

/// The compliance columns W of a solid for the unknown loads of one constrained set, and F, their border rows; and its
/// compliance columns of loads that are given (UnitLoad), of which a factor is known.
class ComplianceColumns {
public:
    virtual ~ComplianceColumns() = default;

    /// Number of unknown loads.
    virtual Eigen::Index cols() const = 0;
    /// Number of given loads.
    virtual Eigen::Index n_given() const { return 0; }
    /// The capacitance system, unknown loads first, then border values, then given loads (which are columns beside the
    /// square matrix of the others): prescribed displacements at `nodes`, the border rows, and the rows that close the
    /// ansatz. rigid: E over J. May throw Cancelled.
    virtual Eigen::MatrixXd capacitance_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                               Control& control) const = 0;
    /// displacements += W_u * loads, unknown ones, then given ones; seconds where the compliance columns are not kept.
    /// May throw Cancelled.
    virtual void add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements,
                             Control& control) const = 0;
};

/// ComplianceColumns that are all in memory, as many as prescribed displacements.
class KeptComplianceColumns : public ComplianceColumns {
public:
    /// columns, given  W over F: (3*n_nodes + n_border) x n_unknown_loads, x n_given_loads
    explicit KeptComplianceColumns(Columns columns, Columns given = {})
        : columns_(std::move(columns)), given_(std::move(given)) {}

    Eigen::Index cols() const override { return columns_.cols(); }
    Eigen::Index n_given() const override { return given_.cols(); }
    Eigen::MatrixXd capacitance_matrix(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid,
                                       Control& control) const override;
    void add_product(const Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> displacements, Control&) const override {
        columns_.add_product(loads.topRows(cols()), displacements);
        given_.add_product(loads.bottomRows(n_given()), displacements);
    }

private:
    Columns columns_, given_;
};

/// The capacitance system of docs/formulation.md section 2: with W the compliance columns of unit loads, [E; J] the
/// response to unit border values c and F the border rows of W,
///     u = W_u q + E c,    u at the constrained nodes prescribed,    F q + J c = 0,    closing rows [q; c] = 0,
/// where q are the unknown loads and the given ones.
struct ReducedSystem {
    std::shared_ptr<const ComplianceColumns> compliance_columns;
    Eigen::MatrixXd rigid;     ///< E over J: (3*n_nodes + n_border) x n_border
    std::vector<int> nodes;    ///< constrained nodes
    Eigen::Index n_loads = 0;  ///< of the unknowns, loads come first; the others are residuals of dropped rows
};

/// Eqn. (9'), the collapsed form of the paper's Eqn. 9. One factorisation of the capacitance system; a solve costs its
/// substitution and one product with W.
class ReducedSolver : public NodeSolver {
public:
    ReducedSolver(ReducedSystem system, Control& control);
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override;
    NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                               Control& control) const override;

private:
    /// Solution of the capacitance system for these right sides.
    Eigen::MatrixXd unknowns(Eigen::MatrixXd right) const;
    /// Displacements of all nodes for these unknowns and factors of the given loads.
    Eigen::MatrixXd displacements(const Eigen::MatrixXd& unknowns, const Eigen::MatrixXd& factors,
                                  Control& control) const;
    /// The capacitance system as the solution needs it: its columns scaled, those of the given loads moved out.
    Eigen::MatrixXd scaled_matrix(Control& control);

    ReducedSystem system_;
    Eigen::VectorXd scale_;  ///< columns of the capacitance system are divided by these
    Eigen::MatrixXd given_;  ///< columns of the given loads in the capacitance system
    LuFactorization lu_;
    Eigen::MatrixXd deficient_;  ///< the capacitance system itself, kept only when it is rank-deficient
};

/// Rows of [E; J] at the nodes, then its border rows: the columns of the border values in the capacitance system.
Eigen::MatrixXd border_columns(const std::vector<int>& nodes, const Eigen::MatrixXd& rigid);

/// u at the constrained nodes <- what was prescribed, which it equals but for rounding.
void set_prescribed(const std::vector<int>& nodes, const Eigen::MatrixXd& prescribed, Eigen::MatrixXd& displacements);

}  // namespace elastolab
