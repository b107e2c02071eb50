// A body that is cut open: what is left of it, and that only this can be pointed at.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/stage.hpp"
#include "fem/method.hpp"
#include "methods/registry.hpp"
#include "support/wait_until.hpp"

namespace elastolab::test {
namespace {

class CutOpen : public testing::Test {
protected:
    CutOpen() {
        stage.state.method = kFem;
        stage.state.display.section = true;  // keeps x < 0.5
        stage.settle();
    }
    Stage stage{6};
    int kept = stage.vertex_near({1.0 / 6, 0.5, 1}), gone = stage.vertex_near({5.0 / 6, 0.5, 1});
};

TEST_F(CutOpen, WhatIsCutAwayIsNotPointedAt) {
    ASSERT_TRUE(stage.state.shown.body(kFem)->section());
    stage.move(stage.pixel(kept));
    EXPECT_EQ(stage.hovered(), kept);
    stage.move(stage.pixel(gone));
    EXPECT_NE(stage.hovered(), gone);
    stage.state.display.section = false;
    stage.settle();
    stage.move(stage.pixel(gone) + Eigen::Vector2d(1, 0));
    EXPECT_EQ(stage.hovered(), gone);
}

TEST_F(CutOpen, StaysOpenWhenTheModelIsCompleted) {
    stage.state.choices.complete_up_to = 2000;
    test::wait_for([&] {
        stage.frame();
        EXPECT_TRUE(stage.state.shown.body(kFem)->section());
        return !stage.state.simulation.busy();
    });
    EXPECT_TRUE(stage.state.simulation.runner(kFem).has_inverse());
    EXPECT_FALSE(stage.state.shown.cutting());
}

/// What is marked as the largest is what the range of the colours ends with, on the cut too.
TEST_F(CutOpen, ItsExtremesAreThoseOfItsRange) {
    const int handle = stage.scene().add_handle(std::vector{stage.vertex_near({1, 0.5, 0.5})});
    stage.scene().set_motion(handle, AffineMotion{.translate = {0.1, 0.0, 0.2}});
    stage.state.display.cut.place = 0.9;
    for (const Field field : {Field::von_mises, Field::displacement, Field::displacement_z}) {
        stage.state.display.field = field;
        stage.settle();
        const ShownBody& body = *stage.state.shown.body(kFem);
        ASSERT_TRUE(body.section() && body.largest_seen() && body.smallest_seen());
        EXPECT_EQ(std::max(std::abs(body.largest_seen()->value), std::abs(body.smallest_seen()->value)),
                  body.largest_magnitude());
        EXPECT_LE(body.smallest_seen()->value, body.largest_seen()->value);
        const auto distance = (body.section()->positions.colwise() - body.largest_seen()->place).colwise().norm();
        EXPECT_EQ(distance.minCoeff(), 0.0);
    }
}

TEST_F(CutOpen, IsFilledAtOnceAndEvaluatedByItself) {
    stage.state.display.section = false;
    const int handle = stage.scene().add_handle(std::vector{kept});
    stage.scene().set_motion(handle, AffineMotion{.translate = {0.0, 0.0, 0.2}});
    stage.settle();
    stage.state.display.section = true;
    stage.frame();
    ASSERT_TRUE(stage.state.shown.body(kFem)->section());
    stage.settle();
    EXPECT_FALSE(stage.state.shown.cutting());
    ASSERT_TRUE(stage.state.shown.section_cost());
    EXPECT_GT(stage.state.shown.section_cost()->inside.points, 100);
    EXPECT_EQ(stage.state.shown.section_cost()->inside.evaluated, stage.state.shown.section_cost()->inside.points);
}

TEST_F(CutOpen, IsColouredInsideByWhatIsKnownThere) {
    const int handle = stage.scene().add_handle(std::vector{kept});
    stage.scene().set_motion(handle, AffineMotion{.translate = {0.0, 0.0, 0.2}});
    for (const MethodKind kind : all_methods())
        for (const Field field : {Field::displacement, Field::von_mises}) {
            stage.state.method = kind;
            stage.state.display.field = field;
            stage.settle();
            const ShownBody& body = *stage.state.shown.body(kind);
            ASSERT_TRUE(body.section());
            ASSERT_EQ(std::ssize(body.section()->values), body.section()->positions.cols());
            for (const float value : body.section()->values) {
                ASSERT_TRUE(std::isfinite(value)) << name(kind);
                ASSERT_LT(value, 1.5 * body.largest_magnitude()) << name(kind);
            }
            const auto largest_inside = *std::max_element(
                body.section()->values.begin() + stage.scene().mesh().n_vertices(), body.section()->values.end());
            EXPECT_GT(largest_inside, 0.02 * body.largest_magnitude()) << name(kind);
        }
}

/// On a coarse proxy neighbours have one vertex together, which one of two handles is left without.
TEST_F(CutOpen, AHandleWithoutVerticesOnTheProxyDoesNoHarm) {
    for (const bool swapped : {false, true}) {
        Document document = stage.scene().document();
        document.mesh = Primitive{.name = "cube", .resolution = 12, .size = {}};
        document.proxy = {.use = ProxyUse::always, .n_vertices = 60};
        stage.open(document);
        const int one = stage.vertex_near({0.25, 0.5, 1}), other = stage.vertex_near({0.25, 0.5 + 1.0 / 12, 1});
        for (const int v : swapped ? std::array{one, other} : std::array{other, one})
            stage.scene().add_handle(std::vector<int>{v});
        stage.scene().set_motion(1, AffineMotion{.translate = {0, 0, 0.01}});
        stage.scene().set_motion(0, AffineMotion{.translate = {0, 0, 0.01}});
        stage.settle();
        EXPECT_TRUE(stage.state.shown.body(kFem)->section());
    }
}

TEST_F(CutOpen, ABoxFixesWhatIsLeft) {
    stage.state.tools.tool = Tool::box;
    stage.state.tools.box_reach = Reach::through;
    const Viewport& place = stage.state.shown.viewports.front().place;
    stage.drag({place.x + 1, place.y + 1}, {place.x + place.width - 2, place.y + place.height - 2});
    EXPECT_EQ(stage.scene().owner(kept), LiveScene::kFixed);
    EXPECT_EQ(stage.scene().owner(gone), LiveScene::kNobody);
}

TEST_F(CutOpen, APressOnTheCutPullsNothingInside) {
    const ShownSection section = *stage.state.shown.body(kFem)->section();
    for (int v = stage.scene().mesh().n_vertices(); v < section.positions.cols(); v += 7) {
        const Eigen::Vector2d at = stage.pixel(Eigen::Vector3d(section.positions.col(v)));
        stage.drag(at, at + Eigen::Vector2d(20, 0));
        stage.drag(at + Eigen::Vector2d(20, 0), at);
    }
    for (int h = 0; h < stage.scene().n_handles(); ++h)
        for (const int v : stage.scene().vertices(h)) EXPECT_LT(v, stage.scene().mesh().n_vertices());
}

}  // namespace
}  // namespace elastolab::test
