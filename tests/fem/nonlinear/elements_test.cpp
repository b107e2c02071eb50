// Neo-Hookean material and elements: derivatives, rigid motions, homogeneous states, and vector lanes against one.
#include "fem/nonlinear/elements.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/lapack.hpp"
#include "elasticity/neo_hookean.hpp"
#include "fem/assembly.hpp"
#include "fem/nonlinear/bodies.hpp"

namespace elastolab {
namespace {

using Eigen::Matrix3d;
using test::affine;
using test::elements_of_box;
using test::rotation;

constexpr double kDifferenceStep = 1e-5;  // central differences: third derivatives times its square, 1e-10
constexpr double kDifferenceError = 1e-8;
constexpr double kElementRounding = 1e-12;

Matrix3d random_gradient(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    return Matrix3d::NullaryExpr([&] { return uniform(random); });
}

class MaterialElements : public testing::TestWithParam<ElementDegree> {};
INSTANTIATE_TEST_SUITE_P(Elements, MaterialElements, testing::Values(ElementDegree::linear, ElementDegree::quadratic),
                         [](const auto& degree) {
                             return degree.param == ElementDegree::linear ? "FourNodes" : "TenNodes";
                         });

TEST(NeoHookean, StressIsTheDerivativeOfTheEnergyAndTheTangentThatOfTheStress) {
    const NeoHookean law(Material{1.0, 0.35});
    std::mt19937 random(3);
    for (int trial = 0; trial < 20; ++trial) {
        const Matrix3d H = random_gradient(random, 0.3);
        const Matrix3d P = law.first_piola(H);
        const ElasticTensor A = law.tangent(H);
        for (int k = 0; k < 9; ++k) {
            Matrix3d step = Matrix3d::Zero();
            step(k % 3, k / 3) = kDifferenceStep;
            EXPECT_NEAR((law.energy(H + step) - law.energy(H - step)) / (2 * kDifferenceStep), P(k % 3, k / 3),
                        kDifferenceError);
            const Matrix3d dP = (law.first_piola(H + step) - law.first_piola(H - step)) / (2 * kDifferenceStep);
            EXPECT_LT((Eigen::Map<const Eigen::Vector<double, 9>>(dP.data()) - A.col(k)).norm(), 10 * kDifferenceError);
        }
    }
}

TEST(NeoHookean, ProjectedTangentIsTheTangentWhereThatIsPositiveAndPositiveElsewhere) {
    const NeoHookean law(Material{1.0, 0.35});
    std::mt19937 random(4);
    int n_indefinite = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Matrix3d H = random_gradient(random, 0.7);
        if (volume_change(H) < -0.9) continue;
        const ElasticTensor A = law.tangent(H), projected = law.projected_tangent(H);
        const double least = symmetric_eigen(A).values[0];
        const double least_projected = symmetric_eigen(projected).values[0];
        const double allowed = 1e-9 * A.norm();
        EXPECT_GT(least_projected, kLeastEigenvalue * law.mu - allowed);
        if (least > kLeastEigenvalue * law.mu)
            EXPECT_LT((A - projected).norm(), allowed);
        else
            ++n_indefinite;
    }
    EXPECT_GT(n_indefinite, 10);
}

TEST(NeoHookean, CauchyStressAgreesWithHookeForSmallStrainsAndTurnsWithTheBody) {
    const Material material{2.0, 0.3};
    const NeoHookean law(material);
    std::mt19937 random(5);
    const Matrix3d G = 1e-7 * random_gradient(random, 1.0);
    const Matrix3d hooke_stress = stress_tensor(hooke(G, material));
    EXPECT_LT((law.cauchy(G) - hooke_stress).norm(), 1e-6 * hooke_stress.norm());
    const Matrix3d H = random_gradient(random, 0.3), R = rotation({1, 2, 3}, 77);
    const Matrix3d turned = R * (Matrix3d::Identity() + H) - Matrix3d::Identity();
    EXPECT_LT((law.cauchy(turned) - R * law.cauchy(H) * R.transpose()).norm(), kElementRounding);
}

TEST_P(MaterialElements, ForcesAreTheGradientOfTheEnergyAndTheStiffnessThatOfTheForces) {
    const auto elements = elements_of_box({2, 2, 2}, {1, 1, 1}, GetParam(), 0.1);
    const Material material{1.0, 0.35};
    ElementWork work = elements->make_work();
    Control control;
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto noise = [&](double size) {
        return Eigen::VectorXd(
            Eigen::VectorXd::NullaryExpr(3 * elements->n_nodes(), [&] { return size * uniform(random); }));
    };
    const Eigen::VectorXd u =
        affine(*elements, rotation({1, 1, 0}, 40) * Eigen::Vector3d(1.3, 0.9, 0.8).asDiagonal()) + noise(0.02);
    const Eigen::VectorXd f = elements->forces(u, material, work, control);
    for (int trial = 0; trial < 4; ++trial) {
        const Eigen::VectorXd d = noise(1.0);
        const double rise = (elements->energy(u + kDifferenceStep * d, material, work, control).energy -
                             elements->energy(u - kDifferenceStep * d, material, work, control).energy) /
                            (2 * kDifferenceStep);
        EXPECT_NEAR(rise, f.dot(d), 1e-7 * std::abs(rise));
        const Eigen::VectorXd change = (elements->forces(u + kDifferenceStep * d, material, work, control) -
                                        elements->forces(u - kDifferenceStep * d, material, work, control)) /
                                       (2 * kDifferenceStep);
        const Eigen::VectorXd Kd = elements->force_change(u, d, material, work, control);
        EXPECT_LT((change - Kd).norm(), 1e-7 * Kd.norm());
        const FreeTangent tangent(elements, {}, control);
        SparseMatrix K = tangent.make_matrix();
        elements->stiffness(u, material, false, work, control);
        tangent.assemble(work, 0.0, K, control);
        EXPECT_LT((K.selfadjointView<Eigen::Lower>() * d - Kd).norm(), kElementRounding * Kd.norm());
    }
}

TEST_P(MaterialElements, RigidMotionLeavesTheEnergyAndTurnsTheForces) {
    const auto elements = elements_of_box({2, 2, 2}, {1, 1, 1}, GetParam(), 0.1);
    const Material material{1.0, 0.35};
    ElementWork work = elements->make_work();
    Control control;
    const Matrix3d F = Eigen::Vector3d(1.4, 0.8, 0.9).asDiagonal(), R = rotation({3, -1, 2}, 130);
    Eigen::VectorXd u = affine(*elements, F);
    u.array() += 0.01 * Eigen::ArrayXd::LinSpaced(u.size(), 0, 300).sin();
    const Eigen::Matrix3Xd x = elements->positions() + u.reshaped(3, elements->n_nodes());
    const Eigen::VectorXd turned = ((R * x).colwise() + Eigen::Vector3d(5, -3, 2) - elements->positions()).reshaped();
    const double energy = elements->energy(u, material, work, control).energy;
    EXPECT_NEAR(elements->energy(turned, material, work, control).energy, energy, kElementRounding * energy);
    const Eigen::Matrix3Xd f = elements->forces(u, material, work, control).reshaped(3, x.cols());
    const Eigen::Matrix3Xd g = elements->forces(turned, material, work, control).reshaped(3, x.cols());
    EXPECT_LT((g - R * f).norm(), kElementRounding * f.norm());
    const Eigen::VectorXd rigid = affine(*elements, R, {1, 2, 3});
    EXPECT_LT(elements->energy(rigid, material, work, control).energy, 1e-24);
}

TEST_P(MaterialElements, HomogeneousStatesAreContained) {
    const auto elements = elements_of_box({2, 2, 3}, {1, 1, 2}, GetParam(), 0.1);
    const Material material{1.0, 0.3};
    const NeoHookean law(material);
    ElementWork work = elements->make_work();
    Control control;
    Matrix3d shear = Matrix3d::Identity();
    shear(0, 1) = 0.8;
    for (const Matrix3d& F : {shear, Matrix3d(1.7 * Matrix3d::Identity()), Matrix3d(0.5 * Matrix3d::Identity())}) {
        const Eigen::VectorXd u = affine(*elements, F);
        const BodyEnergy energy = elements->energy(u, material, work, control);
        const double exact = 2.0 * law.energy(F - Matrix3d::Identity());
        EXPECT_NEAR(energy.energy, exact, kElementRounding * exact);
        EXPECT_NEAR(energy.least_J, F.determinant(), kElementRounding);
        const Eigen::VectorXd f = elements->forces(u, material, work, control);
        for (int node = 0; node < elements->n_nodes(); ++node) {
            const Eigen::Vector3d p = elements->positions().col(node);
            if ((p.array() > 0.0).all() && (p.array() < Eigen::Array3d(1, 1, 2)).all()) {
                EXPECT_LT(f.segment<3>(3 * node).norm(), kElementRounding * f.norm()) << node;
            }
        }
    }
}

TEST_P(MaterialElements, TangentAtRestIsTheLinearStiffness) {
    const TetMesh mesh = test::make_tet_box({2, 2, 2}, {1, 1, 1}, 0.1);
    const auto elements = elements_of_box({2, 2, 2}, {1, 1, 1}, GetParam(), 0.1);
    const Material material{1.5, 0.3};
    Control control;
    ElementWork work = elements->make_work();
    const FreeTangent tangent(elements, {}, control);
    SparseMatrix K = tangent.make_matrix();
    elements->stiffness(Eigen::VectorXd::Zero(3 * elements->n_nodes()), material, false, work, control);
    tangent.assemble(work, 0.0, K, control);
    // Ten nodes: the linear stiffness is integrated exactly, as four Gauss points do for straight edges.
    const StiffnessParts parts = GetParam() == ElementDegree::linear
                                     ? assemble_stiffness_parts(mesh, control)
                                     : assemble_stiffness_parts(QuadraticMesh(mesh), control);
    const SparseMatrix exact = stiffness(parts, material);
    const Eigen::MatrixXd whole = Eigen::MatrixXd(K).selfadjointView<Eigen::Lower>();
    EXPECT_LT((whole - Eigen::MatrixXd(exact)).norm(), kElementRounding * exact.norm());
}

TEST_P(MaterialElements, SmallDisplacementsKeepTheirDigits) {
    const auto elements = elements_of_box({2, 2, 2}, {1, 1, 1}, GetParam(), 0.1);
    const Material material{1.0, 0.3};
    Control control;
    ElementWork work = elements->make_work();
    const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(3 * elements->n_nodes(), 0, 200).array().sin();
    const Eigen::VectorXd linear = elements->force_change(Eigen::VectorXd::Zero(d.size()), d, material, work, control);
    const Eigen::VectorXd f = elements->forces(1e-13 * d, material, work, control);
    EXPECT_LT((f - 1e-13 * linear).norm(), 1e-11 * f.norm());
    const double energy = elements->energy(1e-13 * d, material, work, control).energy, half = 0.5e-26 * d.dot(linear);
    EXPECT_NEAR(energy, half, 1e-11 * half);
}

TEST_P(MaterialElements, VectorLanesAgreeWithPlainOnes) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    const int n = GetParam() == ElementDegree::linear ? 4 : 10;
    const auto elements = elements_of_box({1, 1, 2}, {1, 1, 1}, GetParam(), 0.1);
    ElementPack pack;
    std::vector<double> u(static_cast<std::size_t>(3 * n * kPack)), d = u;
    for (double& value : u) value = uniform(random);
    for (double& value : d) value = uniform(random);
    for (int lane = 0; lane < kPack; ++lane) {
        Eigen::Matrix3d edges = Matrix3d::Identity() + random_gradient(random, 0.3);
        const Matrix3d inverse = edges.inverse();
        for (int i = 0; i < 3; ++i) {
            for (int c = 1; c < 4; ++c) pack.gradients[c][i][lane] = inverse(c - 1, i);
            pack.gradients[0][i][lane] = -inverse.col(i).sum();
        }
        pack.volume[lane] = edges.determinant() / 6.0;
    }
    struct Out {
        std::vector<double> energy = std::vector<double>(kPack), least_J = energy,
                            forces = std::vector<double>(30 * kPack), stiffness = std::vector<double>(55 * 9 * kPack),
                            change = std::vector<double>(30 * kPack);
    };
    const auto run = [&](const ElementKernels& kernels, Out& out) {
        const PackResult result{out.energy.data(),    out.least_J.data(), out.forces.data(),
                                out.stiffness.data(), d.data(),           out.change.data()};
        (n == 4 ? kernels.linear : kernels.quadratic)(pack, u.data(), 0.4, 0.7, result);
    };
    Out plain, best;
    run(plain_element_kernels(), plain);
    run(best_element_kernels(), best);
    for (const auto& [a, b] : {std::pair(&plain.energy, &best.energy),
                               {&plain.least_J, &best.least_J},
                               {&plain.forces, &best.forces},
                               {&plain.stiffness, &best.stiffness},
                               {&plain.change, &best.change}})
        for (std::size_t i = 0; i < a->size(); ++i) EXPECT_NEAR((*a)[i], (*b)[i], kElementRounding);
}

TEST(FiniteElements, AnInvertedElementHasInfiniteEnergy) {
    const auto elements = elements_of_box({1, 1, 1}, {1, 1, 1}, ElementDegree::linear);
    ElementWork work = elements->make_work();
    Control control;
    const Matrix3d mirror = Eigen::Vector3d(-0.5, 1, 1).asDiagonal();
    const BodyEnergy energy = elements->energy(affine(*elements, mirror), Material{1.0, 0.3}, work, control);
    EXPECT_TRUE(std::isinf(energy.energy));
    EXPECT_NEAR(energy.least_J, -0.5, kElementRounding);
}

}  // namespace
}  // namespace elastolab
