// Large deformations with a known answer: they go over into linear elasticity, and finite elements converge to them.
#include <gtest/gtest.h>

#include <numbers>

#include "elasticity/exact_fields.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "study/error/finite_problems.hpp"
#include "study/setups.hpp"

namespace elastolab::test {
namespace {

double error_of(const Problem& problem, ElementDegree elements) {
    Control control;
    Deformer deformer(precompute(problem.body, nonlinear_method(elements), control));
    deformer.constrain(problem.set(), control);
    return problem.error(deformer.answer(problem.values(), {}, control).displacements);
}

using Make = Problem (*)(int cells, double poisson_ratio, double amount);

TEST(FiniteProblems, AreReproducedWhereTheyAreUniform) {
    for (const auto& [make, amount] : {std::pair<Make, double>{finite_rotation, 60.0}, {finite_stretch, 1.8}})
        for (const ElementDegree elements : {ElementDegree::linear, ElementDegree::quadratic})
            EXPECT_LT(error_of(make(2, 0.3, amount), elements), 1e-7) << amount;
}

/// Small motions: the difference is of second order in their size.
TEST(FiniteProblems, GoOverIntoLinearElasticity) {
    const double s = 1e-4;
    const Problem finite = finite_swelling(3, 0.3, 1.0 + s);
    const HollowSphereField field{.material = {1.0, 0.3}, .inner_displacement = 0.5 * s};
    const Eigen::VectorXd linear = displacements(field, finite.body.surface->vertices);
    EXPECT_LT((finite.truth - linear).norm(), 10.0 * s * finite.truth.norm());
    const Problem twisted = finite_torsion(3, 0.3, s);
    const Eigen::VectorXd turned = displacements(Torsion{{1.0, 0.3}, 1.0}, twisted.body.surface->vertices);
    const double amount = s / 180.0 * std::numbers::pi / 2.0;  // an angle for each unit of height, which is 2
    EXPECT_LT((twisted.truth - amount * turned).norm(), 10.0 * s * twisted.truth.norm());
}

/// The second order is what the straight sides of the elements leave on curved bodies.
TEST(FiniteProblems, AreWhatFiniteElementsConvergeTo) {
    struct Family {
        Make make;
        double amount, nu;
        int cells;
    };
    for (const auto& [make, amount, nu, cells] : {Family{finite_bending, 90.0, 0.0, 2},
                                                  {finite_bending, 90.0, 0.3, 2},
                                                  {finite_torsion, 90.0, 0.3, 2},
                                                  {finite_swelling, 1.5, 0.0, 4}}) {
        const double coarse = error_of(make(cells, nu, amount), ElementDegree::quadratic);
        const double fine = error_of(make(2 * cells, nu, amount), ElementDegree::quadratic);
        EXPECT_LT(fine, 0.03) << amount << " " << nu;
        EXPECT_GT(coarse / fine, 3.0) << amount << " " << nu;
    }
}

}  // namespace
}  // namespace elastolab::test
