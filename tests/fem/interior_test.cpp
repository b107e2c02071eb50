#include "fem/interior.hpp"

#include <gtest/gtest.h>

#include "fem/assembly.hpp"
#include "support/tet_box.hpp"

namespace elastolab {
namespace {

TEST(FemInterior, ALinearFieldOnTheSurfaceGoesOnInside) {
    Control control;
    const TetMesh box = test::make_tet_box({3, 4, 3}, {1, 1.2, 0.8}, 0.15);
    const SparseMatrix K = stiffness(assemble_stiffness_parts(box, control), {1.0, 0.3});
    const Eigen::Matrix3d gradient = (Eigen::Matrix3d() << 0.1, 0.2, 0, -0.1, 0.3, 0.05, 0, 0.4, -0.2).finished();
    const Eigen::Matrix3Xd u = gradient * box.vertices;
    const FemInterior interior(K, box.n_surface_vertices, control);
    const Eigen::VectorXd all = Eigen::Map<const Eigen::VectorXd>(u.data(), u.size());
    ASSERT_GT(box.n_vertices(), box.n_surface_vertices);
    EXPECT_LT((interior.extend(all.head(3 * box.n_surface_vertices)) - all).norm(), 1e-12 * all.norm());
}

}  // namespace
}  // namespace elastolab
