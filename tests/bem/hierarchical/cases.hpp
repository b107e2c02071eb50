#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <utility>

#include "mesh/primitives.hpp"
#include "methods/problem.hpp"

// Bodies and their exact answers, for methods with hierarchical matrices.

namespace elastolab::test {

/// The largest difference over the largest true value.
inline double off(const Eigen::MatrixXd& a, const Eigen::MatrixXd& truth) {
    return (a - truth).cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff();
}

/// A box pulled at both ends, by both updates, up to incompressibility.
inline void expect_exact_for_a_stretched_box(int cells, const std::function<Method(Update)>& method) {
    const SurfaceMesh mesh = make_box(cells, {2.0, 1.0, 1.0});
    const auto ends = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9 || x[0] > 2.0 - 1e-9; });
    for (const auto& [nu, update] : {std::pair(0.3, Update::direct), std::pair(0.5, Update::reduced)}) {
        Eigen::VectorXd exact(3 * mesh.n_vertices());
        for (int v = 0; v < mesh.n_vertices(); ++v)
            exact.segment<3>(3 * v) = mesh.vertices.col(v).cwiseProduct(Eigen::Vector3d(1.0, -nu, -nu));
        EXPECT_LT(
            off(displaced(precomputed(make_body(mesh, {1.0, nu}), method(update)), {{}, ends}, at(exact, ends)), exact),
            1e-6);
    }
}

/// Moves the lowest part of a body rigidly: the body follows, without forces.
inline void expect_rigid_motion_without_force(const SurfaceMesh& mesh, const Method& method, double force) {
    const double low = mesh.vertices.row(2).minCoeff();
    const auto held = vertices_where(mesh, [&](const auto& x) { return x[2] < low + 0.3; });
    Eigen::VectorXd exact(3 * mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v)
        exact.segment<3>(3 * v) = Eigen::Vector3d(0.1, -0.2, 0.3) +
                                  Eigen::Vector3d(0.3, 0.2, -0.1).cross(Eigen::Vector3d(mesh.vertices.col(v)));
    Control control;
    Deformer deformer(precomputed(make_body(mesh), method));
    deformer.constrain({{}, held}, control);
    const Deformer::Answer answer = deformer.answer(at(exact, held), {.residual = true}, control);
    EXPECT_LT(off(answer.displacements, exact), 1e-6);
    EXPECT_LT(answer.reactions.forces.cwiseAbs().maxCoeff(), force);
    EXPECT_LT(answer.residual.value(), 1e-6);
}

/// `iterating` answers to a looser tolerance first, and then, from there, as `exact` does. A cancelled control stops
/// every iteration: what answers all the same needs none.
inline void expect_first_answer_and_the_rest(const Method& exact, const Method& iterating) {
    const SurfaceMesh mesh = make_box(8);
    const ConstrainedSet set{vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; }),
                             vertices_where(mesh, [](const auto& x) { return x[0] > 1.0 - 1e-9 && x[1] < 0.3; })};
    const Eigen::VectorXd values = Eigen::Vector3d(0.1, -0.2, 0.15).replicate(std::ssize(set.handles), 1);
    const Eigen::VectorXd truth = displaced(precomputed(make_body(mesh), exact), set, values);
    Deformer deformer(precomputed(make_body(mesh), iterating));
    Control control, cancelled;
    cancelled.cancel();
    deformer.constrain(set, control);
    EXPECT_TRUE(deformer.iterates());
    const Eigen::VectorXd first = deformer.displace(values, control, kFirstTolerance);
    EXPECT_LT(off(first, truth), 1e-3);
    EXPECT_GT(off(first, truth), 2e-6) << "iterated for nothing";
    EXPECT_EQ(deformer.displace(values, cancelled, kFirstTolerance), first);
    EXPECT_THROW(deformer.displace(values, cancelled), Cancelled) << "the first answer passes for the refined one";
    EXPECT_LT(off(deformer.displace(values, control), truth), 1e-6);
    EXPECT_LT(off(deformer.displace(values, cancelled, kFirstTolerance), truth), 1e-6);
}

}  // namespace elastolab::test
