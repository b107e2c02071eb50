#include "deform/surface_stress.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "bem/collocation/method.hpp"
#include "deform/deformer.hpp"
#include "elasticity/exact_fields.hpp"
#include "elasticity/neo_hookean.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"

namespace elastolab {
namespace {

constexpr Material kRubber{.young_modulus = 2.0e3, .poisson_ratio = 0.4};

std::vector<int> ends(const SurfaceMesh& bar) {
    std::vector<int> vertices;
    for (int v = 0; v < bar.n_vertices(); ++v)
        if (bar.vertices(0, v) < 1e-9 || bar.vertices(0, v) > 2.0 - 1e-9) vertices.push_back(v);
    return vertices;
}

/// Forces of linear BEM (restricted tractions: exact here) where the ends follow u = (x, -nu y, -nu z).
TEST(SurfaceStress, StretchedBarHasTheStressOfItsStretchEverywhere) {
    const auto bar = std::make_shared<const SurfaceMesh>(make_box(2, {2, 1, 1}));
    const double nu = kRubber.poisson_ratio;
    const Eigen::Matrix3Xd u = Eigen::Vector3d(1, -nu, -nu).asDiagonal() * bar->vertices;
    Control control;
    Deformer deformer(
        precompute({"bar", bar, kRubber}, Method{.kind = kLinearBem, .tractions = Tractions::restricted}, control));
    deformer.constrain({{}, ends(*bar)}, control);
    const Eigen::Matrix3Xd values = u(Eigen::all, ends(*bar));
    const Reactions reactions = deformer.reactions(Eigen::Map<const Eigen::VectorXd>(values.data(), values.size()));

    const Eigen::Matrix3Xd tractions = vertex_tractions(*bar, ends(*bar), reactions.forces);
    const Eigen::VectorXd stress = surface_stress_measure(
        StressMeasure::von_mises, *bar, kRubber, Eigen::Map<const Eigen::VectorXd>(u.data(), u.size()), tractions);
    // The sides have no traction; on the ends the nodal forces are those of hats, which a third of the area is not.
    for (int v = 0; v < bar->n_vertices(); ++v)
        if (bar->vertices(0, v) > 0.1 && bar->vertices(0, v) < 1.9) {
            EXPECT_NEAR(stress[v], kRubber.young_modulus, 1e-9 * kRubber.young_modulus) << v;
        }
    EXPECT_NEAR((tractions.row(0).array().abs() * (tractions.row(0).array().abs() > 0).cast<double>()).maxCoeff(),
                kRubber.young_modulus, 0.5 * kRubber.young_modulus);
}

TEST(SurfaceStress, PressureOnEverySideMakesNoVonMisesStress) {
    const SurfaceMesh cube = make_box(2);
    const double pressure = 10.0, strain = -pressure * (1.0 - 2.0 * kRubber.poisson_ratio) / kRubber.young_modulus;
    const Eigen::Matrix3Xd u = strain * cube.vertices;
    // Flat faces only: at an edge of the cube no single traction is right.
    SurfaceMesh face = cube;
    std::vector<int> top;
    for (int t = 0; t < cube.n_triangles(); ++t)
        if ((cube.vertices(2, cube.triangles.col(t)).array() > 1.0 - 1e-9).all()) top.push_back(t);
    face.triangles = cube.triangles(Eigen::all, top).eval();
    Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, cube.n_vertices());
    tractions.row(2).setConstant(-pressure);
    const Eigen::VectorXd stress = surface_stress_measure(
        StressMeasure::von_mises, face, kRubber, Eigen::Map<const Eigen::VectorXd>(u.data(), u.size()), tractions);
    for (const int t : top)
        for (const int v : face.triangles.col(0)) EXPECT_NEAR(stress[v], 0.0, 1e-9 * pressure) << t;
}

/// A bar that is pulled at one end by a traction, and held by the opposite one at the other.
TEST(SurfaceStress, ALoadedTriangleHasTheStressOfItsLoad) {
    const SurfaceMesh bar = make_box(3, {2, 1, 1});
    const double nu = kRubber.poisson_ratio, pull = 30.0;
    const Eigen::Matrix3Xd u =
        pull / kRubber.young_modulus * (Eigen::Vector3d(1, -nu, -nu).asDiagonal() * bar.vertices).eval();
    const auto end = [&](double x) {
        std::vector<int> triangles;
        for (int t = 0; t < bar.n_triangles(); ++t)
            if ((bar.vertices(0, bar.triangles.col(t)).array() - x).abs().maxCoeff() < 1e-9) triangles.push_back(t);
        return triangles;
    };
    const std::vector<UnitLoad> loads = {unit_traction(end(2.0), Eigen::Vector3d::UnitX()),
                                         unit_pressure(bar, end(0.0)), body_force_along(2)};
    const Eigen::Matrix3Xd of_loads = load_tractions(bar, loads, Eigen::Vector3d(pull, -pull, 7.0));
    const Eigen::MatrixXd stress = surface_stress(bar, kRubber, Eigen::Map<const Eigen::VectorXd>(u.data(), u.size()),
                                                  Eigen::Matrix3Xd::Zero(3, bar.n_vertices()), false, of_loads);
    const Eigen::VectorXd expected = pull * Eigen::VectorXd::Unit(6, 0);
    for (int v = 0; v < bar.n_vertices(); ++v)
        EXPECT_LT((stress.col(v) - expected).cwiseAbs().maxCoeff(), 1e-10 * pull) << v;
}

TEST(SurfaceStress, ARotationMakesNone) {
    const SurfaceMesh sphere = make_sphere(4);
    const Eigen::Matrix3d spin = (Eigen::Matrix3d() << 0, -0.3, 0.2, 0.3, 0, -0.1, -0.2, 0.1, 0).finished();
    const Eigen::Matrix3Xd u = spin * sphere.vertices;
    const Eigen::VectorXd stress = surface_stress_measure(StressMeasure::von_mises, sphere, kRubber,
                                                          Eigen::Map<const Eigen::VectorXd>(u.data(), u.size()),
                                                          Eigen::Matrix3Xd::Zero(3, sphere.n_vertices()));
    EXPECT_LT(stress.maxCoeff(), 1e-12 * kRubber.young_modulus);
}

/// A grip around edges and corners: forces of sigma n over the triangles of each vertex, whose sum one traction is not.
TEST(SurfaceStress, IsThatOfHomogeneousStrainsAtEdgesInsideAGripToo) {
    const SurfaceMesh box = make_box(3, {2.0, 1.0, 0.7});
    const Eigen::Matrix3d gradient =
        (Eigen::Matrix3d() << 0.1, 0.05, 0.0, -0.02, -0.05, 0.03, 0.04, 0.0, -0.05).finished();  // keeps the volume
    const Eigen::Matrix3Xd u = gradient * box.vertices;
    const Eigen::Map<const Eigen::VectorXd> all(u.data(), u.size());
    std::vector<int> everywhere(static_cast<std::size_t>(box.n_vertices()));
    std::iota(everywhere.begin(), everywhere.end(), 0);
    for (const bool large : {false, true})
        for (const double nu : {0.0, 0.3, 0.499, 0.5}) {
            if (large && nu == 0.5) continue;
            const Material material{kRubber.young_modulus, nu};
            const NeoHookean law({kRubber.young_modulus, std::min(nu, 0.499)});
            const Eigen::Matrix3d hooke_stress = stress_tensor(hooke(gradient, material));
            const Eigen::Matrix3d nominal = large ? law.first_piola(gradient) : hooke_stress;
            Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, box.n_vertices());
            for (int t = 0; t < box.n_triangles(); ++t)
                for (const int v : box.triangles.col(t))
                    forces.col(v) += nominal * area_vector(triangle_points(box, t)) / 6.0;
            const Eigen::MatrixXd stress =
                surface_stress(box, material, all, vertex_tractions(box, everywhere, forces), large);
            const StressNumbers expected = large ? stress_numbers(law.cauchy(gradient)) : stress_numbers(hooke_stress);
            for (int v = 0; v < box.n_vertices(); ++v)
                EXPECT_LT((stress.col(v) - expected).norm(), 1e-8 * expected.norm())
                    << v << ", nu " << nu << (large ? ", large" : "");
        }
}

/// A sheet of no thickness: two opposite faces say nothing of what presses on them.
TEST(SurfaceStress, IsFiniteWhereFacesAreOpposite) {
    SurfaceMesh sheet;
    sheet.vertices = Eigen::Matrix3d::Identity();
    sheet.triangles = (Triangles(3, 2) << 0, 0, 1, 2, 2, 1).finished();
    const Eigen::Matrix3Xd u = 0.1 * sheet.vertices, tractions = 300.0 * sheet.vertices;
    for (const bool large : {false, true}) {
        EXPECT_TRUE(surface_stress(sheet, kRubber, u.reshaped(), tractions, large).allFinite()) << large;
    }
}

/// Of a modulus whose squares are less than numbers can be.
TEST(SurfaceStress, DoesNotDependOnTheUnitOfForce) {
    constexpr double kUnit = 0x1p-560;
    const SurfaceMesh cube = make_box(2);
    const Material tiny{kUnit * kRubber.young_modulus, kRubber.poisson_ratio};
    const Eigen::Matrix3d gradient = (Eigen::Matrix3d() << 0.1, 0.05, 0, -0.02, -0.05, 0.03, 0.04, 0, 0.02).finished();
    const Eigen::Matrix3Xd u = gradient * cube.vertices;
    const Eigen::Matrix3Xd tractions =
        0.05 * kRubber.young_modulus * (cube.vertices.colwise() + Eigen::Vector3d(0.3, 0.2, 0.1));
    const Eigen::Map<const Eigen::VectorXd> all(u.data(), u.size());
    for (const bool large : {false, true}) {
        const Eigen::MatrixXd stress = surface_stress(cube, kRubber, all, tractions, large);
        const Eigen::MatrixXd scaled = surface_stress(cube, tiny, all, kUnit * tractions, large) / kUnit;
        EXPECT_LT((scaled - stress).cwiseAbs().maxCoeff(), 1e-9 * stress.cwiseAbs().maxCoeff()) << large;
    }
}

}  // namespace
}  // namespace elastolab
