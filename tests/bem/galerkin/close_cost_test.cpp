#include "bem/galerkin/close_cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bem/galerkin/slender_bar.hpp"

namespace elastolab::test {
namespace {

TEST(CostlyPairs, AreThoseOfThinWallsAndFarMoreThoseOfSlivers) {
    EXPECT_EQ(costly_pair_integrals(make_sphere(6)), 0.0);
    const double thin = costly_pair_integrals(bar_of_section(2e-3, 2e-3));  // an altitude of a hundredth of the edges
    EXPECT_GT(thin, 0.0);
    EXPECT_GT(costly_pair_integrals(bar_of_section(2e-4, 2e-4)), 10.0 * thin);
}

/// Two fans over each other: each of their pairs takes few points, but a triangle has two hundred such neighbours.
TEST(CostlyPairs, AreThoseOfManyNeighboursToo) {
    const auto drum = [](int n_sectors) {
        SurfaceMesh mesh;
        mesh.vertices.resize(3, 2 * n_sectors + 2);
        mesh.triangles.resize(3, 4 * n_sectors);
        mesh.vertices.col(2 * n_sectors) << 0.0, 0.0, 0.0;
        mesh.vertices.col(2 * n_sectors + 1) << 0.0, 0.0, 0.2;
        for (int i = 0; i < n_sectors; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / n_sectors;
            const int next = (i + 1) % n_sectors;
            mesh.vertices.col(i) << std::cos(angle), std::sin(angle), 0.0;
            mesh.vertices.col(n_sectors + i) << std::cos(angle), std::sin(angle), 0.2;
            mesh.triangles.middleCols<4>(4 * i) << next, n_sectors + i, i, i,  //
                i, n_sectors + next, next, n_sectors + next,                   //
                2 * n_sectors, 2 * n_sectors + 1, n_sectors + next, n_sectors + i;
        }
        return mesh;
    };
    EXPECT_EQ(costly_pair_integrals(drum(12)), 0.0);
    EXPECT_GT(costly_pair_integrals(drum(140)), 5e6);
}

}  // namespace
}  // namespace elastolab::test
