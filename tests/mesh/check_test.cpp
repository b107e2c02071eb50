#include "mesh/checks/check.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <random>

#include "base/error.hpp"
#include "mesh/measures.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using Kind = Defect::Kind;

/// How many of one kind; 0 if none.
int count(const MeshReport& report, Kind kind) {
    int n = 0;
    for (const Defect& defect : report.defects)
        if (defect.kind == kind) n += defect.count;
    return n;
}

const Defect& only_defect(const MeshReport& report) {
    EXPECT_EQ(report.defects.size(), 1u);
    return report.defects.front();
}

SurfaceMesh moebius_strip(int n) {
    SurfaceMesh mesh{Positions(3, 2 * n), Triangles(3, 2 * n)};
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * M_PI * i / n;
        for (const int side : {0, 1}) {
            const double r = 1.0 + (side - 0.5) * 0.4 * std::cos(angle / 2);
            mesh.vertices.col(2 * i + side) << r * std::cos(angle), r * std::sin(angle),
                (side - 0.5) * 0.4 * std::sin(angle / 2);
        }
        const bool last = i == n - 1;
        const int next0 = last ? 1 : 2 * i + 2, next1 = last ? 0 : 2 * i + 3;
        mesh.triangles.col(2 * i) << 2 * i, next0, 2 * i + 1;
        mesh.triangles.col(2 * i + 1) << next0, next1, 2 * i + 1;
    }
    return mesh;
}

/// A torus grid glued with a flip: closed, no boundary, one-sided.
SurfaceMesh klein_bottle(int n) {
    SurfaceMesh mesh{Positions(3, n * n), Triangles(3, 2 * n * n)};
    const auto id = [n](int i, int j) { return i < n ? i * n + j % n : (n - j % n) % n; };
    for (int i = 0, t = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double u = 2 * M_PI * i / n, v = 2 * M_PI * j / n;
            const double r = 2 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
            mesh.vertices.col(i * n + j) << r * std::cos(u), r * std::sin(u),
                std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
            mesh.triangles.col(t++) << id(i, j), id(i + 1, j), id(i + 1, j + 1);
            mesh.triangles.col(t++) << id(i, j), id(i + 1, j + 1), id(i, j + 1);
        }
    return mesh;
}

SurfaceMesh jittered(SurfaceMesh mesh, double by) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-by, by);
    for (double& x : mesh.vertices.reshaped()) x += shift(random);
    return mesh;
}

TEST(Check, FindsNothingWrongWithPrimitives) {
    for (const std::string& name : primitive_names())
        for (const int cells : {1, 2, 5, 13}) {
            const SurfaceMesh mesh = make_primitive(name, cells);
            const CheckedMesh checked = check_and_repair(mesh);
            EXPECT_TRUE(checked.report.defects.empty()) << name << " " << checked.report.defects.front().text;
            EXPECT_EQ(checked.mesh.triangles, mesh.triangles);
            EXPECT_TRUE(checked.report.closed);
            EXPECT_EQ(checked.report.n_solids, 1);
            EXPECT_NEAR(checked.report.volume, enclosed_volume(mesh), 1e-12);
        }
}

TEST(Check, FindsNothingWrongFarFromTheOriginOrRotatedOrAtAnyScale) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    for (const std::string& name : primitive_names())
        for (const double scale : {1e-9, 1.0, 1e9, 1e-60, 1e60})
            for (const double offset : {0.0, 1e5}) {
                SurfaceMesh mesh = make_primitive(name, 5);
                mesh.vertices =
                    (scale * ((turn * mesh.vertices).colwise() + Eigen::Vector3d(offset, -offset, 0.3 * offset)))
                        .eval();
                const MeshReport report = check_and_repair(mesh).report;
                EXPECT_TRUE(report.defects.empty())
                    << name << " " << scale << " " << offset << " " << report.defects.front().text;
            }
}

TEST(Check, FindsNothingWrongWithAnIrregularMesh) {
    EXPECT_TRUE(check_and_repair(jittered(make_torus(12), 0.03)).report.defects.empty());
    EXPECT_TRUE(check_and_repair(jittered(make_box(9), 0.02)).report.defects.empty());
}

TEST(Check, MeasuresTheMesh) {
    const MeshReport report = check_and_repair(make_box(2, {2, 2, 2})).report;
    EXPECT_EQ(report.n_components, 1);
    EXPECT_NEAR(report.volume, 8.0, 1e-14);
    EXPECT_NEAR(report.area, 24.0, 1e-13);
    EXPECT_EQ(report.max_corner, Eigen::Vector3d(2, 2, 2));
    EXPECT_EQ(report.shortest_edge, 1.0);
    EXPECT_DOUBLE_EQ(report.longest_edge, std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(report.mean_edge, (2.0 + std::sqrt(2.0)) / 3.0);
    EXPECT_DOUBLE_EQ(report.smallest_altitude_ratio, 0.5);
}

TEST(Check, CountsAndPlacesOpenEdges) {
    const MeshReport report = check_and_repair(without_last(make_box(2), 1)).report;
    const Defect& defect = only_defect(report);
    EXPECT_EQ(defect.kind, Kind::open_edges);
    EXPECT_EQ(defect.count, 3);
    EXPECT_EQ(defect.places.size(), 3u);
    EXPECT_TRUE(defect.fatal);
    EXPECT_FALSE(report.closed);
    EXPECT_FALSE(report.usable());
}

TEST(Check, TurnsTrianglesThatFaceTheOtherWayThanTheirNeighbours) {
    const SurfaceMesh good = make_sphere(4);
    SurfaceMesh bad = good;
    for (const int t : {3, 17, 40}) std::swap(bad.triangles(1, t), bad.triangles(2, t));
    const CheckedMesh checked = check_and_repair(bad);
    EXPECT_EQ(count(checked.report, Kind::inconsistent_orientation), 3);
    EXPECT_TRUE(only_defect(checked.report).repaired);
    EXPECT_TRUE(checked.report.usable_for_fem());
    EXPECT_EQ(checked.mesh.triangles, good.triangles);
}

TEST(Check, TurnsInsideOutSolidsAndKeepsCavities) {
    const SurfaceMesh shell = make_hollow_sphere(3);
    const CheckedMesh kept = check_and_repair(shell);
    EXPECT_EQ(kept.mesh.triangles, shell.triangles);

    const CheckedMesh turned = check_and_repair(inside_out(shell));
    EXPECT_EQ(count(turned.report, Kind::inside_out), 2);
    EXPECT_TRUE(turned.report.usable_for_fem());
    EXPECT_EQ(turned.mesh.triangles, shell.triangles);
}

TEST(Check, OrientsByTheParityOfNesting) {
    // All three face outward: a solid in the cavity of another, and a cube apart that faces inward.
    const SurfaceMesh nested = joined(joined(make_sphere(2, 0.2), make_sphere(3, 0.5)), make_sphere(4, 1.0));
    const CheckedMesh checked = check_and_repair(joined(nested, moved(inside_out(make_box(2)), {3, 0, 0})));
    EXPECT_EQ(count(checked.report, Kind::inside_out), 2);
    EXPECT_EQ(checked.report.n_components, 4);
    EXPECT_EQ(checked.report.n_solids, 3);
    EXPECT_NEAR(checked.report.volume, enclosed_volume(checked.mesh), 1e-12);
    const double expected = enclosed_volume(make_sphere(2, 0.2)) - enclosed_volume(make_sphere(3, 0.5)) +
                            enclosed_volume(make_sphere(4, 1.0)) + 1.0;
    EXPECT_NEAR(checked.report.volume, expected, 1e-12);
}

TEST(Check, DoesNotTakeACrossingSolidForACavity) {
    const SurfaceMesh mesh = joined(make_box(2), moved(scaled(make_box(2), 0.5), {0.25, 0.25, -0.1}));
    const CheckedMesh checked = check_and_repair(mesh);
    EXPECT_EQ(checked.mesh.triangles, mesh.triangles);
    EXPECT_EQ(checked.report.n_solids, 2);
    EXPECT_TRUE(checked.report.usable());
    EXPECT_FALSE(checked.report.usable_for_fem());
}

TEST(Check, FindsCrossingAndTouchingParts) {
    const SurfaceMesh cube = make_box(2);
    const auto crossings = [&](const Eigen::Vector3d& shift) {
        return count(check_and_repair(joined(cube, moved(cube, shift))).report, Kind::self_intersections);
    };
    EXPECT_GT(crossings({0.3, 0.4, 0.55}), 0);  // crossing
    EXPECT_GT(crossings({0.5, 0, 0}), 0);       // crossing, faces in the same planes
    EXPECT_GT(crossings({1, 0, 0}), 0);         // face on face
    EXPECT_GT(crossings({1, 0.3, 0.3}), 0);     // face on face, shifted
    EXPECT_GT(crossings({1, 1, 0}), 0);         // edge on edge
    EXPECT_GT(crossings({1, 1, 1}), 0);         // corner on corner
    EXPECT_EQ(crossings({std::nextafter(1.0, 2.0), 0, 0}), 0);
    EXPECT_EQ(crossings({0, 0, 1.1}), 0);
}

/// Thousands of copies of a triangle would touch the neighbours of each other as often.
TEST(Check, TrianglesThatRepeatOthersCrossNothing) {
    const SurfaceMesh cube = make_box(1);
    const SurfaceMesh crossing = joined(cube, moved(cube, {0.3, 0.4, 0.55}));
    SurfaceMesh often = crossing;
    often.triangles = crossing.triangles.replicate(1, 5000);
    const auto text_of = [](const SurfaceMesh& mesh) {
        const MeshReport report = check_and_repair(mesh).report;
        const auto found = std::ranges::find(report.defects, Kind::self_intersections, &Defect::kind);
        return found == report.defects.end() ? std::string() : found->text;
    };
    EXPECT_THAT(text_of(crossing), testing::HasSubstr("cross or touch"));
    EXPECT_EQ(text_of(often), text_of(crossing));
}

TEST(Check, FindsACornerPushedThroughTheOppositeFace) {
    SurfaceMesh cube = make_box(4);
    for (auto p : cube.vertices.colwise())
        if (p == Eigen::Vector3d(0.5, 0.5, 1.0)) p.z() = -0.5;
    EXPECT_GT(count(check_and_repair(cube).report, Kind::self_intersections), 0);
}

TEST(Check, FindsNeighboursThatFoldOntoEachOther) {
    // A tetrahedron pressed flat: each pair of its triangles shares an edge, and lies in one plane.
    SurfaceMesh flat{Positions(3, 4), Triangles(3, 4)};
    flat.vertices << 0, 1, 0, 0.3, 0, 0, 1, 0.3, 0, 0, 0, 0;
    flat.triangles << 0, 0, 1, 0, 2, 1, 2, 3, 1, 3, 3, 2;
    EXPECT_GT(count(check_and_repair(flat).report, Kind::self_intersections), 0);
    EXPECT_GT(count(check_and_repair(flat).report, Kind::zero_volume), 0);
}

TEST(Check, ReportsOneSidedSurfaces) {
    const MeshReport moebius = check_and_repair(moebius_strip(12)).report;
    EXPECT_GT(count(moebius, Kind::open_edges), 0);
    EXPECT_GT(count(moebius, Kind::inconsistent_orientation), 0);
    const MeshReport klein = check_and_repair(klein_bottle(16)).report;
    EXPECT_EQ(count(klein, Kind::open_edges), 0);
    EXPECT_GT(count(klein, Kind::inconsistent_orientation), 0);
    EXPECT_FALSE(klein.usable());
}

TEST(Check, ReportsEdgesOfMoreThanTwoTriangles) {
    const SurfaceMesh cube = make_box(2);
    const SurfaceMesh fins =
        with_triangle(with_vertex(cube, {3, 3, 3}), cube.triangles(0, 0), cube.triangles(1, 0), cube.n_vertices());
    EXPECT_EQ(count(check_and_repair(fins).report, Kind::non_manifold_edges), 1);
}

TEST(Check, ReportsAVertexThatIsAHinge) {
    // The first vertex of the second cube is the last of the first one.
    SurfaceMesh pair = joined(make_box(2), moved(make_box(2), {1, 1, 1}));
    for (int& v : pair.triangles.reshaped()) v -= v >= 26;
    const Positions vertices = pair.vertices;
    pair.vertices.resize(3, 51);
    pair.vertices << vertices.leftCols(26), vertices.rightCols(25);
    const MeshReport report = check_and_repair(pair).report;
    const Defect& defect = only_defect(report);
    EXPECT_EQ(defect.kind, Kind::non_manifold_vertices);
    EXPECT_EQ(defect.count, 1);
    EXPECT_EQ(defect.places.front(), Eigen::Vector3d(1, 1, 1));
}

TEST(Check, ReportsTrianglesWithoutAreaAndSlivers) {
    SurfaceMesh cube = make_box(2);
    EXPECT_EQ(count(check_and_repair(with_triangle(cube, 3, 3, 4)).report, Kind::degenerate_triangles), 1);
    const auto thin = [](double z) {
        SurfaceMesh plate = make_box(1);
        plate.vertices.row(2) *= z;
        return check_and_repair(plate).report;
    };
    EXPECT_EQ(count(thin(1e-2), Kind::sliver_triangles), 0);
    EXPECT_EQ(count(thin(5e-4), Kind::sliver_triangles), 8);
    EXPECT_TRUE(thin(5e-4).usable());
    EXPECT_THAT(only_defect(thin(5e-5)).text, testing::HasSubstr("fewer than nine digits"));
    EXPECT_EQ(count(thin(0.0), Kind::degenerate_triangles), 8);
}

TEST(Check, ReportsDuplicatesUnusedVerticesAndNumbersThatAreNotFinite) {
    const SurfaceMesh cube = make_box(2);
    const Eigen::Vector3i first = cube.triangles.col(0);
    EXPECT_EQ(
        count(check_and_repair(with_triangle(cube, first[1], first[2], first[0])).report, Kind::duplicate_triangles),
        1);
    const SurfaceMesh more = with_vertex(with_vertex(cube, {4, 4, 4}), {5, 5, 5});
    EXPECT_EQ(count(check_and_repair(more).report, Kind::unreferenced_vertices), 2);
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        SurfaceMesh broken = cube;
        broken.vertices(1, 5) = bad;
        const CheckedMesh checked = check_and_repair(broken);
        EXPECT_EQ(count(checked.report, Kind::non_finite), 1);
        EXPECT_FALSE(checked.report.usable());
        EXPECT_TRUE(checked.mesh.vertices.allFinite());
        EXPECT_EQ(checked.mesh.n_vertices(), cube.n_vertices());
        for (const int v : checked.mesh.triangles.reshaped()) EXPECT_NE(v, 5);
        EXPECT_EQ(count(checked.report, Kind::unreferenced_vertices), 0);
    }
    EXPECT_EQ(only_defect(check_and_repair({}).report).kind, Kind::no_triangles);
}

TEST(Check, ReportsABodyWithoutVolume) {
    SurfaceMesh flat = make_box(3);
    flat.vertices.row(2).setZero();
    EXPECT_FALSE(check_and_repair(flat).report.usable());
}

TEST(Check, KeepsAtMostEightPlaces) {
    const SurfaceMesh cube = without_last(make_box(6), 24);
    const Defect open = check_and_repair(cube).report.defects.back();
    EXPECT_EQ(open.kind, Kind::open_edges);
    EXPECT_GT(open.count, 8);
    EXPECT_EQ(open.places.size(), 8u);
}

TEST(RequireUsable, NamesTheObjectAndEveryFatalFindingInOneLine) {
    const CheckedMesh open = check_and_repair(without_last(make_box(2), 1));
    try {
        require_usable(open.report, "cube.obj", false);
        FAIL();
    } catch (const MeshError& error) {
        EXPECT_THAT(error.what(),
                    testing::MatchesRegex(
                        "cube.obj: 3 open edges near .*, so it bounds no solid. Fill the holes and reload\\."));
    }
    const MeshReport crossing = check_and_repair(joined(make_box(2), moved(make_box(2), {0.5, 0.5, 0.5}))).report;
    EXPECT_NO_THROW(require_usable(crossing, "pair", false));
    EXPECT_THROW(require_usable(crossing, "pair", true), MeshError);
}

/// "No area" or "no volume" would be wrong: the square of an area underflows.
TEST(Check, AMeshOfTinyNumbersIsSaidToBeTooSmall) {
    for (const double size : {1e-80, 1e-100, 1e-150, 1e-300}) {
        const MeshReport report = check_and_repair(scaled(make_box(2), size)).report;
        ASSERT_EQ(report.defects.size(), 1U) << size;
        EXPECT_EQ(report.defects.front().kind, Defect::Kind::too_small);
        EXPECT_FALSE(report.usable());
        EXPECT_NE(report.defects.front().text.find("unit of length"), std::string::npos);
    }
    for (const double size : {1e-69, 1e69}) {
        const MeshReport report = check_and_repair(scaled(make_box(2), size)).report;
        EXPECT_TRUE(report.defects.empty()) << size;
        EXPECT_NEAR(report.volume, size * size * size, 1e-9 * size * size * size);
        EXPECT_NEAR(report.area, 6.0 * size * size, 1e-9 * size * size);
    }
    EXPECT_FALSE(check_and_repair(scaled(make_box(2), 1e100)).report.usable());
}

}  // namespace
}  // namespace elastolab
