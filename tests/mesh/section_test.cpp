#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <random>
#include <utility>
#include <vector>

#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "mesh/section/cap.hpp"

namespace elastolab {
namespace {

using Eigen::Vector3d;

Positions vertices_of(const SurfaceMesh& mesh, const Cap& cap) {
    Positions all(3, cap.rim.size() + cap.inside.cols());
    all.leftCols(cap.rim.size()) = cap.rim.mean(mesh.vertices);
    all.rightCols(cap.inside.cols()) = cap.inside;
    return all;
}

/// What a plane leaves of a solid: skin and cap, which share no vertices.
struct HalfSolid {
    SurfaceMesh skin, cap;
    double volume() const {
        SurfaceMesh all{Positions(3, skin.n_vertices() + cap.n_vertices()),
                        Triangles(3, skin.n_triangles() + cap.n_triangles())};
        all.vertices << skin.vertices, cap.vertices;
        all.triangles << skin.triangles, cap.triangles.array() + skin.n_vertices();
        return enclosed_volume(all);
    }
};

HalfSolid half(const SurfaceMesh& mesh, const Plane& plane, double edge) {
    const OpenedSurface opened = open_surface(mesh, plane);
    const Cap cap = make_cap(mesh, opened, plane, edge);
    return {{opened.vertices.mean(mesh.vertices), opened.triangles}, {vertices_of(mesh, cap), cap.triangles}};
}

Plane turned(const Plane& plane) { return {-plane.normal, -plane.offset}; }

double smallest_angle(const SurfaceMesh& mesh) {
    double least = 180.0;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (int i = 0; i < 3; ++i) {
            const Vector3d a = mesh.vertices.col(mesh.triangles(i, t));
            const Vector3d b = mesh.vertices.col(mesh.triangles((i + 1) % 3, t)) - a;
            const Vector3d c = mesh.vertices.col(mesh.triangles((i + 2) % 3, t)) - a;
            least = std::min(least, std::atan2(b.cross(c).norm(), b.dot(c)) * 180.0 / 3.14159265358979);
        }
    return least;
}

TEST(Section, OfACubeIsASquareOfGoodTriangles) {
    const SurfaceMesh cube = make_box(6);
    const Plane plane{Vector3d::UnitX(), 0.45};
    const HalfSolid kept = half(cube, plane, 1.0 / 6.0);
    EXPECT_NEAR(surface_area(kept.cap), 1.0, 1e-12);
    EXPECT_NEAR(kept.volume(), 0.45, 1e-12);
    for (int t = 0; t < kept.cap.n_triangles(); ++t)
        EXPECT_GT(area_vector(triangle_points(kept.cap, t)).x(), 0.0) << "faces along the plane's normal";
    EXPECT_GT(smallest_angle(kept.cap), 10.0);
    EXPECT_GT(kept.cap.n_triangles(), 400);
}

TEST(Section, OfAHollowSphereIsARingAndOfATorusTwo) {
    const SurfaceMesh shell = make_hollow_sphere(24);
    const HalfSolid bowl = half(shell, {Vector3d(1, 2, 2).normalized(), 0.1}, 0.1);
    const double ring = 3.14159265 * (1.0 - 0.25);
    EXPECT_NEAR(surface_area(bowl.cap), ring, 0.01 * ring);
    for (const auto& x : bowl.cap.vertices.colwise()) EXPECT_GT(x.norm(), 0.49);
    const SurfaceMesh torus = make_torus(16, 1.0, 0.35);
    const HalfSolid horseshoe = half(torus, {Vector3d::UnitX(), 0.0}, 0.05);
    const double discs = 2.0 * 3.14159265 * 0.35 * 0.35;
    EXPECT_NEAR(surface_area(horseshoe.cap), discs, 0.02 * discs);
    for (int t = 0; t < horseshoe.cap.n_triangles(); ++t)
        EXPECT_LT(std::fabs(std::fabs(centroid(horseshoe.cap, t).y()) - 1.0), 0.35) << "none between the discs";
}

/// The truth is the body's own volume, whatever the plane: both halves add up to it, and close without a gap.
TEST(Section, HalvesAddUpToTheBodyForAnyPlane) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share(-0.9, 0.9);
    const std::vector<SurfaceMesh> bodies = {make_box(1), make_torus(5), make_hollow_sphere(4), make_cylinder(3),
                                             make_sphere(7)};
    for (std::size_t b = 0; b < bodies.size(); ++b)
        for (int trial = 0; trial < 60; ++trial) {
            const SurfaceMesh& mesh = bodies[b];
            const Plane plane{Vector3d(normal(random), normal(random), normal(random)).normalized(), share(random)};
            const HalfSolid below = half(mesh, plane, 0.2), above = half(mesh, turned(plane), 0.3);
            const double volume = enclosed_volume(mesh);
            ASSERT_NEAR(below.volume() + above.volume(), volume, 1e-9 * volume) << "body " << b << " trial " << trial;
            ASSERT_NEAR(surface_area(below.cap), surface_area(above.cap), 1e-6) << "body " << b << " trial " << trial;
            Vector3d areas = Vector3d::Zero();  // of a closed surface they cancel
            for (const SurfaceMesh* part : {&below.skin, &below.cap})
                for (int t = 0; t < part->n_triangles(); ++t) areas += area_vector(triangle_points(*part, t));
            ASSERT_LT(areas.norm(), 1e-7) << "body " << b << " trial " << trial;
        }
}

TEST(Section, ThroughVerticesAndAlongFacesIsStillOne) {
    const SurfaceMesh cube = make_box(4);
    for (const double offset : {0.25, 0.5, 1.0, 0.0, -1.0, 2.0}) {
        const HalfSolid kept = half(cube, {Vector3d::UnitZ(), offset}, 0.2);
        EXPECT_NEAR(kept.volume(), std::clamp(offset, 0.0, 1.0), 1e-12) << offset;
    }
    const HalfSolid along_diagonals = half(cube, {Vector3d(1, -1, 0).normalized(), 0.0}, 0.2);
    EXPECT_NEAR(surface_area(along_diagonals.cap), std::sqrt(2.0), 1e-6);
}

TEST(Section, OfAnOpenSurfaceDoesNoHarm) {
    SurfaceMesh open = make_sphere(6);
    open.triangles = open.triangles.leftCols(open.triangles.cols() - 17).eval();
    for (const double offset : {-0.5, 0.0, 0.3}) {
        const HalfSolid kept = half(open, {Vector3d(1, 1, 1).normalized(), offset}, 0.2);
        EXPECT_TRUE(kept.cap.vertices.allFinite());
    }
}

/// Its outline encloses nothing by the signs of its segments, whatever it is by parity.
TEST(Section, OfSidesThatFaceOppositeWaysHasNoMorePointsThanItMay) {
    SurfaceMesh mixed = make_box(4);
    for (int t = 0; t < mixed.n_triangles(); ++t)
        if (centroid(mixed, t).z() < 0.99) std::swap(mixed.triangles(1, t), mixed.triangles(2, t));
    const Plane plane{Vector3d::UnitY(), 0.45};
    for (const int most : {30, 300, 3000}) {
        const Cap cap = make_cap(mixed, open_surface(mixed, plane), plane, 0.25, most);
        EXPECT_LE(cap.inside.cols(), most);
        EXPECT_GT(cap.inside.cols(), most / 3);
        EXPECT_NEAR(surface_area({vertices_of(mixed, cap), cap.triangles}), 1.0, 1e-6);
    }
}

}  // namespace
}  // namespace elastolab
