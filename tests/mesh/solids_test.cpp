#include "mesh/solids.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "base/error.hpp"
#include "mesh/measures.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

void expect_solids_map_back(const SurfaceMesh& mesh, const std::vector<Solid>& solids) {
    int n_vertices = 0, n_triangles = 0;
    for (const Solid& solid : solids) {
        n_vertices += solid.surface.n_vertices();
        n_triangles += solid.surface.n_triangles();
        EXPECT_EQ(Positions(mesh.vertices(Eigen::all, solid.vertices)), solid.surface.vertices);
        for (int t = 0; t < solid.surface.n_triangles(); ++t)
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(solid.vertices[static_cast<std::size_t>(solid.surface.triangles(c, t))],
                          mesh.triangles(c, solid.triangles[static_cast<std::size_t>(t)]));
    }
    EXPECT_EQ(n_vertices, mesh.n_vertices());
    EXPECT_EQ(n_triangles, mesh.n_triangles());
}

TEST(SplitSolids, KeepsOneSolidAsItIs) {
    const SurfaceMesh torus = make_torus(4);
    const std::vector<Solid> solids = split_solids(torus);
    ASSERT_EQ(solids.size(), 1u);
    EXPECT_EQ(solids[0].surface.vertices, torus.vertices);
    EXPECT_EQ(solids[0].surface.triangles, torus.triangles);
}

TEST(SplitSolids, SeparatesTwoCubes) {
    const SurfaceMesh mesh = joined(make_box(2), moved(make_box(3), {5, 0, 0}));
    const std::vector<Solid> solids = split_solids(mesh);
    ASSERT_EQ(solids.size(), 2u);
    EXPECT_EQ(solids[0].surface.n_vertices(), 26);
    EXPECT_EQ(solids[1].surface.n_vertices(), 56);
    expect_solids_map_back(mesh, solids);
}

TEST(SplitSolids, GivesACavityToTheSolidAroundIt) {
    const SurfaceMesh mesh = make_hollow_sphere(3);
    const std::vector<Solid> solids = split_solids(mesh);
    ASSERT_EQ(solids.size(), 1u);
    expect_solids_map_back(mesh, solids);
}

TEST(SplitSolids, SeparatesASolidInsideACavity) {
    // The innermost sphere comes first, the outermost surface last.
    const SurfaceMesh mesh = joined(joined(make_sphere(2, 0.2), inside_out(make_sphere(3, 0.5))), make_sphere(4, 1.0));
    const std::vector<Solid> solids = split_solids(mesh);
    ASSERT_EQ(solids.size(), 2u);
    EXPECT_EQ(solids[0].surface.n_vertices(), 18);
    EXPECT_EQ(solids[1].surface.n_vertices(), 38 + 66);
    expect_solids_map_back(mesh, solids);
}

TEST(SplitSolids, GivesEachCavityToTheInnermostSolidAroundIt) {
    const SurfaceMesh shell = make_hollow_sphere(3, 3.0, 2.0);
    const SurfaceMesh two_holes =
        joined(moved(make_hollow_sphere(2, 0.5, 0.2), {1, 0, 0}), moved(make_hollow_sphere(2, 0.5, 0.3), {-1, 0, 0}));
    const std::vector<Solid> solids = split_solids(joined(shell, two_holes));
    ASSERT_EQ(solids.size(), 3u);
    for (const Solid& solid : solids) EXPECT_GT(enclosed_volume(solid.surface), 0.0);
    EXPECT_EQ(solids[0].surface.n_vertices(), 76);
    EXPECT_EQ(solids[1].surface.n_vertices(), 36);
}

/// Shells in shells, beside a crowd: each surface is compared with those around it only.
TEST(SplitSolids, FindsWhatIsAroundEachOfMany) {
    constexpr int kShells = 12, kCrowd = 9;
    SurfaceMesh mesh = make_sphere(2, 1.0);
    for (int i = 1; i < 2 * kShells; ++i) {
        const SurfaceMesh sphere = make_sphere(2, 1.0 + i);
        mesh = joined(mesh, i % 2 == 1 ? inside_out(sphere) : sphere);
    }
    mesh = joined(mesh, make_sphere(2, 1.0 + 2 * kShells));
    for (int i = 0; i < kCrowd; ++i)
        mesh = joined(mesh, moved(make_sphere(2, 0.4), {40.0 + i % 3, static_cast<double>(i / 3), 0}));
    const std::vector<Solid> solids = split_solids(mesh);
    ASSERT_EQ(solids.size(), 1u + kShells + kCrowd);
    EXPECT_EQ(solids[0].surface.n_vertices(), 18);
    for (std::size_t i = 1; i <= kShells; ++i) {
        EXPECT_EQ(solids[i].surface.n_vertices(), 36) << i;
        EXPECT_NEAR(solids[i].surface.vertices.colwise().norm().minCoeff(), 2.0 * static_cast<double>(i), 1e-9);
    }
}

TEST(SplitSolids, RejectsACavityInNothing) { EXPECT_THROW(split_solids(inside_out(make_box(2))), MeshError); }

}  // namespace
}  // namespace elastolab
