#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

namespace elastolab {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// How constrained vertices become constrained nodes of a method.
struct ConstrainedNodes {
    std::vector<int> nodes;
    SparseRows prescribe;  ///< 3*nodes.size() x 3*n_constrained_vertices: prescribed displacement of each node
};

/// Collects weights of 3 x 3 unit blocks.
class BlockWeights {
public:
    void add(int row, int column, double weight) {
        for (int axis = 0; axis < 3; ++axis) entries_.emplace_back(3 * row + axis, 3 * column + axis, weight);
    }
    /// 3*n_rows x 3*n_columns; weights of one block add up.
    SparseRows build(Eigen::Index n_rows, Eigen::Index n_columns) const;

private:
    std::vector<Eigen::Triplet<double>> entries_;
};

/// The constrained vertices in the order of all that is prescribed: fixed set, then handles.
std::vector<int> joined(std::span<const int> fixed, std::span<const int> handles);

/// Every constrained vertex is a node.
ConstrainedNodes constrain_vertices(std::span<const int> vertices);

}  // namespace elastolab
