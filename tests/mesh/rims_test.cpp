#include "mesh/rims.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "mesh/topology.hpp"

namespace elastolab::test {
namespace {

bool always(const SurfaceMesh&, int, double) { return true; }

/// The triangles at x = low.
std::vector<char> lower_face(const SurfaceMesh& box) {
    std::vector<char> inside;
    for (const auto& triangle : box.triangles.colwise())
        inside.push_back(box.vertices(0, triangle).maxCoeff() < box.vertices.row(0).minCoeff() + 1e-9);
    return inside;
}

bool is_closed(const SurfaceMesh& mesh) {
    const EdgeTable edges(mesh);
    for (int e = 0; e < edges.size(); ++e)
        if (edges.half_edges(e).size() != 2) return false;
    return true;
}

/// Vertices with triangles in the region and outside.
std::set<int> rim_of(const RefinedSurface& surface, const std::vector<char>& in_region) {
    std::array<std::set<int>, 2> seen;
    for (int t = 0; t < surface.mesh.n_triangles(); ++t)
        for (const int v : surface.mesh.triangles.col(t))
            seen[in_region[static_cast<std::size_t>(surface.coarse_triangle[static_cast<std::size_t>(t)])] ? 1 : 0]
                .insert(v);
    std::set<int> both;
    for (const int v : seen[0])
        if (seen[1].contains(v)) both.insert(v);
    return both;
}

int most_corners_at(const SurfaceMesh& mesh, const std::set<int>& vertices) {
    int most = 0;
    for (const auto& triangle : mesh.triangles.colwise())
        most = std::max(most, static_cast<int>(std::count_if(triangle.begin(), triangle.end(),
                                                             [&](int v) { return vertices.contains(v); })));
    return most;
}

TEST(RowsAlongRim, LieAtPowersOfTheDistance) {
    const SurfaceMesh box = make_box(4);
    const std::vector<char> inside = lower_face(box);
    const double low = box.vertices.row(0).minCoeff(), cell = box.vertices.row(0).maxCoeff() / 4 - low / 4;
    for (const int rows : {1, 2, 3}) {
        const RefinedSurface finer = add_rows_along_rim(unrefined(box), inside, rows, always);
        std::set<long> expected, found;  // distances from the rim in millionths of a cell
        for (int i = 1; i <= rows; ++i) expected.insert(std::lround(1e6 * std::pow(i / (rows + 1.0), 2.5)));
        for (int v = box.n_vertices(); v < finer.mesh.n_vertices(); ++v)
            if (const double x = (finer.mesh.vertices(0, v) - low) / cell; x > 1e-9) found.insert(std::lround(1e6 * x));
        EXPECT_EQ(found, expected) << rows << " rows";
        EXPECT_EQ(rim_of(finer, inside), rim_of(unrefined(box), inside)) << "no new vertex on the rim";
        EXPECT_TRUE(is_closed(finer.mesh));
        EXPECT_LE(most_corners_at(finer.mesh, rim_of(finer, inside)), 2) << "corners of the face are cut";
    }
}

TEST(RowsAlongRim, DivideARegionOfOneTriangle) {
    const SurfaceMesh box = make_box(3);
    std::vector<char> inside(static_cast<std::size_t>(box.n_triangles()), 0);
    inside[5] = 1;
    const RefinedSurface finer = add_rows_along_rim(unrefined(box), inside, 1, always);
    const std::set<int> rim = rim_of(finer, inside);
    EXPECT_EQ(rim.size(), 6u) << "its edges are halved";
    EXPECT_LE(most_corners_at(finer.mesh, rim), 2);
    EXPECT_TRUE(is_closed(finer.mesh));
}

TEST(RowsAlongRim, LeaveWhatMayNotBeCut) {
    const SurfaceMesh box = make_box(3);
    const std::vector<char> inside = lower_face(box);
    const auto never = [](const SurfaceMesh&, int, double) { return false; };
    EXPECT_EQ(add_rows_along_rim(unrefined(box), inside, 2, never).mesh.triangles, box.triangles);
    const auto not_inside = [&](const SurfaceMesh& mesh, int t, double) {
        return mesh.vertices(0, mesh.triangles.col(t)).maxCoeff() > box.vertices.row(0).minCoeff() + 1e-9;
    };
    const RefinedSurface finer = add_rows_along_rim(unrefined(box), inside, 1, not_inside);
    for (int v = box.n_vertices(); v < finer.mesh.n_vertices(); ++v)
        EXPECT_GT(finer.mesh.vertices(0, v), box.vertices.row(0).minCoeff() + 1e-9) << "cut from outside only";
    EXPECT_TRUE(is_closed(finer.mesh));
}

/// Seen from inside, all edges of a box are re-entrant.
TEST(RowsAlongRim, LieAlongReentrantEdgesToo) {
    const SurfaceMesh box = make_box(4), cavity = inside_out(box);
    const std::vector<char> nothing(static_cast<std::size_t>(box.n_triangles()), 0);
    const Eigen::Vector3d low = box.vertices.rowwise().minCoeff(), high = box.vertices.rowwise().maxCoeff();
    const double cell = (high[0] - low[0]) / 4.0, share = std::pow(0.5, 2.5);
    EXPECT_EQ(add_rows_along_rim(unrefined(box), nothing, 1, always, 0.8).mesh.triangles, box.triangles);
    EXPECT_EQ(add_rows_along_rim(unrefined(cavity), nothing, 1, always).mesh.triangles, cavity.triangles);
    const RefinedSurface finer = add_rows_along_rim(unrefined(cavity), nothing, 1, always, 0.8);
    std::set<long> found;  // distances from the nearest edge of the box in millionths of a cell
    for (int v = cavity.n_vertices(); v < finer.mesh.n_vertices(); ++v) {
        Eigen::Array3d from_face = (finer.mesh.vertices.col(v) - low).cwiseMin(high - finer.mesh.vertices.col(v));
        std::sort(from_face.begin(), from_face.end());  // on a face, so that the second is that from an edge
        EXPECT_LT(from_face[0], 1e-9);
        found.insert(std::lround(1e6 * from_face[1] / cell));
    }
    EXPECT_EQ(found, std::set<long>{std::lround(1e6 * share)}) << "and none on an edge";
    EXPECT_TRUE(is_closed(finer.mesh));
}

TEST(RowsAlongRim, InterpolateAndGatherAsTransposesOfEachOther) {
    const SurfaceMesh sphere = make_sphere(2);
    std::vector<char> inside;
    for (const auto& triangle : sphere.triangles.colwise())
        inside.push_back(sphere.vertices(2, triangle).maxCoeff() < 0.2 ? 1 : 0);
    const RefinedSurface finer = add_rows_along_rim(unrefined(sphere), inside, 2, always);
    const Eigen::Matrix3Xd interpolated = finer.interpolate(sphere.vertices);
    EXPECT_EQ(interpolated, finer.mesh.vertices);
    EXPECT_LT((sphere.vertices * finer.weights().transpose() - interpolated).cwiseAbs().maxCoeff(), 1e-14);
    const Eigen::Matrix3Xd loads = interpolated.array().sin();
    EXPECT_NEAR(finer.gather(loads).cwiseProduct(sphere.vertices).sum(), loads.cwiseProduct(interpolated).sum(), 1e-11);
    EXPECT_TRUE(is_closed(finer.mesh));
}

}  // namespace
}  // namespace elastolab::test
