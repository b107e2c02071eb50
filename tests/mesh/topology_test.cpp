#include "mesh/topology.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

TEST(VertexTriangles, ListsEveryCornerOnceAscending) {
    const SurfaceMesh mesh = make_sphere(3);
    const VertexTriangles around(mesh);
    int n_corners = 0;
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        EXPECT_TRUE(std::is_sorted(around[v].begin(), around[v].end()));
        for (const int t : around[v]) EXPECT_TRUE((mesh.triangles.col(t).array() == v).any());
        n_corners += static_cast<int>(around[v].size());
    }
    EXPECT_EQ(n_corners, 3 * mesh.n_triangles());
}

TEST(EdgeTable, HoldsEveryEdgeOfAClosedSurfaceTwice) {
    const SurfaceMesh mesh = make_torus(4);
    const EdgeTable edges(mesh);
    ASSERT_EQ(2 * edges.size(), 3 * mesh.n_triangles());
    for (int e = 0; e < edges.size(); ++e) {
        ASSERT_EQ(edges.half_edges(e).size(), 2u);
        for (const int h : edges.half_edges(e)) {
            const auto [a, b] =
                std::minmax(mesh.triangles(h % 3, h / 3), mesh.triangles(next_corner(h) % 3, next_corner(h) / 3));
            EXPECT_EQ(a, edges[e].a);
            EXPECT_EQ(b, edges[e].b);
        }
    }
}

TEST(Components, OfAHollowSphereAreItsTwoSurfaces) {
    const SurfaceMesh mesh = make_hollow_sphere(2);
    const Components components = connected_components(mesh, EdgeTable(mesh));
    ASSERT_EQ(components.count, 2);
    EXPECT_EQ(components.triangles()[0].size(), components.triangles()[1].size());
    EXPECT_EQ(components.of_triangle.front(), 0);
}

}  // namespace
}  // namespace elastolab
