// What an open surface is taken for: a solid whose holes are closed, or a sheet.
#include "mesh/wrap/hole_caps.hpp"

#include <gmock/gmock.h>

#include "mesh/checks/check.hpp"
#include "mesh/measures.hpp"
#include "mesh/meshes.hpp"

namespace elastolab {
namespace {

/// A ball without the part above a height: a fraction f of its surface is above 1 - 2 f.
SurfaceMesh ball_without(double f) { return with_hole(make_sphere(12), {0, 0, 1}, 1.0 - 2.0 * f); }

/// A tube of radius 1/2, open at both ends.
SurfaceMesh tube(double length) {
    const SurfaceMesh cylinder = make_cylinder(6, 0.5, length);
    return with_hole(with_hole(cylinder, {0, 0, 1}, 0.499 * length), {0, 0, -1}, 0.499 * length);
}

SurfaceMesh square() {
    SurfaceMesh mesh = make_box(4);
    std::vector<int> kept;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (centroid(mesh, t).z() < 1e-9) kept.push_back(t);
    return {mesh.vertices, mesh.triangles(Eigen::all, kept)};
}

bool is_taken_for_a_solid(const SurfaceMesh& mesh) {
    const HoleCaps caps = cap_holes(mesh);
    EXPECT_NE(caps.n_holes > 0, caps.n_left_open > 0);
    return caps.n_holes > 0;
}

TEST(HoleCaps, AreMadeWhereHolesAreSmallBesideTheSurface) {
    EXPECT_TRUE(is_taken_for_a_solid(without_last(make_sphere(6), 1)));
    for (const double missing : {0.01, 0.05, 0.1, 0.2}) EXPECT_TRUE(is_taken_for_a_solid(ball_without(missing)));
    for (const double missing : {0.35, 0.4, 0.5, 0.75}) EXPECT_FALSE(is_taken_for_a_solid(ball_without(missing)));
    EXPECT_TRUE(is_taken_for_a_solid(tube(6.0)));
    EXPECT_FALSE(is_taken_for_a_solid(tube(1.0)));
    EXPECT_FALSE(is_taken_for_a_solid(square()));
}

TEST(HoleCaps, CanBeChosen) {
    const SurfaceMesh hole = ball_without(0.05), half = ball_without(0.5);
    EXPECT_EQ(cap_holes(hole, OpenSurface::sheet).n_left_open, 1);
    EXPECT_EQ(cap_holes(half, OpenSurface::solid).n_holes, 1);
    const SurfaceMesh closed = cap_holes(half, OpenSurface::solid).closed;
    EXPECT_NEAR(std::abs(enclosed_volume(check_and_repair(closed).mesh)), 0.5 * enclosed_volume(make_sphere(12)), 0.1);
}

/// Every part for itself: a ball with a small hole, and a sheet beside it.
TEST(HoleCaps, AreMadeForEachPartByItself) {
    const HoleCaps caps = cap_holes(joined(ball_without(0.02), moved(square(), {3, 0, 0})));
    EXPECT_EQ(caps.n_holes, 1);
    EXPECT_EQ(caps.n_left_open, 1);
}

/// Holes that meet in a vertex have rims that pass it several times.
TEST(HoleCaps, CloseHolesThatMeetInAVertex) {
    const SurfaceMesh ball = make_sphere(6);
    std::vector<int> around;
    for (int t = 0; t < ball.n_triangles(); ++t)
        if ((ball.triangles.col(t).array() == 0).any()) around.push_back(t);
    ASSERT_GE(around.size(), 4U);
    // Every second triangle around the vertex: none shares an edge with another.
    std::vector<int> removed;
    for (const int t : around) {
        const auto shares_edge = [&](int other) {
            int n_common = 0;
            for (const int v : ball.triangles.col(t)) n_common += (ball.triangles.col(other).array() == v).any();
            return n_common > 1;
        };
        if (std::none_of(removed.begin(), removed.end(), shares_edge)) removed.push_back(t);
    }
    ASSERT_GE(removed.size(), 2U);
    std::vector<int> kept;
    for (int t = 0; t < ball.n_triangles(); ++t)
        if (std::find(removed.begin(), removed.end(), t) == removed.end()) kept.push_back(t);
    const HoleCaps caps = cap_holes({ball.vertices, ball.triangles(Eigen::all, kept)});
    EXPECT_EQ(caps.n_holes, std::ssize(removed));
    EXPECT_TRUE(check_and_repair(caps.closed).report.usable_for_fem());
}

}  // namespace
}  // namespace elastolab
