#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "base/blas.hpp"
#include "base/lapack.hpp"
#include "bem/common.hpp"
#include "bem/galerkin/hypersingular.hpp"
#include "bem/galerkin/traction_rows.hpp"
#include "elasticity/close_pairs.hpp"
#include "elasticity/exact_fields.hpp"
#include "elasticity/kelvin.hpp"
#include "elasticity/rigid_motion.hpp"
#include "elasticity/triangle_rules.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using test::all_triangles;
using test::kUnitMaterial;

constexpr double kDefaultTolerance = 1e-8;

std::vector<std::pair<const char*, SurfaceMesh>> primitives() {
    return {{"cube", make_box(3)},
            {"sphere", make_sphere(3)},
            {"torus", make_torus(3)},
            {"hollow sphere", make_hollow_sphere(2)}};
}

Eigen::MatrixXd hypersingular(const Boundary& boundary, const Material& material,
                              double tolerance = kDefaultTolerance) {
    Control control;
    Eigen::MatrixXd D(3 * boundary.mesh().n_vertices(), 3 * boundary.mesh().n_vertices());
    assemble_hypersingular(boundary, material, tolerance, D, control);
    return D;
}

TractionRows traction_rows(const Boundary& boundary, const std::vector<int>& triangles, const Material& material,
                           double tolerance = kDefaultTolerance) {
    Control control;
    return assemble_traction_rows(boundary, triangles, material, tolerance, control);
}

TEST(Galerkin, OperatorsAnnihilateRigidMotions) {
    for (const auto& [name, mesh] : primitives())
        for (const double tolerance : {1e-6, 1e-8, 1e-11}) {
            const Boundary boundary(mesh);
            const Eigen::MatrixXd modes = rigid_modes(mesh.vertices);
            for (const double nu : {0.0, 0.3, 0.5}) {
                const Eigen::MatrixXd D = hypersingular(boundary, {1.0, nu}, tolerance);
                EXPECT_LT((D * modes).norm(), tolerance * D.norm()) << name << ", nu " << nu;
                const Eigen::MatrixXd K = traction_rows(boundary, {0, 5, 17, 20}, {1.0, nu}, tolerance).double_layer;
                EXPECT_LT((K * modes).norm(), tolerance * K.norm()) << name << ", nu " << nu;
            }
        }
}

/// Beyond the six of the whole body there are those of each further closed surface, and no others.
TEST(Galerkin, HypersingularOperatorIsSymmetricAndPositiveOffTheRigidMotions) {
    for (const auto& [name, mesh] : primitives()) {
        const Eigen::MatrixXd D = hypersingular(Boundary(mesh), kUnitMaterial);
        EXPECT_EQ((D - D.transpose()).norm(), 0.0) << name;
        const Eigen::VectorXd values = symmetric_eigen(D).values;
        const Eigen::Index n_null = std::string(name) == "hollow sphere" ? 12 : 6;
        EXPECT_LT(values.head(n_null).cwiseAbs().maxCoeff(), 1e-8 * values.tail(1)[0]) << name;
        EXPECT_GT(values[n_null], 1e-3 * values.tail(1)[0]) << name;
    }
}

/// Constant tractions and linear displacements hold this field on any body with flat triangles.
TEST(Galerkin, BothBoundaryEquationsHoldForALinearField) {
    Eigen::Matrix3d gradient;
    gradient << 0.3, 0.1, -0.2, 0.5, -0.4, 0.7, 0.1, 0.2, 0.6;
    const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
    const Eigen::Matrix3d stress = 2.0 * kUnitMaterial.shear_modulus() * strain +
                                   kUnitMaterial.lame_lambda() * strain.trace() * Eigen::Matrix3d::Identity();
    for (const auto& [name, mesh] : primitives())
        for (const double tolerance : {1e-8, 1e-11}) {
            const Boundary boundary(mesh);
            const std::vector<int> all = all_triangles(boundary);
            const TractionRows rows = traction_rows(boundary, all, kUnitMaterial, tolerance);
            const Eigen::Matrix3Xd displacement = gradient * mesh.vertices;
            const Eigen::Map<const Eigen::VectorXd> u(displacement.data(), displacement.size());
            Eigen::VectorXd t(3 * boundary.n_triangles());
            for (const int i : all)
                t.segment<3>(3 * i) = stress * Eigen::Map<const Eigen::Vector3d>(boundary.triangle(i).n);
            const Eigen::VectorXd Ku = rows.double_layer * u;
            EXPECT_LT((rows.single_layer * t - Ku).norm(), tolerance * Ku.norm()) << name;
            const Eigen::VectorXd load =
                traction_mass(boundary, all).transpose() * t - rows.double_layer.transpose() * t;
            const Eigen::VectorXd Du = hypersingular(boundary, kUnitMaterial, tolerance) * u;
            EXPECT_LT((Du - load).norm(), tolerance * Du.norm()) << name;
        }
}

/// A point force outside a cube: its tractions at the centroids and displacements at the vertices.
TEST(Galerkin, ResidualsOfASmoothFieldFallWithTheMeshSize) {
    const PointForceField field{kUnitMaterial, {1.8, 0.6, 0.7}, {0.3, -0.5, 0.8}};
    const auto residuals = [&](int cells) {
        const Boundary boundary(make_box(cells));
        const std::vector<int> all = all_triangles(boundary);
        const TractionRows rows = traction_rows(boundary, all, kUnitMaterial);
        const Eigen::VectorXd u = displacements(field, boundary.mesh().vertices);
        Eigen::VectorXd t(3 * boundary.n_triangles());
        for (const int i : all) {
            const TriangleGeometry& T = boundary.triangle(i);
            t.segment<3>(3 * i) =
                field.stress(Eigen::Map<const Eigen::Vector3d>(T.centroid)) * Eigen::Map<const Eigen::Vector3d>(T.n);
        }
        const Eigen::VectorXd Ku = rows.double_layer * u, Du = hypersingular(boundary, kUnitMaterial) * u;
        const Eigen::VectorXd load = traction_mass(boundary, all).transpose() * t - rows.double_layer.transpose() * t;
        return Eigen::Vector2d((rows.single_layer * t - Ku).norm() / Ku.norm(), (Du - load).norm() / Du.norm());
    };
    const Eigen::Vector2d coarse = residuals(3), fine = residuals(6);
    EXPECT_GT(std::log2(coarse[0] / fine[0]), 1.5) << coarse.transpose() << " " << fine.transpose();
    EXPECT_GT(std::log2(coarse[1] / fine[1]), 0.7) << coarse.transpose() << " " << fine.transpose();
}

TEST(Galerkin, HypersingularOperatorDoesNotDependOnTheNumberOfThreads) {
    const Boundary boundary(make_box(4));
    const int before = thread_count();
    set_thread_count(1);
    const Eigen::MatrixXd one = hypersingular(boundary, kUnitMaterial);
    set_thread_count(3);
    const Eigen::MatrixXd three = hypersingular(boundary, kUnitMaterial);
    set_thread_count(before);
    EXPECT_TRUE(one == three);
}

TEST(Galerkin, PartsOfTheHypersingularOperatorServeEveryPoissonRatio) {
    const Boundary boundary(make_sphere(2));
    Control control;
    const HypersingularParts parts(boundary, kDefaultTolerance, control);
    for (const double nu : {-0.4, 0.0, 0.3, 0.5}) {
        const Material material{2.5, nu};
        Eigen::MatrixXd D(parts.with_nu.rows(), parts.with_nu.cols());
        parts.evaluate(material, D);
        const Eigen::MatrixXd expected = hypersingular(boundary, material);
        EXPECT_LT((D - expected).norm(), 1e-14 * expected.norm());
    }
}

/// The three integrals of the definition, with Guenter's derivatives index by index, over triangles far enough apart
/// for a plain product rule.
TEST(Galerkin, HypersingularEntriesAreThoseOfTheDefinition) {
    const SurfaceMesh mesh = make_box(4);
    const Boundary boundary(mesh);
    const Eigen::MatrixXd D = hypersingular(boundary, kUnitMaterial, 1e-11);
    const double mu = kUnitMaterial.shear_modulus(), pi = std::acos(-1.0);
    const TriangleRule& rule = triangle_rule(8);
    // M_ij = n_j d_i - n_i d_j of the hat of corner k.
    const auto guenter = [&](int t, int k) {
        const TriangleGeometry& T = boundary.triangle(t);
        Eigen::Vector3d gradient, n = Eigen::Map<const Eigen::Vector3d>(T.n);
        for (int i = 0; i < 3; ++i) gradient[i] = T.gx[k] * T.e1[i] + T.gy[k] * T.e2[i];
        return Eigen::Matrix3d(gradient * n.transpose() - n * gradient.transpose());
    };
    const auto entry = [&](int vertex_a, int vertex_b) {
        Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
        for (int t = 0; t < mesh.n_triangles(); ++t)
            for (int s = 0; s < mesh.n_triangles(); ++s)
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b < 3; ++b) {
                        if (mesh.triangles(a, t) != vertex_a || mesh.triangles(b, s) != vertex_b) continue;
                        const Eigen::Matrix3d Ma = guenter(t, a), Mb = guenter(s, b);
                        const Eigen::Vector3d Sa(Ma(2, 1), Ma(0, 2), Ma(1, 0)), Sb(Mb(2, 1), Mb(0, 2), Mb(1, 0));
                        const TriangleGeometry &T = boundary.triangle(t), &S = boundary.triangle(s);
                        for (std::size_t p = 0; p < rule.points.size(); ++p)
                            for (std::size_t q = 0; q < rule.points.size(); ++q) {
                                Eigen::Vector3d x = Eigen::Vector3d::Zero(), y = x;
                                for (std::size_t c = 0; c < 3; ++c) {
                                    x += rule.points[p][c] * Eigen::Map<const Eigen::Vector3d>(T.corner[c]);
                                    y += rule.points[q][c] * Eigen::Map<const Eigen::Vector3d>(S.corner[c]);
                                }
                                const double w =
                                    rule.weights[p] * rule.weights[q] * boundary.area(t) * boundary.area(s);
                                const double r = (x - y).norm();
                                const Eigen::Matrix3d kernel = mu / (2 * pi * r) * Eigen::Matrix3d::Identity() -
                                                               4 * mu * mu * kelvin_displacement(x, y, kUnitMaterial);
                                block += w * (mu / (4 * pi * r) * Sa.dot(Sb) * Eigen::Matrix3d::Identity() +
                                              Ma.transpose() * kernel * Mb + mu / (4 * pi * r) * Mb.transpose() * Ma);
                            }
                    }
        return block;
    };
    const Eigen::Matrix3d own = D.block<3, 3>(0, 0);
    int checked = 0;
    for (int b = 1; b < mesh.n_vertices() && checked < 4; ++b) {
        if ((mesh.vertices.col(b) - mesh.vertices.col(0)).norm() < 0.9 || b % 5 != 0) continue;
        const Eigen::Matrix3d expected = entry(0, b);
        const Eigen::Matrix3d block = D.block<3, 3>(0, 3 * b);
        EXPECT_LT((block - expected).norm(), 1e-9 * own.norm());
        EXPECT_GT(expected.norm(), 1e-4 * own.norm());
        ++checked;
    }
    EXPECT_EQ(checked, 4);
}

}  // namespace
}  // namespace elastolab
