#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <memory>
#include <numeric>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/solution.hpp"
#include "mesh/primitives.hpp"
#include "methods/load_cases.hpp"
#include "methods/precompute.hpp"
#include "methods/problem.hpp"
#include "study/error/loaded_problems.hpp"

namespace elastolab::test {
namespace {

struct FreeAnswer {
    double error = 0.0;
    std::optional<DiscretisationCheck> check;
    Findings findings;
};

FreeAnswer free_answer(const Problem& problem, MethodKind kind, std::vector<int> fixed = {}) {
    Control control;
    Deformer deformer(precompute(problem.body, {.kind = kind}, control));
    deformer.constrain({fixed, {}, problem.loads}, control);
    const Deformer::Answer answer = deformer.answer(problem.factors, {.check = true}, control);
    return {problem.largest_error(answer.displacements), answer.check, findings_of_answer(deformer, answer)};
}

/// A hollow sphere under inner pressure that nothing holds. Towards a ratio of 1/2 collocation is far off: by 50 % with
/// 292 vertices.
TEST(FreeBody, ErrorsAreEstimatedWithinAFactorOfThree) {
    for (const double nu : {0.3, 0.49}) {
        const Problem problem = pressed_sphere(6, nu);
        for (const MethodKind kind : {kConstantBem, kLinearBem, kFem, kQuadraticFem}) {
            const FreeAnswer answer = free_answer(problem, kind);
            ASSERT_TRUE(answer.check) << kind->name;
            const std::string what = std::string(kind->name) + " at a ratio of " + std::to_string(nu);
            print_measured(what + ", largest error", answer.error);
            print_measured(what + ", estimate", answer.check->relative_error);
            EXPECT_GT(answer.check->relative_error, answer.error / 3.0) << what;
            EXPECT_LT(answer.check->relative_error, answer.error * 3.0) << what;
            EXPECT_LT(answer.check->relative_force_error, 1e-9) << what;
        }
    }
}

UnitLoad pressure_all_around(const SurfaceMesh& surface) {
    std::vector<int> all(static_cast<std::size_t>(surface.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    return unit_pressure(surface, std::move(all));
}

/// There is no rim to refine: that its own error is not known is said.
TEST(FreeBody, GalerkinWithoutARimSaysThatItsErrorIsNotEstimated) {
    const auto ball = std::make_shared<const SurfaceMesh>(make_sphere(5));
    Control control;
    Deformer deformer(
        precompute({.name = "ball", .surface = ball, .material = {1.0, 0.3}}, {.kind = kGalerkinBem}, control));
    const UnitLoad at_the_poles =
        unit_pressure(*ball, triangles_where(*ball, [](const auto& x) { return std::abs(x[2]) > 0.6; }));
    deformer.constrain({{}, {}, {at_the_poles}}, control);
    const Deformer::Answer answer = deformer.answer(Eigen::VectorXd::Ones(1), {.check = true}, control);
    EXPECT_FALSE(answer.check);
    const Findings findings = findings_of_answer(deformer, answer);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].kind, FindingKind::no_estimate);
}

/// A shell of few triangles across has all of them halved.
TEST(FreeBody, GalerkinEstimatesTheErrorOfAShell) {
    const FreeAnswer answer = free_answer(pressed_sphere(4, 0.3), kGalerkinBem);
    ASSERT_TRUE(answer.check);
    EXPECT_LT(answer.error, 0.07);
    EXPECT_GT(answer.check->relative_error, answer.error / 3.0);
    EXPECT_LT(answer.check->relative_error, answer.error * 3.0);
}

/// An incompressible body keeps its shape under pressure all around: what is left of displacements is rounding.
TEST(FreeBody, RoundingIsNotSaidToBeOff) {
    const auto ball = std::make_shared<const SurfaceMesh>(make_sphere(5));
    for (const MethodKind kind : {kConstantBem, kLinearBem}) {
        Control control;
        Deformer deformer(
            precompute({.name = "ball", .surface = ball, .material = {100.0, 0.5}}, {.kind = kind}, control));
        deformer.constrain({{}, {}, {pressure_all_around(*ball)}}, control);
        const Deformer::Answer answer = deformer.answer(Eigen::VectorXd::Constant(1, 3.0), {.check = true}, control);
        ASSERT_TRUE(answer.check);
        EXPECT_LT(answer.displacements.lpNorm<Eigen::Infinity>(), 1e-12);
        EXPECT_LT(answer.check->relative_error, 0.02) << kind->name;
    }
}

/// One vertex holds its place, and the body may still turn about it.
TEST(FreeBody, ErrorsAreEstimatedWhereTheBodyMayStillTurn) {
    Problem problem = pressed_sphere(4, 0.3);
    const int pole = 0;
    const Eigen::Vector3d shift = problem.truth.segment<3>(3 * pole);
    for (auto u : problem.truth.reshaped(3, problem.body.surface->n_vertices()).colwise()) u -= shift;
    for (const MethodKind kind : {kLinearBem, kFem}) {
        const FreeAnswer answer = free_answer(problem, kind, {pole});
        ASSERT_TRUE(answer.check) << kind->name;
        EXPECT_GT(answer.check->relative_error, answer.error / 3.0) << kind->name;
        EXPECT_LT(answer.check->relative_error, answer.error * 3.0) << kind->name;
        EXPECT_TRUE(std::isnan(answer.check->relative_force_error)) << "pins bear a part";
    }
}

/// A bar of edges 2, 1, 1 in flight: the upper halves of its ends are pulled apart. A third load, of nothing, tells
/// factors of loads from displacements of a vertex.
struct PulledBar {
    SurfaceMesh mesh;
    Deformer deformer;
    Deformer::Answer answer;

    PulledBar(int cells, ElementDegree elements)
        : mesh(make_box(cells, {2, 1, 1})),
          deformer(precomputed(make_body(mesh, {1.0, 0.3}), {.kind = kNonlinearFem, .elements = elements})) {
        Control control;
        deformer.constrain({{}, {}, {pull(0.0), pull(2.0), body_force_along(2)}}, control);
        answer = deformer.answer(Eigen::Vector3d(-0.15, 0.15, 0.0), {.check = true}, control);
    }
    UnitLoad pull(double x) const {
        std::vector<int> upper;
        for (int t = 0; t < mesh.n_triangles(); ++t) {
            const Positions corners = mesh.vertices(Eigen::all, mesh.triangles.col(t));
            const bool at_end = (corners.row(0).array() - x).abs().maxCoeff() < 1e-9;
            if (at_end && corners.row(2).minCoeff() > 0.5 - 1e-9) upper.push_back(t);
        }
        return unit_force(mesh, std::move(upper), {1, 0, 0});
    }
    Positions present() const { return mesh.vertices + answer.displacements.reshaped(3, mesh.n_vertices()); }
    /// Farthest distance from where another such bar has the same vertices, turned and shifted to there, over the
    /// largest displacement.
    double error_by(const PulledBar& truth) const {
        std::vector<int> same;
        for (const auto& x : mesh.vertices.colwise()) {
            Eigen::Index at = 0;
            EXPECT_LT((truth.mesh.vertices.colwise() - x).colwise().norm().minCoeff(&at), 1e-9);
            same.push_back(static_cast<int>(at));
        }
        const Positions here = present(), there = truth.present()(Eigen::all, same);
        const Eigen::Matrix4d onto = Eigen::umeyama(here, there, false);
        const Positions moved = (onto.topLeftCorner<3, 3>() * here).colwise() + onto.topRightCorner<3, 1>();
        return (moved - there).colwise().norm().maxCoeff() /
               answer.displacements.reshaped(3, mesh.n_vertices()).colwise().norm().maxCoeff();
    }
};

TEST(FreeBody, ErrorsAreEstimatedUnderLargeDeformations) {
    const PulledBar truth(6, ElementDegree::quadratic);
    for (const ElementDegree elements : {ElementDegree::quadratic, ElementDegree::linear}) {
        const PulledBar bar(2, elements);
        ASSERT_TRUE(bar.answer.check);
        const double error = bar.error_by(truth), estimate = bar.answer.check->relative_error;
        print_measured("largest error", error);
        print_measured("estimate", estimate);
        EXPECT_GT(estimate, error / 2.0);
        EXPECT_LT(estimate, error * 2.0);
        EXPECT_EQ(bar.answer.check->relative_force_error, 0.0);
        EXPECT_EQ(bar.answer.reactions.forces.cols(), 0) << "no vertex is constrained";
    }
}

}  // namespace
}  // namespace elastolab::test
