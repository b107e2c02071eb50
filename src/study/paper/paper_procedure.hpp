#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "deform/dense_solvers.hpp"
#include "deform/model.hpp"

namespace elastolab {

/// K and its bordered inverse, dense, over all nodes of the method: what the paper precomputes. Linear BEM has its
/// continuous tractions, FEM its interior nodes.
struct PaperSystem {
    std::shared_ptr<const DenseOperators> operators;
    bool symmetric = false;  ///< K is, but for rounding
    double seconds = 0.0;    ///< of the whole precomputation, beginning with the surface

    int n_nodes() const { return static_cast<int>(operators->K.rows() / 3); }
};
PaperSystem paper_precomputation(const Body& body, MethodKind kind, Control& control);

/// One way to get displacements after the set of known nodes has changed.
///   inverse   without Eqn. 9: K00 inverted afresh, by Cholesky where it is symmetric
///   eqn9      K00^-1 by Eqn. 9 as it is written
///   direct    K00 factorised afresh, not inverted
///   reduced   the collapsed form (9')
struct PaperUpdate {
    std::string name;
    double set_change_seconds = 0.0;
    double frame_seconds = 0.0;  ///< new known displacements, same set
    Eigen::VectorXd displacements;
};
/// All four for these known nodes and some smooth values at them.
std::vector<PaperUpdate> paper_updates(const PaperSystem& system, const std::vector<int>& known);

}  // namespace elastolab
