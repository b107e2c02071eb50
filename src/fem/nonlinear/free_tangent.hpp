#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/control.hpp"
#include "fem/nonlinear/elements.hpp"
#include "fem/sparse_cholesky.hpp"
#include "fem/sparse_matrix.hpp"

namespace elastolab {

/// The tangent stiffness of the nodes that a constrained set leaves free: its pattern, and the symbolic factorisation,
/// made once for the set. Immutable; any thread may use it.
class FreeTangent {
public:
    /// constrained: nodes, all different
    FreeTangent(std::shared_ptr<const FiniteElements> elements, std::span<const int> constrained, Control& control);

    const FiniteElements& elements() const { return *elements_; }
    /// Free nodes, ascending.
    const std::vector<int>& nodes() const { return free_; }
    int size() const { return 3 * static_cast<int>(free_.size()); }
    const CholeskyAnalysis& analysis() const { return *analysis_; }
    /// A matrix of this pattern: the blocks of a node with itself and with later ones, so that its lower triangle is
    /// there.
    SparseMatrix make_matrix() const { return pattern_; }
    /// K <- sum of work.stiffness, in parallel; nothing is allocated. shift: added to the diagonal.
    void assemble(const ElementWork& work, double shift, SparseMatrix& K, Control& control) const;

    /// The sum over all elements of `entry`(element, a, b), one number for each pair of free nodes; lower triangle.
    SparseMatrix node_matrix(const std::function<double(int element, int a, int b)>& entry) const;

    /// Rows of the free nodes out of those of all, and back (zero elsewhere).
    Eigen::MatrixXd free_rows(const Eigen::MatrixXd& all) const;
    Eigen::MatrixXd all_rows(const Eigen::MatrixXd& free) const;

private:
    void find_pattern();

    std::shared_ptr<const FiniteElements> elements_;
    std::vector<int> free_, place_;  ///< place_: of a node among the free ones, or -1
    SparseMatrix pattern_, node_pattern_;
    std::vector<int> row_;  ///< for element e, column node b, row node a: first row of the block in b's columns, or -1
    std::unique_ptr<const CholeskyAnalysis> analysis_;
};

/// Factorises a matrix of this pattern; nothing when it is not positive definite. Throws SolveError, Cancelled.
std::optional<SparseCholesky> factorised(const FreeTangent& tangent, const SparseMatrix& K, Control& control);

}  // namespace elastolab
