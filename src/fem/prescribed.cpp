#include "fem/prescribed.hpp"

#include <cassert>

#include "fem/constraints.hpp"

namespace elastolab {

PrescribedSolution solve_prescribed(const SparseMatrix& K, const CholeskyAnalysis& analysis, std::span<const int> nodes,
                                    const Eigen::MatrixXd& values, Control& control, const Eigen::MatrixXd& given) {
    assert(values.rows() == 3 * std::ssize(nodes));
    constexpr Eigen::Index kBlock = 128;
    control.checkpoint();
    const SparseCholesky factor(analysis, eliminated(K, nodes), "stiffness matrix of the free nodes", &control);
    PrescribedSolution solution;
    solution.reciprocal_condition = factor.reciprocal_condition();
    solution.displacements.setZero(K.rows(), values.cols());
    solution.forces.resize(values.rows(), values.cols());
    const auto for_each_node = [&](const auto& use) {
        for (std::size_t k = 0; k < nodes.size(); ++k) use(3 * nodes[k], 3 * static_cast<Eigen::Index>(k));
    };
    for (Eigen::Index begin = 0; begin < values.cols(); begin += kBlock) {
        control.checkpoint();
        const Eigen::Index count = std::min(kBlock, values.cols() - begin);
        Eigen::Ref<Eigen::MatrixXd> u = solution.displacements.middleCols(begin, count);
        const auto u_c = values.middleCols(begin, count);
        for_each_node([&](int row, Eigen::Index k) { u.middleRows<3>(row) = u_c.middleRows<3>(k); });
        Eigen::MatrixXd load = -(K * u);
        if (given.size() > 0) load += given.middleCols(begin, count);
        for_each_node([&](int row, Eigen::Index) { load.middleRows<3>(row).setZero(); });
        u += factor.solve(load);  // zero at the prescribed nodes, exactly
        Eigen::MatrixXd f = K * u;
        if (given.size() > 0) f -= given.middleCols(begin, count);
        for_each_node(
            [&](int row, Eigen::Index k) { solution.forces.block(k, begin, 3, count) = f.middleRows<3>(row); });
    }
    return solution;
}

}  // namespace elastolab
