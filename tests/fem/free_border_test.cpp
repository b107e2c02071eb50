#include "fem/free_border.hpp"

#include <gtest/gtest.h>

#include "elasticity/rigid_motion.hpp"
#include "fem/constraints.hpp"
#include "fem/fem_body.hpp"

namespace elastolab {
namespace {

using test::FemBody;
using test::relative_error;

constexpr double kOfSolve = 1e-10;  // as in compliance_test.cpp

TEST(FreeBorder, ResponsesAreEquilibriaWhoseSurfaceMovesByNoRigidMotion) {
    const FemBody body({4, 3, 3});
    const Positions& positions = body.mesh.vertices;
    const Eigen::Index n = 3 * body.n_surface();
    const Eigen::MatrixXd R = rigid_modes(positions.leftCols(body.n_surface()));
    const FreeBorder border(positions, R);
    const SparseCholesky factor(body.analysis, grounded(body.K, positions, choose_support(positions, body.n_surface())),
                                "stiffness matrix");
    std::srand(3);
    const Eigen::MatrixXd forces = Eigen::MatrixXd::Random(positions.size(), 2);  // of no balance

    const Eigen::MatrixXd compliance_columns =
        border.compliance_columns(forces, [&](const Eigen::MatrixXd& f) { return factor.solve(f); });

    const Eigen::MatrixXd u = compliance_columns.topRows(positions.size()), c = compliance_columns.bottomRows<6>();
    Eigen::MatrixXd held = body.K * u;
    held.topRows(n) += R * c;
    EXPECT_LT(relative_error(held, forces), kOfSolve);
    EXPECT_LT((R.transpose() * u.topRows(n)).norm(), kOfSolve * u.norm());
    EXPECT_LT((rigid_modes(positions).transpose() * (body.K * u)).norm(), kOfSolve * forces.norm());

    const Eigen::MatrixXd of_surface =
        border.compliance_columns(forces, [&](const Eigen::MatrixXd& f) { return factor.solve(f).topRows(n).eval(); });
    EXPECT_LT(relative_error(of_surface.topRows(n), u.topRows(n)), kOfSolve);
}

TEST(FreeBorder, OfAHeldBodyChangesNothing) {
    const FemBody body({2, 2, 2});
    const FreeBorder border(body.mesh.vertices, Eigen::MatrixXd(3 * body.n_surface(), 0));
    const Eigen::MatrixXd forces = Eigen::MatrixXd::Random(body.mesh.vertices.size(), 2);
    EXPECT_EQ(border.compliance_columns(forces, [](const Eigen::MatrixXd& f) { return f; }), forces);
}

}  // namespace
}  // namespace elastolab
