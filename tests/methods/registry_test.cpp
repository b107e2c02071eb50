#include "methods/registry.hpp"

#include <gmock/gmock.h>

#include <set>

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
    const auto seconds = [](int cells, const Method& method) { return predict_cost(make_box(cells), method).seconds; };
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

}  // namespace
}  // namespace elastolab::test
