#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "deform/volume.hpp"
#include "fem/method.hpp"
#include "mesh/checks/check.hpp"
#include "mesh/input/export.hpp"
#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

const Eigen::Vector3d kOffset(1e6, -1e6, 1e6);

/// Small, so that what is computed far away, such as TetGen's points inside, would lose seven digits more.
constexpr double kSize = 0x1p-10;

/// A cube whose coordinates are doubles without rounding wherever this test puts it, through a file.
Body cube_at(const Eigen::Vector3d& centre) {
    const test::TemporaryFolder folder;
    SurfaceMesh cube = make_box(4);
    cube.vertices = ((cube.vertices.array() - 0.5) * kSize).matrix().colwise() + centre;
    save_surface(folder.path() / "cube.ply", cube);
    return test::make_body(check_and_repair(load_surface(folder.path() / "cube.ply")).mesh);
}

struct FarSolution {
    Eigen::VectorXd displacement;
    Reactions reactions;
};

/// Bottom held, top pulled and bent.
FarSolution solve(const std::shared_ptr<const Model>& model, const Eigen::Vector3d& centre) {
    const SurfaceMesh& surface = *model->body().surface;
    ConstrainedSet set;
    set.fixed = test::vertices_where(surface, [&](const auto& p) { return p.z() - centre.z() == -0.5 * kSize; });
    set.handles = test::vertices_where(surface, [&](const auto& p) { return p.z() - centre.z() == 0.5 * kSize; });
    Eigen::VectorXd values(3 * std::ssize(set.handles));
    for (std::size_t i = 0; i < set.handles.size(); ++i) {
        const Eigen::Vector3d p = surface.vertices.col(set.handles[i]) - centre;
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) << 0.1 * kSize, 0.0, 0.05 * kSize + 0.2 * p.x();
    }
    Control control;
    Deformer deformer(model);
    deformer.constrain(set, control);
    return {deformer.displace(values), deformer.reactions(values)};
}

TEST(FarBody, DeformsAsTheSameBodyAtTheOrigin) {
    const Body near = cube_at(Eigen::Vector3d::Zero()), far = cube_at(kOffset);
    for (const Method& method : test::method_variants()) {
        SCOPED_TRACE(test::describe(method));
        const FarSolution a = solve(test::precomputed(near, method), Eigen::Vector3d::Zero());
        const FarSolution b = solve(test::precomputed(far, method), kOffset);
        constexpr double kTolerance = 1e-9;
        EXPECT_LT((a.displacement - b.displacement).norm(), kTolerance * a.displacement.norm());
        EXPECT_LT((a.reactions.forces - b.reactions.forces).norm(), kTolerance * a.reactions.forces.norm());
        // Moments are about the origin, wherever the body is: F x there.
        Eigen::Matrix3Xd moments = a.reactions.moments;
        for (Eigen::Index i = 0; i < moments.cols(); ++i) moments.col(i) += kOffset.cross(a.reactions.forces.col(i));
        EXPECT_LT((moments - b.reactions.moments).norm(), kTolerance * moments.norm());
    }
}

TEST(FarBody, HasItsInsideWhereItIs) {
    const Body near = cube_at(Eigen::Vector3d::Zero()), far = cube_at(kOffset);
    const Method fem = test::make_method(kFem);
    Control control;
    const auto a = Volume::of(test::precomputed(near, fem), control),
               b = Volume::of(test::precomputed(far, fem), control);
    ASSERT_TRUE(a && b);
    ASSERT_EQ(a->mesh().n_vertices(), b->mesh().n_vertices());
    ASSERT_GT(a->mesh().n_vertices(), a->mesh().n_surface_vertices);
    constexpr double kRounding = 2e-10;  // of 1e6
    EXPECT_LT((b->mesh().vertices - (a->mesh().vertices.colwise() + kOffset)).cwiseAbs().maxCoeff(), kRounding);
}

}  // namespace
}  // namespace elastolab
