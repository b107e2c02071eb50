#include "mesh/numbering.hpp"

#include <gtest/gtest.h>

#include "mesh/surface_mesh.hpp"

namespace elastolab {
namespace {

TEST(Numbering, KeepsTheVerticesThatTrianglesUseEachOnce) {
    Triangles triangles(3, 2);
    triangles << 7, 4, 2, 7, 9, 2;
    EXPECT_EQ(used_vertices(triangles), (std::vector<int>{2, 4, 7, 9}));
    EXPECT_EQ(used_vertices(Triangles(3, 0)), std::vector<int>());
    EXPECT_EQ(used_vertices(triangles.topRows(2)), (std::vector<int>{2, 4, 7}));
    EXPECT_EQ(each_once({3, 1, 3, 1}), (std::vector<int>{1, 3}));
}

TEST(Numbering, NumbersTheCornersAnewWithinTheVerticesThatAreKept) {
    Triangles triangles(3, 2);
    triangles << 7, 4, 2, 7, 9, 2;
    Triangles expected(3, 2);
    expected << 2, 1, 0, 2, 3, 0;
    renumber(triangles, used_vertices(triangles));
    EXPECT_EQ(triangles, expected);
}

}  // namespace
}  // namespace elastolab
