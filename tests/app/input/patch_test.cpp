#include "app/input/patch.hpp"

#include <gmock/gmock.h>

#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;

TEST(Patch, OfNoRadiusIsTheVertexItself) {
    const SurfaceMesh mesh = make_box(2);
    EXPECT_THAT(patch_around(mesh, VertexGraph(mesh), 5, 0.0), ElementsAre(5));
}

TEST(Patch, HoldsAllWithinReachAndBeginsWithItsMiddle) {
    const SurfaceMesh mesh = make_box(4);
    const VertexGraph graph(mesh);
    constexpr double radius = 0.4;
    for (int center = 0; center < mesh.n_vertices(); ++center) {
        const std::vector<int> patch = patch_around(mesh, graph, center, radius);
        EXPECT_EQ(patch.front(), center);
        std::ptrdiff_t n_near = 0;
        for (int v = 0; v < mesh.n_vertices(); ++v)
            if ((mesh.vertices.col(v) - mesh.vertices.col(center)).norm() <= radius) ++n_near;
        EXPECT_EQ(std::ssize(patch), n_near);  // a cube has no thin parts
    }
}

TEST(Patch, DoesNotJumpToTheOtherSideOfAThinPlate) {
    const SurfaceMesh plate = make_box(1, {1.0, 1.0, 0.05});
    const VertexGraph graph(plate);
    int top = 0;
    (plate.vertices.colwise() - Eigen::Vector3d(0.5, 0.5, 0.05)).colwise().squaredNorm().minCoeff(&top);
    for (const int v : patch_around(plate, graph, top, 0.3)) EXPECT_GT(plate.vertices(2, v), 0.04);
}

TEST(VertexGraph, KnowsTheNeighboursOnBothSides) {
    const SurfaceMesh mesh = make_box(2);
    const VertexGraph graph(mesh);
    for (int v = 0; v < mesh.n_vertices(); ++v)
        for (const int w : graph[v]) {
            EXPECT_NE(v, w);
            EXPECT_NE(std::find(graph[w].begin(), graph[w].end(), v), graph[w].end());
        }
}

}  // namespace
}  // namespace elastolab
