#include "app/input/patch.hpp"

#include <gmock/gmock.h>

#include <set>

#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;

bool all_free(int) { return true; }

TEST(Patch, OfNoRadiusIsTheVertexItself) {
    const SurfaceMesh mesh = make_box(2);
    EXPECT_THAT(patch_around(mesh, VertexGraph(mesh), 5, 0.0, all_free), ElementsAre(5));
}

TEST(Patch, HoldsAllWithinReachAndBeginsWithItsMiddle) {
    const SurfaceMesh mesh = make_box(4);
    const VertexGraph graph(mesh);
    constexpr double radius = 0.4;
    for (int center = 0; center < mesh.n_vertices(); ++center) {
        const std::vector<int> patch = patch_around(mesh, graph, center, radius, all_free);
        EXPECT_EQ(patch.front(), center);
        const std::set<int> in(patch.begin(), patch.end());
        double reach = 0.0;
        for (const int v : patch) reach = std::max(reach, (mesh.vertices.col(v) - mesh.vertices.col(center)).norm());
        for (int v = 0; v < mesh.n_vertices(); ++v)  // a cube has no thin parts
            EXPECT_TRUE((mesh.vertices.col(v) - mesh.vertices.col(center)).norm() > radius || in.contains(v));
        EXPECT_LT(reach, radius + 0.36);  // by at most an edge
    }
}

TEST(Patch, DoesNotJumpToTheOtherSideOfAThinPlate) {
    const SurfaceMesh plate = make_box(1, {1.0, 1.0, 0.05});
    const VertexGraph graph(plate);
    int top = 0;
    (plate.vertices.colwise() - Eigen::Vector3d(0.5, 0.5, 0.05)).colwise().squaredNorm().minCoeff(&top);
    for (const int v : patch_around(plate, graph, top, 0.3, all_free)) EXPECT_GT(plate.vertices(2, v), 0.04);
}

/// Vertices of a patch that are corners of no triangle with all corners in it.
int n_alone(const SurfaceMesh& mesh, const std::vector<int>& patch) {
    const std::set<int> in(patch.begin(), patch.end());
    std::set<int> alone = in;
    for (const auto& t : mesh.triangles.colwise())
        if (in.contains(t[0]) && in.contains(t[1]) && in.contains(t[2]))
            for (const int v : t) alone.erase(v);
    return static_cast<int>(alone.size());
}

TEST(Patch, LeavesNoVertexAlone) {
    const SurfaceMesh mesh = make_cylinder(5);
    const VertexGraph graph(mesh);
    for (const double radius : {1e-6, 0.1, 0.2, 0.3, 0.45, 0.7})
        for (int center = 0; center < mesh.n_vertices(); ++center) {
            const auto is_free = [&](int v) { return v == center || v % 5 != 0; };
            const std::vector<int> patch = patch_around(mesh, graph, center, radius, is_free);
            EXPECT_EQ(patch.front(), center);
            for (const int v : patch) EXPECT_TRUE(is_free(v));
            EXPECT_TRUE(patch.size() == 1 || n_alone(mesh, patch) == 0) << radius << " at " << center;
            EXPECT_GE(patch_around(mesh, graph, center, radius, all_free).size(), 3u);
        }
}

TEST(Patch, BetweenOthersIsThePointItself) {
    const SurfaceMesh mesh = make_box(4);
    EXPECT_THAT(patch_around(mesh, VertexGraph(mesh), 7, 0.4, [](int v) { return v == 7; }), ElementsAre(7));
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
