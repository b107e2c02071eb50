#include "render/geometry/coarse_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Geometry>
#include <map>

#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

struct Coarse {
    SurfaceMesh mesh;
    SmoothingGroups groups;
    Eigen::Matrix3Xi corners;    ///< drawn vertices
    Eigen::Matrix3Xi triangles;  ///< the vertices that they stand for

    Coarse(SurfaceMesh of, int n_wanted)
        : mesh(std::move(of)),
          groups(smoothing_groups(mesh.vertices, mesh.triangles)),
          corners(coarse_corners(mesh.vertices, mesh.triangles, groups, n_wanted)),
          triangles(corners.unaryExpr([&](int drawn) { return groups.vertices[static_cast<std::size_t>(drawn)]; })) {}

    /// Whether triangles run through every edge as often one way as the other.
    bool is_closed() const {
        std::map<std::pair<int, int>, int> balance;
        for (const auto& t : triangles.colwise())
            for (int i = 0; i < 3; ++i) {
                const int a = t[i], b = t[(i + 1) % 3];
                balance[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
    }
    static double volume(const Positions& x, const Eigen::Matrix3Xi& triangles) {
        double sum = 0.0;
        for (const auto& t : triangles.colwise()) sum += x.col(t[0]).dot(x.col(t[1]).cross(x.col(t[2]))) / 6.0;
        return sum;
    }
    double part_of_volume() const { return volume(mesh.vertices, triangles) / volume(mesh.vertices, mesh.triangles); }
};

TEST(CoarseSurface, HasAboutAsManyTrianglesAsWantedAndTheShape) {
    for (const int wanted : {2000, 8000}) {
        const Coarse sphere(make_sphere(60), wanted);
        EXPECT_GT(sphere.mesh.n_triangles(), 2 * wanted);
        EXPECT_GT(sphere.triangles.cols(), wanted / 2);
        EXPECT_LT(sphere.triangles.cols(), 2 * wanted);
        EXPECT_TRUE(sphere.is_closed());
        EXPECT_NEAR(sphere.part_of_volume(), 1.0, 0.02);
    }
}

TEST(CoarseSurface, KeepsTheEdgesOfACubeAndTheNormalsOfItsSides) {
    const Coarse cube(make_box(50), 3000);
    EXPECT_LT(cube.triangles.cols(), 6000);
    EXPECT_TRUE(cube.is_closed());
    EXPECT_NEAR(cube.part_of_volume(), 1.0, 0.02);
    // A side's drawn vertices all have its normal, so that no edge is rounded.
    std::vector<Eigen::Vector3d> normal(cube.groups.vertices.size(), Eigen::Vector3d::Zero());
    const Positions& x = cube.mesh.vertices;
    for (Eigen::Index t = 0; t < cube.mesh.triangles.cols(); ++t) {
        const Eigen::Vector3i v = cube.mesh.triangles.col(t);
        for (const int drawn : cube.groups.corners.col(t))
            normal[static_cast<std::size_t>(drawn)] += (x.col(v[1]) - x.col(v[0])).cross(x.col(v[2]) - x.col(v[0]));
    }
    int n_off = 0;
    for (Eigen::Index t = 0; t < cube.triangles.cols(); ++t) {
        const Eigen::Vector3i v = cube.triangles.col(t);
        const Eigen::Vector3d own = (x.col(v[1]) - x.col(v[0])).cross(x.col(v[2]) - x.col(v[0])).normalized();
        for (const int drawn : cube.corners.col(t))
            n_off += normal[static_cast<std::size_t>(drawn)].normalized().dot(own) < 0.8;
    }
    EXPECT_LT(n_off, cube.corners.size() / 50);
}

TEST(CoarseSurface, KeepsBothSidesOfAThinPlate) {
    const Coarse plate(make_box(1, {40, 40, 0.5}), 1500);
    ASSERT_GT(plate.mesh.n_triangles(), 3000);
    EXPECT_LT(plate.triangles.cols(), plate.mesh.n_triangles() / 2);
    EXPECT_NEAR(plate.part_of_volume(), 1.0, 0.05);
}

TEST(CoarseSurface, OfCollapsedTrianglesIsTheSurfaceItself) {
    SurfaceMesh mesh = make_sphere(4);
    mesh.vertices.setZero();
    EXPECT_EQ(Coarse(mesh, 10).corners.cols(), mesh.n_triangles());
}

}  // namespace
}  // namespace elastolab
