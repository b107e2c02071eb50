#include "scene/selectors.hpp"

#include <gmock/gmock.h>

#include "base/error.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

const Selector kLeft{BoxSelector{.min = {0, 0, 0}, .max = {0, 1, 1}}};
const Selector kTop{PlaneSelector{.point = {5, 5, 1}, .normal = {0, 0, -3}, .tolerance = 1e-12}};
const Selector kCorner{SphereSelector{.center = {0, 0, 1}, .radius = 0.25}};
const Selector kNowhere{SphereSelector{.center = {9, 9, 9}, .radius = 1}};

/// A cube of 2 cells has 9 vertices on every face, 26 in all.
std::vector<int> selected(const Selector& selector) { return select_vertices(make_box(2), selector, "s: /fixed"); }

std::string finding(const Selector& selector) {
    try {
        selected(selector);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

Selector list(std::vector<Selector> members) { return {std::move(members)}; }

TEST(Selectors, ABoxHoldsItsFaces) { EXPECT_THAT(selected(kLeft), SizeIs(9)); }

TEST(Selectors, APlaneTakesAnyNormal) { EXPECT_THAT(selected(kTop), SizeIs(9)); }

TEST(Selectors, ASphereHoldsItsSurface) {
    EXPECT_THAT(selected({SphereSelector{.center = {0, 0, 1}, .radius = 0.5}}), SizeIs(4));
}

TEST(Selectors, VerticesKeepTheirOrder) { EXPECT_THAT(selected({VertexSelector{{7, 3, 25}}}), ElementsAre(7, 3, 25)); }

TEST(Selectors, AListIsTheUnionOfItsMembers) {
    EXPECT_THAT(selected(list({kLeft, kTop, kCorner})), SizeIs(9 + 9 - 3));
    EXPECT_EQ(selected(list({list({kLeft}), kTop})), selected(list({kLeft, kTop})));
}

TEST(Selectors, OneThatSelectsNothingIsNamed) {
    EXPECT_THAT(finding(kNowhere), HasSubstr("s: /fixed/sphere: selects nothing"));
    EXPECT_THAT(finding(list({kLeft, list({kTop, kNowhere})})), HasSubstr("s: /fixed/1/1/sphere: selects nothing"));
    EXPECT_THAT(finding(list({})), HasSubstr("s: /fixed: selects nothing"));
}

TEST(Selectors, VertexNumbersAreChecked) {
    EXPECT_THAT(finding({VertexSelector{{0, 26}}}), HasSubstr("/fixed/vertices/1: there is no vertex 26"));
    EXPECT_THAT(finding({VertexSelector{{4, 5, 4}}}), HasSubstr("/fixed/vertices/2: vertex 4 is listed twice"));
}

}  // namespace
}  // namespace elastolab
