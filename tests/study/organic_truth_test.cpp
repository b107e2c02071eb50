#include "study/error/organic_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>
#include <map>
#include <set>

#include "elasticity/exact_fields.hpp"
#include "fem/fem_body.hpp"
#include "mesh/rims.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab {
namespace {

const Material kMaterial{.young_modulus = 2.0, .poisson_ratio = 0.3};

double volume(const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (const auto& t : mesh.triangles.colwise())
        sum += mesh.vertices.col(t[0]).dot(mesh.vertices.col(t[1]).cross(mesh.vertices.col(t[2]))) / 6.0;
    return sum;
}

bool closed(const SurfaceMesh& mesh) {
    std::set<std::pair<int, int>> edges;
    for (const auto& t : mesh.triangles.colwise())
        for (int i = 0; i < 3; ++i)
            if (!edges.insert({t[i], t[(i + 1) % 3]}).second) return false;
    return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
        return edges.count({e.second, e.first}) == 1;
    });
}

double smallest_altitude_ratio(const SurfaceMesh& mesh) {
    double least = 1.0;
    for (const auto& t : mesh.triangles.colwise()) {
        const Eigen::Vector3d a = mesh.vertices.col(t[0]), b = mesh.vertices.col(t[1]), c = mesh.vertices.col(t[2]);
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        least = std::min(least, (b - a).cross(c - a).norm() / (longest * longest));
    }
    return least;
}

TEST(OrganicBodies, AreClosedAndIrregularAndHaveTheirPatches) {
    for (const OrganicBody& body : organic_bodies()) {
        SCOPED_TRACE(body.name);
        EXPECT_TRUE(closed(body.surface));
        EXPECT_EQ(body.surface.n_triangles(), 2 * body.surface.n_vertices() - 4);
        EXPECT_GT(volume(body.surface), 1.0);
        EXPECT_GT(smallest_altitude_ratio(body.surface), 0.05);
        std::map<int, int> valence, count;
        for (int v : body.surface.triangles.reshaped()) ++valence[v];
        for (const auto& [v, n] : valence) ++count[n];
        EXPECT_GE(count.size(), 4u);
        EXPECT_GE(body.fixed.size(), 10u);
        EXPECT_GE(body.pull.size(), 6u);
        EXPECT_LT(body.pull.size(), body.surface.vertices.cols() / 10u);
    }
}

TEST(Refinement, KeepsThePolyhedron) {
    const SurfaceMesh coarse = test::boundary(test::make_tet_box({3, 2, 2}, {1.0, 1.0, 1.0}, 0.15));
    RefinedSurface fine = refine_all(unrefined(coarse));
    EXPECT_EQ(fine.mesh.n_triangles(), 4 * coarse.n_triangles());
    std::vector<char> in_region(static_cast<std::size_t>(coarse.n_triangles()), 0);
    for (std::size_t t = 0; t < 5; ++t) in_region[t] = 1;
    for (int round = 0; round < 3; ++round) {
        fine = refine_marked(fine, around_rim(fine, in_region));
        EXPECT_TRUE(closed(fine.mesh));
        EXPECT_NEAR(volume(fine.mesh), 1.0, 1e-13);
        EXPECT_GT(smallest_altitude_ratio(fine.mesh), 0.4 * smallest_altitude_ratio(coarse));
    }
    EXPECT_EQ(fine.mesh.vertices.leftCols(coarse.n_vertices()), coarse.vertices);
    EXPECT_LT((fine.interpolate(coarse.vertices) - fine.mesh.vertices).norm(), 1e-14);
}

TEST(Refinement, GathersLoadsThatDoTheSameWork) {
    const SurfaceMesh coarse = test::boundary(test::make_tet_box({2, 2, 2}, {1.0, 1.0, 1.0}, 0.1));
    const RefinedSurface fine = refine_all(refine_all(unrefined(coarse)));
    const Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Random(3, coarse.n_vertices());
    const Eigen::Matrix3Xd loads = Eigen::Matrix3Xd::Random(3, fine.mesh.n_vertices());
    EXPECT_NEAR(fine.interpolate(u).cwiseProduct(loads).sum(), u.cwiseProduct(fine.gather(loads)).sum(), 1e-10);
}

TEST(Refinement, SplitsTetrahedraInEight) {
    const TetMesh coarse = test::make_tet_box({3, 2, 2}, {1.0, 1.0, 1.0}, 0.15);
    const RefinedSurface surface = refine_all(unrefined(test::boundary(coarse)));
    const TetMesh fine = refine_tetrahedra(coarse, surface);
    double sum = 0.0;
    for (const auto& t : fine.tetrahedra.colwise()) {
        Eigen::Matrix3d edges;
        for (int i = 0; i < 3; ++i) edges.col(i) = fine.vertices.col(t[i + 1]) - fine.vertices.col(t[0]);
        EXPECT_GT(edges.determinant(), 0.0);
        sum += edges.determinant() / 6.0;
    }
    EXPECT_EQ(fine.n_tetrahedra(), 8 * coarse.n_tetrahedra());
    EXPECT_NEAR(sum, 1.0, 1e-13);
    EXPECT_EQ(fine.vertices.leftCols(coarse.n_surface_vertices), coarse.vertices.leftCols(coarse.n_surface_vertices));
    EXPECT_EQ(test::boundary(fine).n_triangles(), surface.mesh.n_triangles());
    EXPECT_NEAR(volume(test::boundary(fine)), 1.0, 1e-13);
}

TEST(Truth, OfAStretchedBoxIsExact) {
    const SurfaceMesh box = test::boundary(test::make_tet_box({4, 2, 2}, {2.0, 1.0, 1.0}, 0.15));
    const UniaxialStretch field{kMaterial};
    const std::vector<int> ends =
        test::vertices_where(box.vertices, box.n_vertices(), [](const auto& p) { return p[0] == 0.0 || p[0] == 2.0; });
    const Positions exact = displacements(field, box.vertices).reshaped(3, box.n_vertices());
    const OrganicTruth truth = compute_truth(box, ends, exact(Eigen::all, ends), kMaterial, {.rim_refinements = 1});
    EXPECT_LT(test::relative_error(truth.displacements, exact), 1e-10);
    EXPECT_LT(truth.relative_error, 1e-10);
}

TEST(Truth, OfAPulledEarIsConverged) {
    const OrganicBody rabbit = make_rabbit(300);
    const OrganicTruth truth =
        compute_truth(rabbit.surface, rabbit.constrained(), rabbit.values(0.1), kMaterial, {.rim_refinements = 2});
    // An order below the errors of the methods (2e-2 to 1e-1).
    EXPECT_LT(truth.relative_error, 6e-3) << truth.n_nodes << " nodes";
    RecordProperty("relative_error", std::to_string(truth.relative_error));
}

}  // namespace
}  // namespace elastolab
