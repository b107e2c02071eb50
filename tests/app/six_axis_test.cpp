// What a six-axis mouse does to the scene. The device is a fake: motions as they come from it.
#include "app/six_axis.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "app/stage.hpp"

namespace elastolab::test {
namespace {

/// A tenth of a second of a full deflection to the right.
const SixAxisMotion kRight{.shift = {0.1, 0.0, 0.0}};

TEST(SixAxis, MovesTheSelectedHandleAsSeenOnTheScreen) {
    Stage stage;
    stage.open(cube_document_with_handle(3));
    SixAxisControl control;
    EXPECT_FALSE(control.apply(kRight, 0.0, stage.state)) << "none is selected";
    stage.state.gestures.select_handle(0);
    const int v = stage.vertex_near({1, 0, 0});
    const Eigen::Vector2d before = stage.pixel(v);
    EXPECT_TRUE(control.apply(kRight, 0.0, stage.state));
    EXPECT_TRUE(control.apply(kRight, 0.1, stage.state));
    stage.settle();
    const Eigen::Vector2d moved = stage.pixel(v) - before;
    EXPECT_GT(moved.x(), 1.0);
    EXPECT_NEAR(stage.motion(0).translate.dot(stage.state.camera.up()), 0.0, 1e-12);
    EXPECT_NEAR(stage.motion(0).translate.norm(), 0.1 * stage.state.camera.scene().radius, 1e-12);
}

TEST(SixAxis, TurnsTheHandleAboutItsMiddle) {
    Stage stage;
    stage.open(cube_document_with_handle(3));
    stage.state.gestures.select_handle(0);
    SixAxisControl control;
    for (int i = 0; i < 10; ++i) control.apply(SixAxisMotion{.turn = {0.0, 0.0, 0.05}}, 0.05 * i, stage.state);
    const auto placement = placement_of(stage.motion(0), stage.scene().rest_positions(0));
    ASSERT_TRUE(placement.has_value());
    EXPECT_LT(placement->move.norm(), 1e-9);
    const Eigen::Vector3d turn = placement->turn / 180.0 * std::numbers::pi;
    EXPECT_LT((turn - 0.5 * stage.state.camera.backward()).norm(), 1e-9) << turn.transpose();
}

TEST(SixAxis, MotionWithoutAPauseIsOneStep) {
    Stage stage;
    stage.open(cube_document_with_handle(3));
    stage.state.gestures.select_handle(0);
    SixAxisControl control;
    EXPECT_LT(control.due_in(0.0), 0.0);
    for (int i = 0; i < 5; ++i) control.apply(kRight, 0.1 * i, stage.state);
    EXPECT_FALSE(control.apply(std::nullopt, 0.6, stage.state));
    EXPECT_FALSE(stage.scene().can_undo());
    EXPECT_GT(control.due_in(0.6), 0.0);
    EXPECT_TRUE(control.apply(std::nullopt, 0.9, stage.state));
    EXPECT_LT(control.due_in(0.9), 0.0);
    ASSERT_TRUE(stage.scene().can_undo());
    stage.state.undo();
    EXPECT_EQ(stage.motion(0).translate, Eigen::Vector3d::Zero());
    EXPECT_FALSE(stage.scene().can_undo());
}

/// As when Ctrl+Z is pressed before the pause that would end the step.
TEST(SixAxis, EndsItsStepWhenSomethingElseIsUsed) {
    Stage stage;
    stage.open(cube_document_with_handle(3));
    stage.state.gestures.select_handle(0);
    SixAxisControl control;
    control.end_step(stage.state);
    EXPECT_FALSE(stage.scene().can_undo()) << "there was none";
    control.apply(kRight, 0.0, stage.state);
    control.end_step(stage.state);
    EXPECT_LT(control.due_in(0.1), 0.0);
    stage.state.undo();
    EXPECT_EQ(stage.motion(0).translate, Eigen::Vector3d::Zero());
    EXPECT_TRUE(stage.scene().can_redo());
}

}  // namespace
}  // namespace elastolab::test
