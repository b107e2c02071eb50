#include "mesh/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"

namespace elastolab::test {
namespace {

TEST(LengthAlongSurface, OfABarIsItsOwn) {
    for (const int cells : {1, 2, 4}) {
        const double length = length_along_surface(make_box(cells, {20.0, 1.0, 1.0}));
        EXPECT_GE(length, 20.0);
        EXPECT_LE(length, 21.5);
    }
}

/// A bar along a circle, but for a gap: the ends are near each other in space and not on the surface.
TEST(LengthAlongSurface, OfABentBarIsTheWayAroundTheBend) {
    SurfaceMesh ring = make_box(2, {24.0, 1.0, 1.0});
    const double radius = 4.0;
    for (auto x : ring.vertices.colwise()) {
        const double angle = x[0] / radius, r = radius + 0.5 - x[1];
        x = Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), x[2]);
    }
    const double length = length_along_surface(ring);
    EXPECT_GE(length, 24.0 * (radius - 0.5) / radius);
    EXPECT_LE(length, 24.0 * (radius + 0.5) / radius);
}

TEST(LengthAlongSurface, OfSeveralSurfacesIsThatOfTheLongest) {
    const SurfaceMesh bar = make_box(1, {20.0, 1.0, 1.0}), cube = make_box(1);
    const double alone = length_along_surface(bar);
    EXPECT_EQ(length_along_surface(joined(cube, moved(bar, {0.0, 50.0, 0.0}))), alone);
    EXPECT_EQ(length_along_surface(joined(bar, moved(cube, {0.0, 50.0, 0.0}))), alone);
    EXPECT_EQ(length_along_surface({}), 0.0);
}

}  // namespace
}  // namespace elastolab::test
