#include "fem/condensation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "elasticity/rigid_motion.hpp"
#include "fem/fem_body.hpp"

namespace elastolab {
namespace {

using test::FemBody;
using test::relative_error;

TEST(Condensation, IsTheDenseSchurComplement) {
    Control control;
    for (const Eigen::Vector3i& cells : {Eigen::Vector3i(1, 1, 1), Eigen::Vector3i(3, 2, 2), Eigen::Vector3i(6, 5, 7)})
        for (double nu : {0.3, 0.4999}) {
            const FemBody body(cells, {1.0, 1.2, 0.8}, nu);
            const Eigen::MatrixXd S = condense_to_surface(body.K, body.n_surface(), control);
            EXPECT_LT(relative_error(S, test::dense_condensed(body)), 1e-10) << cells.transpose() << ", nu = " << nu;
            EXPECT_EQ((S - S.transpose()).norm(), 0.0);
        }
}

TEST(Condensation, KeepsTheRigidNullModes) {
    const FemBody body({7, 7, 7});
    Control control;
    const Eigen::MatrixXd S = condense_to_surface(body.K, body.n_surface(), control);
    const Eigen::MatrixXd R = rigid_modes(body.mesh.vertices.leftCols(body.n_surface()));
    EXPECT_LT((S * R).cwiseAbs().maxCoeff(), 1e-12 * S.cwiseAbs().maxCoeff());
}

TEST(Condensation, StopsWhenCancelled) {
    const FemBody body({3, 3, 3});
    Control control;
    control.cancel();
    EXPECT_THROW(condense_to_surface(body.K, body.n_surface(), control), Cancelled);
}

}  // namespace
}  // namespace elastolab
