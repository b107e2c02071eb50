#include "mesh/primitives.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "mesh/measures.hpp"
#include "mesh/topology.hpp"

namespace elastolab {
namespace {

constexpr double kPi = std::numbers::pi;

int euler_characteristic(const SurfaceMesh& mesh) {
    return mesh.n_vertices() - EdgeTable(mesh).size() + mesh.n_triangles();
}

/// Closed, and every edge is run along once in each direction.
bool is_closed_and_oriented(const SurfaceMesh& mesh) {
    const EdgeTable edges(mesh);
    for (int e = 0; e < edges.size(); ++e) {
        const auto uses = edges.half_edges(e);
        if (uses.size() != 2) return false;
        if (mesh.triangles(uses[0] % 3, uses[0] / 3) == mesh.triangles(uses[1] % 3, uses[1] / 3)) return false;
    }
    return true;
}

double least_altitude_ratio(const SurfaceMesh& mesh) {
    double least = 1.0;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(mesh, t);
        const double longest = std::max({(p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()});
        least = std::min(least, area_vector(p).norm() / (longest * longest));
    }
    return least;
}

TEST(Primitives, AreClosedAndOrientedWithTheRightEulerCharacteristic) {
    for (const std::string& name : primitive_names())
        for (const int cells : {1, 2, 3, 4, 7, 13}) {
            const SurfaceMesh mesh = make_primitive(name, cells);
            EXPECT_TRUE(is_closed_and_oriented(mesh)) << name << " " << cells;
            EXPECT_EQ(euler_characteristic(mesh), name == "torus"           ? 0
                                                  : name == "hollow-sphere" ? 4
                                                                            : 2)
                << name << " " << cells;
            EXPECT_GT(enclosed_volume(mesh), 0.0) << name;
        }
}

TEST(Primitives, HaveWellShapedTriangles) {
    for (const std::string& name : primitive_names())
        for (const int cells : {1, 2, 4, 13})
            EXPECT_GT(least_altitude_ratio(make_primitive(name, cells)), 0.2) << name << " " << cells;
}

TEST(Box, OfACubeHas6NSquaredPlus2Vertices) {
    EXPECT_EQ(make_box(1).n_vertices(), 8);
    EXPECT_EQ(make_box(4).n_vertices(), 98);
    EXPECT_EQ(make_box(13).n_vertices(), 1016);
    EXPECT_EQ(make_box(13).n_triangles(), 12 * 13 * 13);
}

TEST(Box, SpansItsSizeExactlyAndHasItsVolume) {
    const Eigen::Vector3d size(0.1, 0.7, 1.3);
    const SurfaceMesh box = make_box(3, size);
    EXPECT_EQ(Eigen::Vector3d(box.vertices.rowwise().minCoeff()), Eigen::Vector3d::Zero());
    EXPECT_EQ(Eigen::Vector3d(box.vertices.rowwise().maxCoeff()), size);
    EXPECT_NEAR(enclosed_volume(box), size.prod(), 1e-14);
    EXPECT_NEAR(surface_area(box), 2 * (0.07 + 0.91 + 0.13), 1e-12);
    EXPECT_NEAR(mean_edge(make_box(1)), (12.0 + 6.0 * std::sqrt(2.0)) / 18.0, 1e-12) << "twelve sides, six diagonals";
}

TEST(Box, HasCellsInProportionToItsEdges) {
    const SurfaceMesh beam = make_primitive("beam", 2);  // 8 x 2 x 2 cells
    EXPECT_EQ(beam.n_triangles(), 2 * 2 * (8 * 2 + 8 * 2 + 2 * 2));
    EXPECT_NEAR(enclosed_volume(beam), 4.0, 1e-14);
}

TEST(Box, HasAlternatingDiagonals) {
    const SurfaceMesh box = make_box(4);
    const VertexTriangles around(box);
    for (int v = 0; v < box.n_vertices(); ++v) {
        const auto p = box.vertices.col(v).array();
        const bool inside_a_face = ((p == 0.0) || (p == 1.0)).count() == 1;
        const bool even = std::lround(4.0 * p.sum()) % 2 == 0;
        if (inside_a_face) {
            EXPECT_EQ(around[v].size(), even ? 8u : 4u);
        }
    }
}

TEST(Sphere, HasAllVerticesOnTheSphereAndEqualArcsAroundTheEquator) {
    const SurfaceMesh sphere = make_sphere(5, 2.0);
    EXPECT_EQ(sphere.n_vertices(), 4 * 25 + 2);
    EXPECT_LT((sphere.vertices.colwise().norm().array() - 2.0).abs().maxCoeff(), 1e-15 * 4);
    int on_equator = 0;
    for (const auto& p : sphere.vertices.colwise()) on_equator += p.z() == 0.0;
    EXPECT_EQ(on_equator, 20);
}

TEST(CurvedPrimitives, ConvergeToTheVolumesOfTheirShapesWithSecondOrder) {
    const auto order = [](const char* name, double volume) {
        const double coarse = std::abs(enclosed_volume(make_primitive(name, 8)) - volume);
        const double fine = std::abs(enclosed_volume(make_primitive(name, 16)) - volume);
        return std::log2(coarse / fine);
    };
    EXPECT_NEAR(order("sphere", 4.0 / 3.0 * kPi), 2.0, 0.1);
    EXPECT_NEAR(order("cylinder", kPi * 0.25 * 2.0), 2.0, 0.1);
    EXPECT_NEAR(order("torus", 2.0 * kPi * kPi * 0.35 * 0.35), 2.0, 0.3);
    EXPECT_NEAR(order("hollow-sphere", 4.0 / 3.0 * kPi * (1.0 - 0.125)), 2.0, 0.1);
}

TEST(Primitives, RejectBadDescriptionsInOneLine) {
    const auto message = [](const std::string& name, int cells, const std::vector<double>& size) -> std::string {
        try {
            make_primitive(name, cells, size);
        } catch (const MeshError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_THAT(message("dodecahedron", 3, {}), testing::HasSubstr("Use one of: cube"));
    EXPECT_THAT(message("cube", 0, {}), testing::HasSubstr("below 1"));
    EXPECT_THAT(message("cube", -4, {}), testing::HasSubstr("below 1"));
    EXPECT_THAT(message("cube", 4, {1, 2}), testing::HasSubstr("2 sizes"));
    EXPECT_THAT(message("box", 4, {1, 2}), testing::HasSubstr("Give 3"));
    EXPECT_THAT(message("box", 4, {1, 2, -1}), testing::HasSubstr("not positive"));
    EXPECT_THAT(message("sphere", 4, {NAN}), testing::HasSubstr("not positive"));
    EXPECT_THAT(message("sphere", 4, {INFINITY}), testing::HasSubstr("not positive and finite"));
    EXPECT_THAT(message("torus", 4, {1, 2}), testing::HasSubstr("larger radius first"));
    EXPECT_THAT(message("hollow-sphere", 4, {1, 1}), testing::HasSubstr("larger radius first"));
    EXPECT_THAT(message("cube", 2000000000, {}), testing::HasSubstr("lower resolution"));
    EXPECT_THAT(message("box", 1, {1e-9, 1e9, 1}), testing::HasSubstr("lower resolution"));
}

}  // namespace
}  // namespace elastolab
