#include "render/geometry/surface_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Geometry>

#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

TEST(SurfaceGeometry, SplitsACubeAtItsEdgesOnly) {
    const SurfaceMesh mesh = make_box(4);
    const SmoothingGroups groups = smoothing_groups(mesh.vertices, mesh.triangles);
    EXPECT_EQ(groups.vertices.size(), 6u * 25u);
    EXPECT_EQ(groups.features.cols(), 12 * 4);
}

TEST(SurfaceGeometry, LeavesASphereWhole) {
    const SurfaceMesh mesh = make_sphere(8);
    const SmoothingGroups groups = smoothing_groups(mesh.vertices, mesh.triangles);
    EXPECT_EQ(static_cast<int>(groups.vertices.size()), mesh.n_vertices());
    EXPECT_EQ(groups.features.cols(), 0);
    for (Eigen::Index i = 0; i < groups.corners.size(); ++i)
        EXPECT_EQ(groups.vertices[static_cast<std::size_t>(groups.corners.data()[i])], mesh.triangles.data()[i]);
}

/// The edges around a dent are sharp, and too short to be a crease of the body; they still split the normals.
TEST(SurfaceGeometry, DrawsNoLinesAroundASmallDent) {
    SurfaceMesh mesh = make_sphere(60);
    mesh.vertices.col(0) *= 0.95;
    const SmoothingGroups groups = smoothing_groups(mesh.vertices, mesh.triangles);
    EXPECT_EQ(groups.features.cols(), 0);
    EXPECT_GT(static_cast<int>(groups.vertices.size()), mesh.n_vertices());
}

TEST(SurfaceGeometry, TakesOpenBordersAsFeatures) {
    Eigen::Matrix3Xi triangle(3, 1);
    triangle << 0, 1, 2;
    EXPECT_EQ(smoothing_groups(Eigen::Matrix3d::Identity(), triangle).features.cols(), 3);
}

TEST(SurfaceGeometry, HasRadialNormalsOnASphereOfAnySize) {
    for (const double radius : {1e-9, 1.0, 1e9}) {
        const SurfaceMesh mesh = make_sphere(12, radius);
        SurfaceGeometry geometry(mesh.vertices, mesh.triangles);
        geometry.update(mesh.vertices, frame_of(mesh.vertices));
        for (const DrawnVertex& vertex : geometry.vertices()) {
            EXPECT_NEAR(vertex.normal.norm(), 1.0f, 1e-5f);
            EXPECT_GT(vertex.normal.dot(vertex.position.normalized()), 0.999f);
        }
    }
}

TEST(SurfaceGeometry, HasExactNormalsOnTheFacesOfACube) {
    const SurfaceMesh mesh = make_box(3);
    SurfaceGeometry geometry(mesh.vertices, mesh.triangles);
    geometry.update(mesh.vertices, frame_of(mesh.vertices));
    for (const DrawnVertex& vertex : geometry.vertices()) EXPECT_NEAR(vertex.normal.cwiseAbs().maxCoeff(), 1.0f, 1e-6f);
}

TEST(SurfaceGeometry, SurvivesACollapsedSurface) {
    const SurfaceMesh mesh = make_box(2);
    SurfaceGeometry geometry(mesh.vertices, mesh.triangles);
    geometry.update(Eigen::Matrix3Xd::Zero(3, mesh.n_vertices()), SceneFrame{});
    for (const DrawnVertex& vertex : geometry.vertices()) EXPECT_EQ(vertex.normal.norm(), 0.0f);
}

TEST(SceneFrame, HoldsWhatItIsMadeOf) {
    const SurfaceMesh mesh = make_box(2, {1.0, 2.0, 3.0});
    const SceneFrame frame = frame_of(mesh.vertices);
    EXPECT_TRUE(frame.center.isApprox(Eigen::Vector3d(0.5, 1.0, 1.5)));
    EXPECT_NEAR(frame.radius, 0.5 * std::sqrt(14.0), 1e-12);
    EXPECT_EQ(frame_of(Eigen::Matrix3Xd::Zero(3, 1)).radius, 1.0);
}

TEST(UnpairedEdges, AreTheRimsAndTheFlippedOnes) {
    SurfaceMesh mesh = make_box(3);
    EXPECT_EQ(unpaired_edges(mesh.triangles).cols(), 0);
    Eigen::Matrix3Xi triangles = mesh.triangles;
    std::swap(triangles(0, 5), triangles(1, 5));
    EXPECT_EQ(unpaired_edges(triangles).cols(), 3) << "flipped";
    const Edges rim = unpaired_edges(mesh.triangles.rightCols(mesh.n_triangles() - 1));
    ASSERT_EQ(rim.cols(), 3) << "a hole";
    const Eigen::Vector3i hole = mesh.triangles.col(0);
    for (Eigen::Index i = 0; i < 3; ++i) {
        EXPECT_LT(rim(0, i), rim(1, i));
        for (const int vertex : {rim(0, i), rim(1, i)}) EXPECT_TRUE((hole.array() == vertex).any());
    }
}

}  // namespace
}  // namespace elastolab
