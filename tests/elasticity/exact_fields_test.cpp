#include "elasticity/exact_fields.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "base/lapack.hpp"
#include "elasticity/kelvin.hpp"

namespace elastolab {
namespace {

// Central differences of fourth order, step 1e-3: truncation and rounding both stay near 1e-12 of the field.
constexpr double kStep = 1e-3;
constexpr double kDifferenceError = 1e-9;

template <class Function>
auto derivative(Function&& f, const Eigen::Vector3d& x, int axis) {
    const Eigen::Vector3d h = kStep * Eigen::Vector3d::Unit(axis);
    return ((8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * kStep)).eval();
}

std::vector<Eigen::Vector3d> points_in_shell(double inner, double outer) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> radius(inner, outer);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 20; ++i)
        points.push_back(radius(random) * Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized());
    return points;
}

template <class Field>
void expect_hooke_and_equilibrium(const Field& field, const Material& material) {
    for (const Eigen::Vector3d& x : points_in_shell(0.55, 0.95)) {
        Eigen::Matrix3d gradient;
        Eigen::Vector3d divergence = Eigen::Vector3d::Zero();
        for (int axis = 0; axis < 3; ++axis) {
            gradient.col(axis) = derivative([&](const auto& p) { return field.displacement(p); }, x, axis);
            divergence += derivative([&](const auto& p) { return field.stress(p); }, x, axis).col(axis);
        }
        const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
        const Eigen::Matrix3d sigma = field.stress(x);
        const double scale = sigma.norm() + material.shear_modulus() * gradient.norm();
        EXPECT_LT(divergence.norm(), kDifferenceError * scale);
        EXPECT_LE((sigma - sigma.transpose()).norm(), 1e-15 * scale) << sigma;
        // Hooke's law solved for the strain, so that it also holds at nu = 1/2.
        const double E = material.young_modulus, nu = material.poisson_ratio;
        const Eigen::Matrix3d expected = ((1.0 + nu) * sigma - nu * sigma.trace() * Eigen::Matrix3d::Identity()) / E;
        EXPECT_LT((strain - expected).norm(), kDifferenceError * gradient.norm());
    }
}

class ExactFields : public testing::TestWithParam<double> {
protected:
    Material material{.young_modulus = 3.0, .poisson_ratio = GetParam()};
};

TEST_P(ExactFields, ObeyHookesLawAndEquilibrium) {
    expect_hooke_and_equilibrium(RigidMotionField{{1.0, 2.0, 3.0}, {0.3, -0.2, 0.5}}, material);
    expect_hooke_and_equilibrium(UniaxialStretch{material, 0.7}, material);
    expect_hooke_and_equilibrium(PureBending{material, 0.4}, material);
    expect_hooke_and_equilibrium(Torsion{material, 1.3}, material);
    expect_hooke_and_equilibrium(HollowSphereField{material, 0.5, 1.0, 0.2}, material);
    expect_hooke_and_equilibrium(PointForceField{material, {1.5, 1.0, -1.2}, {0.4, -1.0, 2.0}}, material);
}

TEST_P(ExactFields, LeaveTheirSidesFree) {
    for (const Eigen::Vector3d& x : points_in_shell(0.5, 1.0)) {
        for (int side : {1, 2}) {
            EXPECT_EQ((UniaxialStretch{material}.stress(x) * Eigen::Vector3d::Unit(side)).norm(), 0.0);
            EXPECT_EQ((PureBending{material}.stress(x) * Eigen::Vector3d::Unit(side)).norm(), 0.0);
        }
        const Eigen::Vector3d radial = Eigen::Vector3d(x[0], x[1], 0.0).normalized();
        EXPECT_LT((Torsion{material}.stress(x) * radial).norm(), 1e-14);
        const HollowSphereField sphere{material, 0.5, 1.0, 0.2};
        EXPECT_LT((sphere.stress(x.normalized()) * x.normalized()).norm(), 1e-14);
        EXPECT_LT((sphere.displacement(0.5 * x.normalized()) - 0.2 * x.normalized()).norm(), 1e-15);
    }
}

INSTANTIATE_TEST_SUITE_P(PoissonRatios, ExactFields, testing::Values(-0.3, 0.0, 0.3, 0.5));

/// Integral of f(point, outward normal) over a sphere: Gauss's rule along the axis, trapezoids around it; both
/// converge exponentially for an integrand that is smooth on the sphere.
template <class Function>
Eigen::Matrix3d integrate_over_sphere(const Eigen::Vector3d& centre, double radius, Function&& f) {
    constexpr int kGauss = 48, kAround = 96;
    // Nodes of Gauss's rule are the eigenvalues of the Jacobi matrix of the Legendre polynomials (Golub and Welsch).
    Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(kGauss, kGauss);
    for (int i = 1; i < kGauss; ++i) jacobi(i, i - 1) = i / std::sqrt(4.0 * i * i - 1.0);
    const SymmetricEigen rule = symmetric_eigen(jacobi);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int i = 0; i < kGauss; ++i)
        for (int k = 0; k < kAround; ++k) {
            const double z = rule.values[i], s = std::sqrt(1.0 - z * z);
            const double phi = 2.0 * std::numbers::pi * k / kAround;
            const double weight = 2.0 * std::pow(rule.vectors(0, i), 2) * 2.0 * std::numbers::pi / kAround;
            const Eigen::Vector3d n(s * std::cos(phi), s * std::sin(phi), z);
            sum += radius * radius * weight * f(centre + radius * n, n);
        }
    return sum;
}

TEST(Kelvin, TractionsAroundTheSourceBalanceTheUnitForce) {
    const Eigen::Vector3d centre(0.2, -0.1, 0.4);
    for (double nu : {0.0, 0.3, 0.5})
        for (const Eigen::Vector3d& offset : {Eigen::Vector3d(0.1, 0.2, -0.3), Eigen::Vector3d(0.0, 0.5, 0.0)}) {
            const Eigen::Vector3d x = centre + offset;
            const Eigen::Matrix3d sum = integrate_over_sphere(
                centre, 1.0, [&](const auto& y, const auto& n) { return kelvin_traction(x, y, n, nu); });
            EXPECT_LT((sum + Eigen::Matrix3d::Identity()).norm(), 1e-12) << "nu = " << nu << "\n" << sum;
        }
}

TEST(Kelvin, TractionsAroundNothingVanish) {
    const Eigen::Matrix3d sum = integrate_over_sphere(Eigen::Vector3d::Zero(), 1.0, [&](const auto& y, const auto& n) {
        return kelvin_traction({1.2, 1.0, -0.8}, y, n, 0.3);
    });
    EXPECT_LT(sum.norm(), 1e-12);
}

TEST(Kelvin, DisplacementIsSymmetricAndReciprocal) {
    const Material material{.young_modulus = 2.0, .poisson_ratio = 0.3};
    const Eigen::Vector3d x(0.1, 0.2, 0.3), y(-0.5, 0.9, 0.4);
    const Eigen::Matrix3d U = kelvin_displacement(x, y, material);
    EXPECT_EQ((U - U.transpose()).norm(), 0.0);
    EXPECT_EQ((U - kelvin_displacement(y, x, material)).norm(), 0.0);
}

}  // namespace
}  // namespace elastolab
