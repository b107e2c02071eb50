#include "fem/prescribed.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "base/lapack.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/fem_body.hpp"

namespace elastolab {
namespace {

using test::FemBody;
using test::relative_error;

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& u, const std::vector<int>& nodes) {
    Eigen::MatrixXd rows(3 * std::ssize(nodes), u.cols());
    for (std::size_t k = 0; k < nodes.size(); ++k)
        rows.middleRows<3>(3 * static_cast<Eigen::Index>(k)) = u.middleRows<3>(3 * nodes[k]);
    return rows;
}

std::vector<int> both_ends(const FemBody& body, double length) {
    std::vector<int> nodes = body.face(0, 0.0);
    const std::vector<int> end = body.face(0, length);
    nodes.insert(nodes.end(), end.begin(), end.end());
    return nodes;
}

TEST(Prescribed, StretchesABoxExactly) {
    for (double nu : {0.3, 0.4999}) {
        const FemBody body({6, 4, 3}, {2.0, 1.0, 0.8}, nu);
        const std::vector<int> ends = both_ends(body, 2.0);
        const Positions exact = Eigen::Vector3d(1.0, -nu, -nu).asDiagonal() * body.mesh.vertices;
        Control control;
        const PrescribedSolution solution =
            solve_prescribed(body.K, body.analysis, ends, rows_of(exact.reshaped(), ends), control);
        EXPECT_LT(relative_error(solution.displacements, exact.reshaped()), 1e-12) << "nu = " << nu;
        // E * strain * area pulls at the far end: 2 * 1 * 0.8.
        double pull = 0.0;
        for (std::size_t k = 0; k < ends.size(); ++k)
            if (body.mesh.vertices(0, ends[k]) > 1.0) pull += solution.forces(3 * static_cast<Eigen::Index>(k), 0);
        EXPECT_NEAR(pull, 2.0 * 1.0 * 0.8, 1e-11);
    }
}

TEST(Prescribed, RotatesAsAWhole) {
    const FemBody body({4, 4, 3});
    const std::vector<int> fixed = body.face(2, 0.0);
    const Eigen::VectorXd exact = rigid_motion(body.mesh.vertices, {0.1, -0.2, 0.3}, {1.0, 2.0, -0.5});
    Control control;
    const PrescribedSolution solution = solve_prescribed(body.K, body.analysis, fixed, rows_of(exact, fixed), control);
    EXPECT_LT(relative_error(solution.displacements, exact), 1e-12);
    EXPECT_LT(solution.forces.cwiseAbs().maxCoeff(), 1e-11);
}

TEST(Prescribed, AgreesWithADenseSolveForManyColumns) {
    const FemBody body({4, 3, 3});
    const std::vector<int> nodes = {0, 5, 20, 33, 41};
    const Eigen::MatrixXd values = Eigen::MatrixXd::Random(15, 4);
    Control control;
    const PrescribedSolution solution = solve_prescribed(body.K, body.analysis, nodes, values, control);
    // Lagrange multipliers, dense.
    const Eigen::MatrixXd K(body.K);
    const Eigen::Index n = K.rows(), m = values.rows();
    Eigen::MatrixXd pick = Eigen::MatrixXd::Zero(n, m);
    for (std::size_t k = 0; k < nodes.size(); ++k)
        pick.block<3, 3>(3 * nodes[k], 3 * static_cast<Eigen::Index>(k)).setIdentity();
    Eigen::MatrixXd system(n + m, n + m), load = Eigen::MatrixXd::Zero(n + m, 4);
    system << K, pick, pick.transpose(), Eigen::MatrixXd::Zero(m, m);
    load.bottomRows(m) = values;
    const Eigen::MatrixXd expected = LuFactorization(std::move(system), "bordered stiffness").solve(load);
    EXPECT_LT(relative_error(solution.displacements, expected.topRows(n)), 1e-10);
    EXPECT_LT(relative_error(solution.forces, -expected.bottomRows(m)), 1e-10);
    EXPECT_EQ(rows_of(solution.displacements, nodes), values);
}

}  // namespace
}  // namespace elastolab
