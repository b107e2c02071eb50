#include "bem/collocation/assembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "base/blas.hpp"
#include "bem/collocation/traction_space.hpp"
#include "bem/common.hpp"
#include "elasticity/exact_fields.hpp"
#include "elasticity/rigid_motion.hpp"
#include "mesh/primitives.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab {
namespace {

using test::all_triangles;

constexpr double kTolerance = 1e-10;  // of the integrals

Eigen::MatrixXd matrix(Layer layer, const Boundary& boundary, const CollocationPoints& points, const Elements& elements,
                       const Material& material, double tolerance = kTolerance) {
    Control control;
    Eigen::MatrixXd result(3 * points.size(), 3 * elements.n_slots);
    assemble(layer, boundary, points, elements, material, tolerance, result, control);
    return result;
}

std::vector<std::pair<std::string, SurfaceMesh>> bodies() {
    return {{"cube", make_box(4)},
            {"sphere", make_sphere(4)},
            {"hollow sphere", make_hollow_sphere(3)},
            {"rabbit", make_rabbit(300).surface}};
}

/// Rounding is all that is left of a rotation's tractions: the integrals are exact, and only translations were used for
/// the diagonal. The closed forms lose digits far away, within the tolerance they are told; so none is allowed here.
TEST(BemAssembly, GivesNoTractionToARotationByLinearElements) {
    for (const auto& [name, mesh] : bodies()) {
        const Boundary boundary(mesh);
        for (const double nu : {-0.5, 0.0, 0.3, 0.49, 0.5}) {
            const Eigen::MatrixXd H = matrix(Layer::double_layer, boundary, vertex_collocation_points(boundary),
                                             vertex_elements(boundary), Material{1.0, nu}, 1e-14);
            const Eigen::VectorXd u = rigid_motion(mesh.vertices, Eigen::Vector3d::Zero(), {0.3, -0.5, 0.8});
            EXPECT_LT((H * u).norm(), 1e-13 * H.norm() * u.norm()) << name << ", nu " << nu;
        }
    }
}

TEST(BemAssembly, GivesNoTractionToARotationAtInteriorPoints) {
    const SurfaceMesh mesh = make_rabbit(300).surface;
    const Boundary boundary(mesh);
    const std::vector<int> triangles = {0, 5, 17, 100};
    const Eigen::MatrixXd H = matrix(Layer::double_layer, boundary, inner_collocation_points(boundary, triangles),
                                     vertex_elements(boundary), Material{1.0, 0.3}, 1e-14);
    const Eigen::VectorXd u = rigid_motion(mesh.vertices, Eigen::Vector3d::Zero(), {0.3, -0.5, 0.8});
    EXPECT_LT((H * u).norm(), 1e-13 * H.norm() * u.norm());
}

/// Constant elements know only translations: a rotation leaves a residual that vanishes with the element size.
TEST(BemAssembly, ResistsARotationByConstantElementsAtFirstOrder) {
    const auto residual = [](int cells) {
        const Boundary boundary(make_box(cells));
        const CollocationPoints points = centroid_collocation_points(boundary);
        const Eigen::MatrixXd H = matrix(Layer::double_layer, boundary, points,
                                         constant_elements(all_triangles(boundary)), Material{1.0, 0.3});
        const Eigen::VectorXd u = rigid_motion(points.positions, Eigen::Vector3d::Zero(), {0.3, -0.5, 0.8});
        return (H * u).norm() / u.norm();
    };
    const double coarse = residual(3), fine = residual(6);
    EXPECT_GT(coarse, 1e-4);
    EXPECT_GT(std::log2(coarse / fine), 0.9);
}

/// Where the surface is smooth the free term is half the unit matrix: in the plane of the triangles around a vertex of
/// a face nothing else contributes to the trace.
TEST(BemAssembly, HasHalfTheUnitMatrixAsFreeTermOnAFace) {
    const SurfaceMesh mesh = make_box(4);
    const Boundary boundary(mesh);
    const Elements elements = vertex_elements(boundary);
    const Eigen::MatrixXd H =
        matrix(Layer::double_layer, boundary, vertex_collocation_points(boundary), elements, Material{1.0, 0.3});
    int n_on_faces = 0;
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        const auto& x = mesh.vertices.col(v).array();
        if ((x < 1e-9 || x > 1.0 - 1e-9).count() != 1) continue;
        ++n_on_faces;
        EXPECT_NEAR(H.block(3 * v, 3 * v, 3, 3).trace(), 1.5, 1e-12) << v;
    }
    EXPECT_EQ(n_on_faces, 6 * 9);
}

/// Slot = 3 * position of the triangle in the list + corner: each triangle's own linear functions.
Elements own_elements(std::span<const int> triangles) {
    Elements elements{Elements::Order::linear, 3 * static_cast<int>(triangles.size()), {}};
    for (const int t : triangles) {
        const int first = 3 * static_cast<int>(elements.elements.size());
        elements.elements.push_back({t, {first, first + 1, first + 2}});
    }
    return elements;
}

/// Somigliana: displacements and tractions of a point force outside the body satisfy H u = G t, up to the error of
/// their linear interpolation, which falls with the square of the element size.
double somigliana_defect(int cells, const Material& material) {
    const SurfaceMesh mesh = make_box(cells);
    const Boundary boundary(mesh);
    const PointForceField field{material, {2.6, 0.4, 0.7}, {0.3, 1.0, -0.4}};
    const std::vector<int> triangles = all_triangles(boundary);
    const Eigen::MatrixXd H =
        matrix(Layer::double_layer, boundary, vertex_collocation_points(boundary), vertex_elements(boundary), material);
    const Eigen::MatrixXd G =
        matrix(Layer::single_layer, boundary, vertex_collocation_points(boundary), own_elements(triangles), material);
    Eigen::VectorXd u(3 * mesh.n_vertices()), t(9 * mesh.n_triangles());
    for (int v = 0; v < mesh.n_vertices(); ++v) u.segment<3>(3 * v) = field.displacement(mesh.vertices.col(v));
    for (const int k : triangles)
        for (int corner = 0; corner < 3; ++corner)
            t.segment<3>(9 * k + 3 * corner) = field.stress(mesh.vertices.col(mesh.triangles(corner, k))) *
                                               Eigen::Map<const Eigen::Vector3d>(boundary.triangle(k).n);
    return (H * u - G * t).norm() / (G * t).norm();
}

TEST(BemAssembly, SatisfiesSomiglianasIdentityToSecondOrder) {
    for (const double nu : {-0.3, 0.3, 0.5}) {
        const Material material{2.0, nu};
        const double coarse = somigliana_defect(4, material), fine = somigliana_defect(8, material);
        EXPECT_LT(fine, 3e-2) << "nu " << nu;
        EXPECT_GT(std::log2(coarse / fine), 1.8) << "nu " << nu;
    }
}

TEST(BemAssembly, SumsTheLinearFunctionsOfATriangleToTheConstantOne) {
    const Boundary boundary(make_rabbit(300).surface);
    const std::vector<int> triangles = {3, 50, 200};
    const Material material{1.0, 0.3};
    const CollocationPoints points = centroid_collocation_points(boundary);
    const Eigen::MatrixXd constant =
        matrix(Layer::single_layer, boundary, points, constant_elements(triangles), material);
    const Eigen::MatrixXd linear = matrix(Layer::single_layer, boundary, points, own_elements(triangles), material);
    for (Eigen::Index k = 0; k < 3; ++k) {
        const Eigen::MatrixXd sum =
            linear.middleCols<3>(9 * k) + linear.middleCols<3>(9 * k + 3) + linear.middleCols<3>(9 * k + 6);
        EXPECT_LT((sum - constant.middleCols<3>(3 * k)).norm(), 1e-13 * constant.norm());
    }
}

TEST(BemAssembly, IntegratesATriangleOnceForAllItsTractions) {
    const SurfaceMesh mesh = make_sphere(6);
    const Boundary boundary(mesh);
    std::vector<int> held;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.vertices(2, v) > 0.3) held.push_back(v);
    for (const Tractions tractions : kAllTractions) {
        const TractionSpace space = linear_traction_space(boundary, VertexTriangles(mesh), tractions, held);
        std::vector<int> triangles;
        for (const Elements::Element& element : space.elements.elements) triangles.push_back(element.triangle);
        std::sort(triangles.begin(), triangles.end());
        EXPECT_TRUE(std::adjacent_find(triangles.begin(), triangles.end()) == triangles.end());
        Elements apart{Elements::Order::linear, 0, {}};  // as the blocks of the space have them
        for (const TractionSpace::Block& block : space.blocks) {
            for (Elements::Element element : block.elements) {
                for (int& slot : element.slots)
                    if (slot >= 0) slot += apart.n_slots;
                apart.elements.push_back(element);
            }
            apart.n_slots += block.n_slots;
        }
        ASSERT_EQ(apart.n_slots, space.n_slots());
        const CollocationPoints points = vertex_collocation_points(boundary);
        const Eigen::MatrixXd truth = matrix(Layer::single_layer, boundary, points, apart, Material{1.0, 0.3});
        const Eigen::MatrixXd G = matrix(Layer::single_layer, boundary, points, space.elements, Material{1.0, 0.3});
        EXPECT_LT((G - truth).norm(), 1e-14 * truth.norm());
    }
}

TEST(BemAssembly, DoesNotDependOnTheNumberOfThreads) {
    const Boundary boundary(make_rabbit(300).surface);
    const int threads = thread_count();
    const auto assembled = [&](int n) {
        set_thread_count(n);
        return matrix(Layer::double_layer, boundary, vertex_collocation_points(boundary), vertex_elements(boundary),
                      Material{1.0, 0.3});
    };
    const Eigen::MatrixXd one = assembled(1), three = assembled(3);
    set_thread_count(threads);
    EXPECT_EQ(one, three);
}

/// Long and fine enough that distant pairs are integrated by Gauss rules; numbered at random, so that neighbours in
/// number are far apart.
TEST(BemAssembly, KeepsTheToleranceOnALongBodyNumberedAtRandom) {
    const SurfaceMesh ordered = make_box(2, {40.0, 1.0, 1.0});
    std::vector<int> place(static_cast<std::size_t>(ordered.n_vertices()));
    std::iota(place.begin(), place.end(), 0);
    std::shuffle(place.begin(), place.end(), std::mt19937(41));
    SurfaceMesh shuffled = ordered;
    for (int v = 0; v < ordered.n_vertices(); ++v)
        shuffled.vertices.col(place[static_cast<std::size_t>(v)]) = ordered.vertices.col(v);
    for (int& v : shuffled.triangles.reshaped()) v = place[static_cast<std::size_t>(v)];
    const Boundary boundary(shuffled);
    const auto double_layer = [&](double tolerance) {
        return matrix(Layer::double_layer, boundary, vertex_collocation_points(boundary), vertex_elements(boundary),
                      {1.0, 0.3}, tolerance);
    };
    const Eigen::MatrixXd exact = double_layer(1e-14);
    for (const double tolerance : {1e-6, 1e-10}) {
        const Eigen::MatrixXd H = double_layer(tolerance);
        EXPECT_GT((H - exact).norm(), 0.0);  // the far field is used
        EXPECT_LT((H - exact).norm(), tolerance * exact.norm()) << tolerance;
    }
    const Eigen::VectorXd u = rigid_motion(shuffled.vertices, Eigen::Vector3d::Zero(), {0.3, -0.5, 0.8});
    EXPECT_LT((double_layer(1e-10) * u).norm(), 1e-10 * exact.norm() * u.norm());
}

TEST(BemAssembly, StopsWhenCancelled) {
    const Boundary boundary(make_box(4));
    const CollocationPoints points = vertex_collocation_points(boundary);
    const Elements elements = vertex_elements(boundary);
    Eigen::MatrixXd H(3 * points.size(), 3 * elements.n_slots);
    Control control;
    control.cancel();
    EXPECT_THROW(assemble(Layer::double_layer, boundary, points, elements, Material{}, kTolerance, H, control),
                 Cancelled);
}

}  // namespace
}  // namespace elastolab
