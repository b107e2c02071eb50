#include "mesh/tets/tetrahedralize.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>
#include <map>
#include <thread>

#include "base/error.hpp"
#include "mesh/closest_point.hpp"
#include "mesh/measures.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "mesh/refine.hpp"
#include "mesh/tets/node_estimate.hpp"
#include "mesh/tets/seed_points.hpp"
#include "mesh/tets/tet_quality.hpp"
#include "mesh/topology.hpp"

namespace elastolab {
namespace {

TetMesh fill(const SurfaceMesh& solid, const TetOptions& options = {}) {
    Control control;
    return tetrahedralize(solid, "body", options, control);
}

/// How many tetrahedra have each face, by its sorted vertices.
std::map<std::array<int, 3>, int> face_counts(const TetMesh& mesh) {
    std::map<std::array<int, 3>, int> counts;
    for (int t = 0; t < mesh.n_tetrahedra(); ++t)
        for (int skip = 0; skip < 4; ++skip) {
            std::array<int, 3> face{};
            for (int c = 0, n = 0; c < 4; ++c)
                if (c != skip) face[static_cast<std::size_t>(n++)] = mesh.tetrahedra(c, t);
            std::sort(face.begin(), face.end());
            ++counts[face];
        }
    return counts;
}

void expect_fills(const TetMesh& mesh, const SurfaceMesh& solid) {
    ASSERT_EQ(mesh.n_surface_vertices, solid.n_vertices());
    EXPECT_EQ(Positions(mesh.vertices.leftCols(solid.n_vertices())), solid.vertices);  // bit by bit
    EXPECT_GT(tet_quality(mesh).least_volume, 0.0);
    const double volume = enclosed_volume(solid);
    EXPECT_NEAR(total_volume(mesh), volume, 1e-12 * volume);
    int n_boundary = 0;
    const auto counts = face_counts(mesh);
    for (const auto& [face, count] : counts) n_boundary += count == 1;
    EXPECT_EQ(n_boundary, solid.n_triangles());
    for (int t = 0; t < solid.n_triangles(); ++t) {
        std::array<int, 3> face{solid.triangles(0, t), solid.triangles(1, t), solid.triangles(2, t)};
        std::sort(face.begin(), face.end());
        const auto found = counts.find(face);
        EXPECT_TRUE(found != counts.end() && found->second == 1) << "triangle " << t;
    }
}

TEST(Tetrahedralize, FillsEveryPrimitiveAndKeepsItsSurface) {
    for (const std::string& name : primitive_names())
        for (const int cells : {1, 2, 5}) {
            SCOPED_TRACE(name + " " + std::to_string(cells));
            const SurfaceMesh solid = make_primitive(name, cells);
            expect_fills(fill(solid), solid);
        }
}

TEST(Tetrahedralize, LeavesCavitiesEmpty) {
    const SurfaceMesh outer = make_box(6);
    const SurfaceMesh holes = joined(moved(inside_out(make_sphere(2, 0.2)), {0.3, 0.3, 0.3}),
                                     moved(inside_out(make_torus(3, 0.15, 0.05)), {0.6, 0.6, 0.7}));
    const SurfaceMesh solid = joined(outer, holes);
    expect_fills(fill(solid), solid);
}

TEST(Tetrahedralize, WorksAtEveryScaleAndPlace) {
    for (const double scale : {1e-9, 1.0, 1e9})
        for (const double offset : {0.0, 1e4}) {
            SCOPED_TRACE(std::to_string(scale) + " " + std::to_string(offset));
            const SurfaceMesh solid = scaled(moved(make_box(3), {offset, -offset, offset}), scale);
            expect_fills(fill(solid), solid);
        }
}

/// How many tetrahedra of a disguised body are not those of the body; interior vertices have the same order.
int n_different(const TetMesh& body, const TetMesh& other, const Disguised& disguise) {
    if (body.n_tetrahedra() != other.n_tetrahedra()) return body.n_tetrahedra();
    int n = 0;
    for (int t = 0; t < body.n_tetrahedra(); ++t) {
        Eigen::Vector4i a = body.tetrahedra.col(t), b = other.tetrahedra.col(t);
        for (int& v : a)
            if (v < body.n_surface_vertices) v = disguise.place[static_cast<std::size_t>(v)];
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        n += a != b;
    }
    return n;
}

TEST(Tetrahedralize, DoesNotDependOnNumberingOrientationAndSize) {
    // A cube's points are on spheres together, eight by eight: only the cavity tells its directions apart.
    const SurfaceMesh cube =
        joined(make_box(4), moved(inside_out(make_box(1, Eigen::Vector3d(0.2, 0.15, 0.1))), {0.15, 0.3, 0.42}));
    for (const SurfaceMesh& solid : {make_lumpy_ball(5), cube}) {
        const TetMesh mesh = fill(solid);
        unsigned seed = 0;
        for (const Eigen::Matrix3d& turn : disguises()) {
            SCOPED_TRACE(testing::Message() << "turned by\n" << turn);
            const Disguised disguise(solid, turn, seed++);
            const TetMesh other = fill(disguise.mesh);
            EXPECT_EQ(n_different(mesh, other, disguise), 0);
            const Eigen::Index n_inside = mesh.n_vertices() - mesh.n_surface_vertices;
            ASSERT_EQ(other.n_vertices(), mesh.n_vertices());
            EXPECT_LT((other.vertices.rightCols(n_inside) - turn * mesh.vertices.rightCols(n_inside)).norm(),
                      1e-12 * other.vertices.norm());
        }
    }
}

TEST(Tetrahedralize, DoesNotDependOnTheNumberingOfASymmetricBody) {
    for (const SurfaceMesh& solid : {make_box(4), make_sphere(3)}) {
        const Disguised disguise(solid, Eigen::Matrix3d::Identity(), 5);
        EXPECT_EQ(n_different(fill(solid), fill(disguise.mesh), disguise), 0);
    }
}

TEST(Tetrahedralize, MakesAboutAsManyInteriorVerticesAsAUniformGridOfTheSurfacesSize) {
    for (const int cells : {8, 13}) {
        const TetMesh mesh = fill(make_box(cells), {.growth = 0.0});
        const double uniform = std::pow(cells - 1, 3), interior = mesh.n_vertices() - mesh.n_surface_vertices;
        EXPECT_GT(interior, 0.87 * uniform) << cells;
        EXPECT_LT(interior, 1.15 * uniform) << cells;
    }
}

TEST(Tetrahedralize, WithoutVolumeBoundNeedsFewerTetrahedra) {
    const SurfaceMesh solid = make_box(8);
    EXPECT_LT(fill(solid, {.relative_volume = 0.0}).n_tetrahedra(), fill(solid).n_tetrahedra());
}

/// The definition of the wanted edge length, vertex by vertex.
double wanted_edge(const SurfaceMesh& solid, double growth, const Eigen::Vector3d& x) {
    const EdgeTable edges(solid);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(solid.n_vertices()), count = sum;
    for (int e = 0; e < edges.size(); ++e)
        for (const int v : {edges[e].a, edges[e].b}) {
            sum[v] += (solid.vertices.col(edges[e].a) - solid.vertices.col(edges[e].b)).norm();
            count[v] += 1.0;
        }
    const double mean = sum.sum() / count.sum();
    double least = std::numeric_limits<double>::max();
    for (int v = 0; v < solid.n_vertices(); ++v)
        least = std::min(least, std::max(sum[v] / count[v], mean) + growth * (x - solid.vertices.col(v)).norm());
    return least;
}

TEST(Tetrahedralize, TetrahedraGrowTowardsTheInsideAsFarAsTheyMay) {
    for (const double growth : {0.1, 0.3}) {
        const SurfaceMesh solid = make_box(9);
        const TetMesh mesh = fill(solid, {.growth = growth});
        int n_larger = 0;
        double largest = 0.0;
        for (int t = 0; t < mesh.n_tetrahedra(); ++t) {
            const Eigen::Vector3d middle = mesh.vertices(Eigen::all, mesh.tetrahedra.col(t)).rowwise().mean();
            const double edge = wanted_edge(solid, growth, middle);
            n_larger += tet_volume(mesh, t) > 1.8 * std::pow(edge, 3) / (6.0 * std::sqrt(2.0));
            largest = std::max(largest, tet_volume(mesh, t));
        }
        // The last step of TetGen moves vertices to improve shapes, and may enlarge some.
        EXPECT_LT(n_larger, 0.01 * mesh.n_tetrahedra()) << growth;
        EXPECT_GT(largest, 1.2 * 1.8 * std::pow(wanted_edge(solid, 0.0, {0, 0, 0}), 3) / (6.0 * std::sqrt(2.0)));
    }
}

TEST(Tetrahedralize, NeedsFewerTetrahedraTheMoreTheyMayGrow) {
    const SurfaceMesh solid = make_lumpy_ball(14);
    const int uniform = fill(solid, {.growth = 0.0}).n_tetrahedra(),
              unbounded = fill(solid, {.relative_volume = 0.0}).n_tetrahedra();
    const int graded = fill(solid, {.growth = 0.2}).n_tetrahedra(), more = fill(solid, {.growth = 0.4}).n_tetrahedra();
    EXPECT_LT(graded, 0.85 * uniform);
    EXPECT_LT(more, 0.95 * graded);
    EXPECT_LT(unbounded, 1.02 * more);
}

TEST(Tetrahedralize, GradesTheInsideTheMoreTheLargerTheSurface) {
    EXPECT_EQ(default_growth(8), 0.0);
    EXPECT_EQ(default_growth(1000), 0.0);
    EXPECT_NEAR(default_growth(40000), 0.35, 0.01);
    EXPECT_LT(default_growth(10000), default_growth(20000));
    const SurfaceMesh solid = make_box(15);  // 1352 vertices
    EXPECT_LT(fill(solid).n_vertices(), fill(solid, {.growth = 0.0}).n_vertices());
    EXPECT_EQ(fill(make_box(6)).vertices, fill(make_box(6), {.growth = 0.0}).vertices);
}

/// A box of few large triangles, one of whose corners is split into many small ones: lengths are those of a far corner.
SurfaceMesh box_with_a_fine_corner(const Eigen::Vector3d& size, int n_rounds) {
    RefinedSurface surface = unrefined(make_box(1, size));
    for (int round = 0; round < n_rounds; ++round) {
        const double reach = 0.4 * std::pow(0.7, round) * size.maxCoeff();
        std::vector<char> marked;
        for (const auto& triangle : surface.mesh.triangles.colwise())
            marked.push_back(surface.mesh.vertices(Eigen::all, triangle).colwise().norm().minCoeff() < reach);
        surface = refine_marked(surface, marked);
    }
    return surface.mesh;
}

Positions seeds_of(const SurfaceMesh& mesh, double growth) {
    const std::vector<double> vertices(mesh.vertices.data(), mesh.vertices.data() + mesh.vertices.size());
    const std::vector<int> triangles(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
    const std::vector<double> seeds = seed_points(vertices, SizeField(vertices, triangles, growth));
    return Eigen::Map<const Eigen::Matrix3Xd>(seeds.data(), 3, std::ssize(seeds) / 3);
}

TEST(Tetrahedralize, SeedsStayClearOfTheSurface) {
    const SurfaceMesh ball = make_sphere(40);
    const Positions seeds = seeds_of(ball, 0.35);
    EXPECT_GT(seeds.cols(), 100);
    Control control;
    EXPECT_GT(closest_points(ball, seeds, control).distance.minCoeff(), mean_edge(ball));
    EXPECT_EQ(seeds_of(ball, 0.0).cols(), 0);
}

/// Where a fine corner tells the lengths far away, large triangles lie beside points of an octree, or under them.
TEST(Tetrahedralize, SeedsStayClearOfLargeTrianglesToo) {
    Control control;
    Eigen::Index n_seeds = 0;
    for (const Eigen::Vector3d& size :
         {Eigen::Vector3d(1, 1, 0.125), Eigen::Vector3d(1, 0.5, 0.25), Eigen::Vector3d(1, 1, 1)}) {
        const SurfaceMesh mesh = box_with_a_fine_corner(size, 8);
        for (const double growth : {0.05, 0.13, 0.35}) {
            const Positions seeds = seeds_of(mesh, growth);
            n_seeds += seeds.cols();
            if (seeds.cols() == 0) continue;
            EXPECT_GT(closest_points(mesh, seeds, control).distance.minCoeff(), 0.5 * mean_edge(mesh)) << growth;
        }
        TetOptions options;
        options.growth = 0.13;
        EXPECT_GT(tetrahedralize(mesh, "box", options, control).n_tetrahedra(), 0);
    }
    EXPECT_GT(n_seeds, 0);
}

TEST(Tetrahedralize, SlenderBodiesGetNoCloudOfSeeds) {
    const SurfaceMesh rod = make_box(6, {60.0, 1.0, 1.0});
    EXPECT_LE(seeds_of(rod, 0.05).cols(), rod.n_vertices());
    EXPECT_LE(seeds_of(rod, 0.35).cols(), rod.n_vertices());
}

TEST(Tetrahedralize, ItsNodesAreEstimatedFromTheSurface) {
    const Eigen::Vector3d far(1e5, -2e5, 3e4);
    const SurfaceMesh flat = make_box(6, Eigen::Vector3d(9, 9, 1));
    for (const SurfaceMesh& solid : {make_box(13), make_box(8, {6, 1, 1}), flat, make_lumpy_ball(20),
                                     make_hollow_sphere(12), make_torus(12), moved(make_lumpy_ball(12), far)}) {
        const double nodes = fill(solid).n_vertices(), estimate = estimated_tet_nodes(solid);
        EXPECT_LT(std::abs(estimate / nodes - 1.0), 0.15) << solid.n_vertices() << ": " << estimate << " " << nodes;
    }
    EXPECT_EQ(estimated_tet_nodes({}), 0.0);
}

std::string failure(const SurfaceMesh& solid) {
    try {
        fill(solid);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "filled";
}

TEST(Tetrahedralize, SaysWhatTetGenFindsInACrossingSurface) {
    const std::string text = failure(joined(make_box(2), moved(make_box(2), {0.3, 0.4, 0.55})));
    EXPECT_THAT(text, testing::StartsWith("body: "));
    EXPECT_THAT(text, testing::HasSubstr("intersects itself"));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("\n")));
}

/// Twisted by so many radians per length about its axis.
SurfaceMesh twisted_bar(double twist) {
    SurfaceMesh bar = moved(make_box(2, {4.0, 1.0, 1.0}), {0.0, -0.5, -0.5});
    for (auto p : bar.vertices.colwise())
        p = Eigen::AngleAxisd(twist * p.x(), Eigen::Vector3d::UnitX()) * Eigen::Vector3d(p);
    return bar;
}

TEST(Tetrahedralize, EndsWhereTetGenAloneWouldNot) {
    EXPECT_EQ(failure(twisted_bar(1.0)), "filled");
    EXPECT_THAT(failure(twisted_bar(4.436)), testing::HasSubstr("TetGen comes to no end"));
}

TEST(Tetrahedralize, SurvivesEveryUnusableSurface) {
    const SurfaceMesh open = without_last(make_box(2), 1);
    SurfaceMesh flat = make_box(2);
    flat.vertices.row(2).setZero();
    SurfaceMesh not_finite = make_box(2);
    not_finite.vertices(1, 3) = NAN;
    SurfaceMesh collapsed = make_box(2);
    collapsed.vertices.col(5) = collapsed.vertices.col(6);
    for (const SurfaceMesh& solid : {open, flat, not_finite, collapsed}) {
        const std::string text = failure(solid);
        EXPECT_THAT(text, testing::StartsWith("body: "));
        EXPECT_THAT(text, testing::Not(testing::HasSubstr("\n")));
    }
}

TEST(Tetrahedralize, StopsSoonAfterACancel) {
    using namespace std::chrono_literals;
    Control control;
    const SurfaceMesh solid = make_box(60);  // takes TetGen many seconds
    std::thread watcher([&] {
        std::this_thread::sleep_for(300ms);
        control.cancel();
    });
    EXPECT_THROW(tetrahedralize(solid, "body", {}, control), Cancelled);
    watcher.join();
}

}  // namespace
}  // namespace elastolab
