#include "fem/held_nodes.hpp"

#include "deform/node_rows.hpp"

namespace elastolab {

NodeSolution solve_held(const HeldStiffness& K, const std::vector<int>& nodes, const Eigen::MatrixXd& given,
                        const Eigen::MatrixXd& prescribed, bool want_loads) {
    const Eigen::MatrixXd loads = given * prescribed.bottomRows(given.cols());
    NodeSolution solution;
    solution.displacements = Eigen::MatrixXd::Zero(given.rows(), prescribed.cols());
    put_rows(prescribed, nodes, solution.displacements);
    Eigen::MatrixXd right = loads - K.multiply(solution.displacements);
    clear_rows(nodes, right);
    solution.displacements += K.solve(right);
    if (want_loads) solution.loads = rows_of(K.multiply(solution.displacements) - loads, nodes);
    return solution;
}

double force_residual(const Eigen::VectorXd& products, const Eigen::VectorXd& sizes, std::span<const int> nodes,
                      const Eigen::MatrixXd& forces, const Eigen::VectorXd& given) {
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(products.size(), 1);
    put_rows(forces, nodes, f);
    const double size = (sizes + f.col(0).cwiseAbs() + given.cwiseAbs()).norm();
    return size > 0.0 ? (products - f.col(0) - given).norm() / size : 0.0;
}

}  // namespace elastolab
