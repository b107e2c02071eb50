#include "methods/registry.hpp"

#include <gmock/gmock.h>

#include <set>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/cost.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"

namespace elastolab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Registry, EveryMethodHasANameALabelAndAColourOfItsOwn) {
    std::set<std::string_view> names, labels;
    std::set<int> colours;
    for (const MethodKind kind : elastolab::all_methods()) {
        EXPECT_TRUE(names.insert(kind->name).second) << kind->name;
        EXPECT_TRUE(labels.insert(kind->label).second) << kind->label;
        EXPECT_TRUE(colours.insert(kind->colour).second) << kind->name;
        EXPECT_EQ(parse_method_kind(kind->name), kind);
    }
    EXPECT_EQ(parse_method_kind("no such method"), std::nullopt);
}

TEST(Registry, EveryMethodAnswersOnDemandByTheReducedUpdate) {
    for (const MethodKind kind : elastolab::all_methods()) {
        EXPECT_THAT(refusal({.kind = kind}, 0.3), IsEmpty()) << kind->name;
        EXPECT_EQ(refusal({.kind = kind}, 0.5).empty(), kind->takes_incompressible) << kind->name;
    }
}

TEST(Registry, WhatIsNotPossibleIsRefusedWithTheReasonAndAWayForward) {
    EXPECT_THAT(refusal({.kind = kLinearBem, .mode = Mode::full_volume}, 0.3), HasSubstr("Choose the mode full"));
    EXPECT_THAT(refusal({.kind = kQuadraticFem, .mode = Mode::full}, 0.3), HasSubstr("Choose the mode on-demand"));
    EXPECT_THAT(refusal({.kind = kGalerkinBem, .mode = Mode::full, .update = Update::eqn9}, 0.3),
                HasSubstr("Choose the update reduced"));
    EXPECT_THAT(refusal({.kind = kFem, .update = Update::eqn9}, 0.3), HasSubstr("Choose the mode full"));
    EXPECT_THAT(refusal({.kind = kFem}, 0.5), HasSubstr("linear-bem"));
    Control control;
    EXPECT_THROW(precompute(make_body(make_box(2)), {.kind = kLinearBem, .mode = Mode::full_volume}, control),
                 SolveError);
}

/// G of constant elements is singular at Poisson's ratio 1/2, so K = G^-1 H carries no digit there.
TEST(Registry, ConstantElementsHaveNoStiffnessAtPoissonsRatioOneHalf) {
    const Method by_K{.kind = kConstantBem, .mode = Mode::full, .update = Update::eqn9};
    EXPECT_THAT(refusal(by_K, 0.5), HasSubstr("Choose the update reduced"));
    EXPECT_THAT(refusal(by_K, 0.499), IsEmpty());
    Method reduced = by_K;
    reduced.update = Update::reduced;
    EXPECT_THAT(refusal(reduced, 0.5), IsEmpty());
}

/// Seconds are compared with the clock by `bench scale`. Here: what is more work of the same kind is said to take
/// longer. From dense to hierarchical matrices the kind changes, and what is longer depends on the machine.
TEST(Predictions, GrowWithTheBodyTheModeAndFinerRims) {
    const auto seconds = [](int cells, const Method& method) {
        return predict_cost(make_box(cells), method).seconds();
    };
    for (const MethodKind kind : elastolab::all_methods()) {
        Method method{.kind = kind};
        const double small = seconds(4, method);
        EXPECT_GT(small, 0.0) << kind->name;
        for (const int cells : {8, 16, 32}) {
            const Method same{.kind = kind, .hierarchical_from = cells == 32 ? 0 : method.hierarchical_from};
            EXPECT_GT(seconds(cells, same), 2.0 * seconds(cells / 2, same)) << kind->name << " " << cells;
        }
        if (has(kind, Mode::full)) {
            EXPECT_GT(seconds(8, {.kind = kind, .mode = Mode::full}), seconds(8, method)) << kind->name;
        }
        for (int rims = 1; kind->chooses_rims && rims <= kMostRims; ++rims) {
            method.rims = rims;
            EXPECT_GT(seconds(8, method), seconds(8, {.kind = kind, .rims = rims - 1})) << rims;
        }
    }
}

/// So many of them in a row.
SurfaceMesh repeated(const SurfaceMesh& mesh, int n, double distance) {
    SurfaceMesh all{mesh.vertices.replicate(1, n), mesh.triangles.replicate(1, n)};
    for (int i = 0; i < n; ++i) {
        all.vertices.middleCols(i * mesh.n_vertices(), mesh.n_vertices()).row(0).array() += distance * i;
        all.triangles.middleCols(i * mesh.n_triangles(), mesh.n_triangles()).array() += i * mesh.n_vertices();
    }
    return all;
}

/// Each solid has a system of its own, wherever it is; what is only needed while one is computed is there once.
TEST(Predictions, OfSeveralSolidsAreThoseOfEach) {
    constexpr std::uint64_t kOnce = 16'000'000;
    const SurfaceMesh ball = make_sphere(10);
    const std::vector<std::pair<int, SurfaceMesh>> rows = {
        {2, repeated(ball, 2, 500.0)}, {5, repeated(ball, 5, 2.5)}, {80, repeated(ball, 80, 2.5)}};
    for (const MethodKind kind : elastolab::all_methods())
        for (const Mode mode : kind->modes)
            for (const auto& [n, row] : rows) {
                SCOPED_TRACE(testing::Message() << n << " by " << kind->name << " " << name(mode));
                const Method method{.kind = kind, .mode = mode};
                const Cost one = predict_cost(ball, method), sum = predict_cost(row, method);
                EXPECT_NEAR(static_cast<double>(sum.degrees_of_freedom),
                            static_cast<double>(n * one.degrees_of_freedom),
                            0.1 * static_cast<double>(sum.degrees_of_freedom));
                const auto times = static_cast<std::uint64_t>(n);
                EXPECT_LE(sum.memory_bytes, times * one.memory_bytes);
                EXPECT_GE(sum.memory_bytes + times * kOnce, times * one.memory_bytes);
                EXPECT_NEAR(sum.seconds(), n * one.seconds(), 0.1 * sum.seconds());
            }
}

}  // namespace
}  // namespace elastolab::test
