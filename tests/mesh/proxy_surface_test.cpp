// Closed surfaces around surfaces of every kind that files have: what comes out must serve every method.
#include "mesh/wrap/proxy_surface.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "base/error.hpp"
#include "mesh/closest_point.hpp"
#include "mesh/measures.hpp"
#include "mesh/meshes.hpp"
#include "mesh/refine.hpp"
#include "mesh/solids.hpp"
#include "mesh/tets/tetrahedralize.hpp"

namespace elastolab {
namespace {

ProxySurface proxy_of(const SurfaceMesh& mesh, int n_vertices, OpenSurface taken_for = OpenSurface::automatic) {
    CheckedMesh checked = check_and_repair(mesh);
    Control control;
    const std::array sizes = {n_vertices};
    return make_proxy_surfaces(checked.mesh, checked.report, sizes, control, taken_for).front();
}

/// What FEM needs of it.
bool can_be_filled(const SurfaceMesh& surface) {
    Control control;
    for (const Solid& solid : split_solids(surface))
        if (tetrahedralize(solid.surface, "proxy", {}, control).n_tetrahedra() == 0) return false;
    return true;
}

double largest_distance(const Positions& points, const SurfaceMesh& from) {
    Control control;
    return closest_points(from, points, control).distance.maxCoeff();
}

SurfaceMesh single_triangle() { return without_last(make_box(1), 11); }

SurfaceMesh sphere_with_hole(int cells) { return with_hole(make_sphere(cells), {0, 0, 1}, 0.93); }

SurfaceMesh sheet(int cells) {
    const SurfaceMesh box = make_box(cells);
    std::vector<int> kept;
    for (int t = 0; t < box.n_triangles(); ++t)
        if (centroid(box, t).z() < 1e-9) kept.push_back(t);
    return {box.vertices, box.triangles(Eigen::all, kept)};
}

/// Of radius 1 and height 0.3; both caps have n triangles around their centre.
SurfaceMesh cylinder_of_fans(int n) {
    SurfaceMesh mesh{Positions(3, 2 * n + 2), Triangles(3, 4 * n)};
    mesh.vertices.col(0).setZero();
    mesh.vertices.col(1) = Eigen::Vector3d(0.0, 0.0, 0.3);
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        const int a = 2 + 2 * i, b = a + 1, c = 2 + 2 * ((i + 1) % n), d = c + 1;
        for (const int v : {a, b}) mesh.vertices.col(v) << std::cos(angle), std::sin(angle), v == a ? 0.0 : 0.3;
        mesh.triangles.middleCols<4>(4 * i) << 0, 1, a, a,  //
            c, b, c, d,                                     //
            a, d, d, b;
    }
    return mesh;
}

/// Two balls, one of them far smaller and sticking out of the other, and needles around them.
SurfaceMesh soup() {
    SurfaceMesh mesh = joined(make_sphere(8), moved(scaled(make_sphere(5), 0.4), {0.9, 0.0, 0.2}));
    mesh = joined(mesh, moved(scaled(make_sphere(3), 0.2), {0.0, 0.0, 0.0}));
    for (int i = 0; i < 10; ++i) {
        SurfaceMesh needle = single_triangle();
        needle.vertices.row(1) *= 1e-6;
        mesh = joined(mesh, moved(scaled(needle, 0.1 * i), {0.1 * i, 0.2, 0.0}));
    }
    return mesh;
}

/// Triangles around one edge, as the pages of a book.
SurfaceMesh book(int pages) {
    SurfaceMesh mesh{Positions(3, 2 + pages), Triangles(3, pages)};
    mesh.vertices.leftCols(2) << 0, 0, 0, 0, 0, 1;
    for (int i = 0; i < pages; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / pages;
        mesh.vertices.col(2 + i) << std::cos(angle), std::sin(angle), 0.5;
        mesh.triangles.col(i) << 0, 1, 2 + i;
    }
    return mesh;
}

/// Triangles between random points of the unit cube.
SurfaceMesh random_triangles(int n) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(0.0, 1.0);
    SurfaceMesh mesh{Positions(3, 3 * n), Triangles(3, n)};
    for (double& x : mesh.vertices.reshaped()) x = coordinate(random);
    for (int t = 0; t < n; ++t) mesh.triangles.col(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    return mesh;
}

struct Corpus {
    const char* name;
    SurfaceMesh mesh;
};
void PrintTo(const Corpus& body, std::ostream* out) { *out << body.name; }

class AnyTriangles : public testing::TestWithParam<Corpus> {};

TEST_P(AnyTriangles, HaveAProxyThatEveryMethodCanUse) {
    const SurfaceMesh& mesh = GetParam().mesh;
    const ProxySurface proxy = proxy_of(mesh, 400);
    const MeshReport report = check_and_repair(proxy.surface).report;
    EXPECT_TRUE(report.usable_for_fem());
    EXPECT_TRUE(can_be_filled(proxy.surface));
    EXPECT_GT(report.volume, 0.0);
    const bool is_itself = proxy.kind == ProxySurface::Kind::collapsed && mesh.n_vertices() < 400;
    EXPECT_GT(proxy.surface.n_vertices(), is_itself ? mesh.n_vertices() * 9 / 10 - 1 : 150);
    EXPECT_LT(proxy.surface.n_vertices(), 900);
    // Around the triangles, and nowhere else: a cap of a hole is farther from them.
    const double size = (report.max_corner - report.min_corner).norm();
    EXPECT_LT(largest_distance(mesh.vertices(Eigen::all, mesh.triangles.reshaped()), proxy.surface), 0.3 * size);
    EXPECT_LT(largest_distance(proxy.surface.vertices, mesh), 0.2 * size);
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, AnyTriangles,
    testing::Values(Corpus{"sphere", make_sphere(20)}, Corpus{"sphere with a hole", sphere_with_hole(12)},
                    Corpus{"half sphere", without_last(make_sphere(12), make_sphere(12).n_triangles() / 2)},
                    Corpus{"one triangle", single_triangle()}, Corpus{"sheet", sheet(5)}, Corpus{"soup", soup()},
                    Corpus{"careless", carelessly_exported(make_lumpy_ball(8))},
                    Corpus{"torn", torn(make_lumpy_ball(10), 0.02)}, Corpus{"cube of 12 triangles", make_box(1)},
                    Corpus{"tiny", scaled(sphere_with_hole(6), 1e-9)},
                    Corpus{"huge", scaled(sphere_with_hole(6), 1e12)},
                    Corpus{"far", moved(torn(make_sphere(6), 0.01), {1e5, -1e5, 3e5})}, Corpus{"book", book(20)},
                    Corpus{"random triangles", random_triangles(50)},
                    Corpus{"bowtie", joined(make_box(2), moved(make_box(2), {1, 1, 1}))},
                    Corpus{"inside out", inside_out(sphere_with_hole(8))}));

TEST(ProxySurface, ASoundSurfaceKeepsItsVolumeAndShape) {
    const SurfaceMesh mesh = make_lumpy_ball(30);
    const ProxySurface proxy = proxy_of(mesh, 600);
    EXPECT_EQ(proxy.kind, ProxySurface::Kind::collapsed);
    EXPECT_NEAR(enclosed_volume(proxy.surface), enclosed_volume(mesh), 2e-3 * enclosed_volume(mesh));
    EXPECT_LT(largest_distance(proxy.surface.vertices, mesh), 0.02);
    EXPECT_EQ(proxy.thin_part, 0.0);
}

/// Many triangles in one plane fold over each other as edges collapse, unless that is seen to: such a body had to be
/// wrapped, which takes ten times as long and closes the gaps between fingers.
TEST(ProxySurface, FlatFacesThatAreFinelyDividedDoNotFold) {
    SurfaceMesh body = make_sphere(8);
    for (auto x : body.vertices.colwise()) x *= 1.0 + 0.3 * std::sin(5.0 * x.x()) * std::cos(4.0 * x.y() + x.z());
    RefinedSurface fine = unrefined(body);
    for (int i = 0; i < 3; ++i) fine = refine_all(fine);
    for (const int n_vertices : {300, 1500, 3000}) {  // the first in two stages
        const ProxySurface proxy = proxy_of(fine.mesh, n_vertices);
        EXPECT_EQ(proxy.kind, ProxySurface::Kind::collapsed);
        EXPECT_NEAR(proxy.surface.n_vertices(), n_vertices, 2) << "at the first attempt";
        EXPECT_NEAR(enclosed_volume(proxy.surface), enclosed_volume(body), 0.02 * enclosed_volume(body));
        EXPECT_LT(largest_distance(body.vertices, proxy.surface), 0.05) << n_vertices;
    }
}

TEST(ProxySurface, AFlatFaceKeepsTrianglesOfOneSize) {
    const ProxySurface proxy = proxy_of(make_box(14), 500);
    EXPECT_EQ(proxy.kind, ProxySurface::Kind::collapsed);
    const MeshReport report = check_and_repair(proxy.surface).report;
    EXPECT_LT(report.longest_edge, 4.0 * report.mean_edge);
    EXPECT_NEAR(report.volume, 1.0, 1e-3);
}

TEST(ProxySurface, AWrapLiesOnTheSurfaceItIsMadeAround) {
    const SurfaceMesh mesh = torn(make_sphere(16), 1e-4);
    const ProxySurface proxy = proxy_of(mesh, 800);
    EXPECT_EQ(proxy.kind, ProxySurface::Kind::wrapped);
    const double ball = enclosed_volume(make_sphere(16));
    EXPECT_NEAR(enclosed_volume(proxy.surface), ball, 0.02 * ball);
}

TEST(ProxySurface, ASmallHoleIsClosedAndASheetGetsAThickness) {
    EXPECT_EQ(proxy_of(sphere_with_hole(12), 500).n_capped_holes, 1);
    const ProxySurface wall = proxy_of(sheet(6), 500);
    EXPECT_EQ(wall.n_capped_holes, 0);
    EXPECT_GT(wall.thin_part, 0.5);
    EXPECT_GT(wall.thickness, 0.0);
    EXPECT_LT(wall.thickness, 0.2);
}

/// A bowl and a plate are as thin beside a rough wrap: the bowl has one side, and becomes as thick as its wraps are
/// coarse; the plate has two, and keeps its thickness.
TEST(ProxySurface, ABowlBecomesAWallAndAThinPlateStaysAsThinAsItIs) {
    const SurfaceMesh bowl = with_hole(make_sphere(16), {0, 0, 1}, 0.3);
    const CheckedMesh checked = check_and_repair(bowl);
    Control control;
    const std::array sizes = {1500, 400};
    const std::vector<ProxySurface> walls = make_proxy_surfaces(checked.mesh, checked.report, sizes, control);
    for (const ProxySurface& wall : walls) EXPECT_GT(wall.thin_part, 0.5);
    EXPECT_GT(walls[1].thickness, 1.5 * walls[0].thickness);

    SurfaceMesh plate = make_box(16);
    plate.vertices.row(2) *= 0.01;
    const ProxySurface proxy = proxy_of(joined(plate, moved(scaled(make_sphere(4), 0.03), {0.5, 0.5, 0.005})), 1500);
    EXPECT_EQ(proxy.kind, ProxySurface::Kind::wrapped);
    EXPECT_LT(proxy.thin_part, 0.1);
    EXPECT_NEAR(enclosed_volume(proxy.surface), 0.01, 0.001);
}

/// A search among thousands of triangles in one place takes minutes.
/// Edges are not collapsed where that would take minutes, and are where it does not.
TEST(ProxySurface, ThousandTrianglesAroundAVertexAreWrapped) {
    for (const int n : {300, 1000}) {
        const ProxySurface proxy = proxy_of(cylinder_of_fans(n), 60);
        EXPECT_EQ(proxy.kind, n > 700 ? ProxySurface::Kind::wrapped : ProxySurface::Kind::collapsed);
        EXPECT_NEAR(enclosed_volume(proxy.surface), 0.3 * std::numbers::pi, 0.05);
        EXPECT_TRUE(can_be_filled(proxy.surface));
    }
}

TEST(ProxySurface, TrianglesThatRepeatOthersChangeNothing) {
    const SurfaceMesh once = sheet(3);
    SurfaceMesh often = once;
    constexpr int kTimes = 2000;
    often.triangles = once.triangles.replicate(1, kTimes);
    for (int t = once.n_triangles(); t < often.n_triangles(); t += 2)
        std::swap(often.triangles(0, t), often.triangles(1, t));
    EXPECT_EQ(proxy_of(often, 200).surface.vertices, proxy_of(once, 200).surface.vertices);
}

/// A ball of 146 vertices that lacks a few triangles is the ball: no hollow shell, and no larger than it was.
TEST(ProxySurface, ABallThatLacksAFewTrianglesIsSolid) {
    const SurfaceMesh ball = make_sphere(6);
    for (const int n_missing : {1, 4, 7}) {
        const SurfaceMesh open = with_hole(without_last(ball, n_missing), {1, 2, 3}, 3.7);
        const ProxySurface proxy = proxy_of(open, 1500);
        EXPECT_EQ(proxy.kind, ProxySurface::Kind::collapsed) << n_missing;
        EXPECT_GT(proxy.n_capped_holes, 0);
        EXPECT_EQ(proxy.n_open_holes, 0);
        EXPECT_LT(proxy.surface.n_vertices(), 170);
        EXPECT_NEAR(enclosed_volume(proxy.surface), enclosed_volume(ball), 0.05 * enclosed_volume(ball));
    }
}

/// Half a ball, by itself a bowl, and as the two that it can be taken for.
TEST(ProxySurface, AnOpenSurfaceIsWhatItIsTakenFor) {
    const SurfaceMesh half = with_hole(make_sphere(10), {0, 0, 1}, 0.0);
    const double volume = 0.5 * enclosed_volume(make_sphere(10));
    const ProxySurface bowl = proxy_of(half, 800), solid = proxy_of(half, 800, OpenSurface::solid),
                       sheet = proxy_of(half, 800, OpenSurface::sheet);
    // The cap goes on as the surface curves at its rim: more than half a ball, less than a whole one.
    EXPECT_GT(enclosed_volume(solid.surface), 0.95 * volume);
    EXPECT_LT(enclosed_volume(solid.surface), 1.6 * volume);
    EXPECT_EQ(solid.n_capped_holes, 1);
    for (const ProxySurface* wall : {&bowl, &sheet}) {
        EXPECT_LT(enclosed_volume(wall->surface), 0.5 * volume);
        EXPECT_GT(wall->thin_part, 0.5);
        EXPECT_EQ(wall->n_open_holes, 1);
    }
}

/// Sheets too: their area is known from a wrap only.
TEST(ProxySurface, IsNotMuchLargerThanAskedFor) {
    for (const int wanted : {50, 150, 1000})
        for (const SurfaceMesh& mesh : {with_hole(make_sphere(12), {0, 0, 1}, 0.0), book(20), random_triangles(20)})
            EXPECT_LT(proxy_of(mesh, wanted).surface.n_vertices(), 1.5 * wanted + 20) << wanted;
}

TEST(ProxySurface, SeveralSizesAtOnceAreOfOneBody) {
    const CheckedMesh checked = check_and_repair(sphere_with_hole(16));
    Control control;
    const std::array sizes = {700, 200};
    const auto proxies = make_proxy_surfaces(checked.mesh, checked.report, sizes, control);
    ASSERT_EQ(proxies.size(), 2u);
    EXPECT_GT(proxies[0].surface.n_vertices(), 2 * proxies[1].surface.n_vertices());
    const double volume = enclosed_volume(proxies[0].surface);
    EXPECT_NEAR(enclosed_volume(proxies[1].surface), volume, 0.05 * volume);
}

TEST(ProxySurface, PointsOnALineAreNoBody) {
    SurfaceMesh line{Positions(3, 3), Triangles(3, 1)};
    line.vertices << 0, 1, 2, 0, 1, 2, 0, 1, 2;
    line.triangles << 0, 1, 2;
    EXPECT_THROW(proxy_of(line, 100), MeshError);
}

TEST(ProxySurface, CanBeCancelled) {
    const CheckedMesh checked = check_and_repair(torn(make_sphere(60), 1e-3));
    Control control;
    control.cancel();
    const std::array sizes = {1000};
    EXPECT_THROW(make_proxy_surfaces(checked.mesh, checked.report, sizes, control), Cancelled);
}

}  // namespace
}  // namespace elastolab
