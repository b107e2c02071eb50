#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "bem/galerkin/method.hpp"
#include "deform/node_solver.hpp"
#include "elasticity/exact_fields.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

const Method kDirect{.kind = kGalerkinBem, .update = Update::direct};
const Method kReduced{.kind = kGalerkinBem};
const Method kFull{.kind = kGalerkinBem, .mode = Mode::full};

std::vector<int> ends_of(const SurfaceMesh& mesh) {
    const double low = mesh.vertices.row(0).minCoeff(), high = mesh.vertices.row(0).maxCoeff();
    return vertices_where(mesh, [&](const auto& x) { return x[0] < low + 1e-9 || x[0] > high - 1e-9; });
}

/// A linear field of stretch along x with the sides free of traction.
Eigen::VectorXd stretched(const SurfaceMesh& mesh, double nu) {
    Eigen::VectorXd u(3 * mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v)
        u.segment<3>(3 * v) = mesh.vertices.col(v).cwiseProduct(Eigen::Vector3d(1.0, -nu, -nu));
    return u;
}

TEST(GalerkinBem, IsExactForAStretchedBoxByEveryUpdateAndMode) {
    const SurfaceMesh mesh = make_box(2, {2.0, 1.0, 1.0});
    for (const double nu : {0.0, 0.3, 0.49, 0.5})
        for (const Method& method : {kDirect, kReduced, kFull}) {
            const Eigen::VectorXd exact = stretched(mesh, nu);
            const auto ends = ends_of(mesh);
            Control control;
            Deformer deformer(precomputed(make_body(mesh, {1.0, nu}), method));
            deformer.constrain({{}, ends}, control);
            const Deformer::Answer answer = deformer.answer(at(exact, ends), {.residual = true}, control);
            EXPECT_LT((answer.displacements - exact).cwiseAbs().maxCoeff(), 1e-7) << describe(method) << " " << nu;
            EXPECT_LT(answer.residual.value(), 1e-9) << describe(method) << " " << nu;
            // Unit strain, unit Young's modulus, unit cross-section: a force of one at each end.
            double right = 0.0;
            for (std::size_t i = 0; i < ends.size(); ++i)
                if (mesh.vertices(0, ends[i]) > 1.0) right += answer.reactions.forces(0, static_cast<Eigen::Index>(i));
            EXPECT_NEAR(right, 1.0, 1e-7) << describe(method) << " " << nu;
        }
}

TEST(GalerkinBem, RigidMotionsCauseNoForce) {
    const SurfaceMesh mesh = make_rabbit(300).surface;
    const auto held = vertices_where(mesh, [&](const auto& x) { return x[2] < mesh.vertices.row(2).minCoeff() + 0.3; });
    Eigen::VectorXd exact(3 * mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v)
        exact.segment<3>(3 * v) = Eigen::Vector3d(0.1, -0.2, 0.3) +
                                  Eigen::Vector3d(0.3, 0.2, -0.1).cross(Eigen::Vector3d(mesh.vertices.col(v)));
    for (const Method& method : {kDirect, kReduced}) {
        Control control;
        Deformer deformer(precomputed(make_body(mesh), method));
        deformer.constrain({{}, held}, control);
        const Deformer::Answer answer = deformer.answer(at(exact, held), {}, control);
        EXPECT_LT((answer.displacements - exact).norm(), 1e-9 * exact.norm()) << describe(method);
        EXPECT_LT(answer.reactions.forces.cwiseAbs().maxCoeff(), 1e-9) << describe(method);
    }
}

TEST(GalerkinBem, ForcesBalanceAndAreReciprocal) {
    const SurfaceMesh mesh = make_rabbit(300).surface;
    const double low = mesh.vertices.row(2).minCoeff(), high = mesh.vertices.row(2).maxCoeff();
    ConstrainedSet set;
    set.fixed = vertices_where(mesh, [&](const auto& x) { return x[2] < low + 0.15 * (high - low); });
    set.handles = vertices_where(mesh, [&](const auto& x) { return x[2] > high - 0.1 * (high - low); });
    ASSERT_GE(set.handles.size(), 3u);
    Control control;
    Deformer deformer(precomputed(make_body(mesh), kReduced));
    deformer.constrain(set, control);
    const Eigen::Index n_fixed = std::ssize(set.fixed), n = 3 * std::ssize(set.handles);
    const Eigen::VectorXd a = Eigen::VectorXd::Random(n), b = Eigen::VectorXd::Random(n);
    const Reactions of_a = deformer.reactions(a), of_b = deformer.reactions(b);
    const double size = of_a.forces.colwise().norm().sum();
    EXPECT_LT(of_a.forces.rowwise().sum().norm(), 1e-8 * size);
    EXPECT_LT(of_a.moments.rowwise().sum().norm(), 1e-8 * of_a.moments.colwise().norm().sum());
    const auto work = [&](const Reactions& r, const Eigen::VectorXd& u) {
        return Eigen::Map<const Eigen::VectorXd>(r.forces.data() + 3 * n_fixed, n).dot(u);
    };
    EXPECT_NEAR(work(of_a, b), work(of_b, a), 1e-10 * std::abs(work(of_a, a)));
}

TEST(GalerkinBem, UpdatesAndModesAgree) {
    for (const SurfaceMesh& mesh : {make_rabbit(300).surface, make_hollow_sphere(3)}) {
        ConstrainedSet set;
        const double low = mesh.vertices.row(2).minCoeff();
        set.fixed = vertices_where(mesh, [&](const auto& x) { return x[2] < low + 0.3; });
        set.handles = {
            vertices_where(mesh, [&](const auto& x) { return x[2] > mesh.vertices.row(2).maxCoeff() - 1e-9; }).front()};
        const Eigen::Vector3d pull(0.1, 0.05, 0.2);
        const Eigen::VectorXd direct = displaced(precomputed(make_body(mesh), kDirect), set, pull);
        for (const Method& method : {kReduced, kFull})
            EXPECT_LT((displaced(precomputed(make_body(mesh), method), set, pull) - direct).norm(),
                      1e-9 * direct.norm())
                << describe(method);
    }
}

TEST(GalerkinBem, BendsABarWithSecondOrderAccuracy) {
    std::vector<double> errors;
    for (const int cells : {2, 4, 8}) {
        const Material material{1.0, 0.3};
        const SurfaceMesh mesh = make_box(cells, {2.0, 1.0, 1.0});
        const Eigen::VectorXd exact = exact_displacements(mesh, PureBending{material});
        const auto ends = ends_of(mesh);
        const Eigen::VectorXd u =
            displaced(precomputed(make_body(mesh, material), kDirect), {{}, ends}, at(exact, ends));
        errors.push_back((u - exact).norm() / exact.norm());
        print_measured("galerkin-bem, pure bending, " + std::to_string(cells) + " cells, relative error",
                       errors.back());
    }
    EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8);
}

TEST(GalerkinBem, SaysWhenABodyIsNotHeld) {
    const SurfaceMesh mesh = make_box(3);
    Control control;
    Deformer direct(precomputed(make_body(mesh), kDirect)), reduced(precomputed(make_body(mesh), kReduced));
    EXPECT_THROW(direct.constrain({{}, {0}}, control), NotHeldError);
    EXPECT_STREQ(control.stage(), "") << "nothing is integrated for it";
    reduced.constrain({{}, {0}}, control);
    EXPECT_FALSE(reduced.quality().held);
    EXPECT_LT((reduced.displace(Eigen::Vector3d(1.0, 2.0, 3.0)).segment<3>(0) - Eigen::Vector3d(1, 2, 3)).norm(), 1e-9);
}

}  // namespace
}  // namespace elastolab::test
