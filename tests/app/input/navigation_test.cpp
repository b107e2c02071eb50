// What mouse gestures beside the body do to the camera.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/stage.hpp"

namespace elastolab::test {
namespace {

const Eigen::Vector2d kStroke(60.0, 35.0);

TEST(Navigation, ADragBesideTheBodyTurnsTheViewAboutItsTarget) {
    Stage stage;
    const CameraPose before = stage.state.camera.pose();
    stage.drag(stage.empty_place(), stage.empty_place() + kStroke);
    EXPECT_EQ(stage.state.camera.pose().target, before.target);
    EXPECT_EQ(stage.state.camera.pose().distance, before.distance);
    EXPECT_GT(stage.state.camera.pose().orientation.angularDistance(before.orientation), 0.1);
}

TEST(Navigation, TheMiddleButtonTurnsTheViewOnTheBodyToo) {
    Stage stage;
    const CameraPose before = stage.state.camera.pose();
    const Eigen::Vector2d on_body = stage.pixel(stage.vertex_near({1, 1, 1}));
    stage.drag(on_body, on_body + kStroke, GLFW_MOUSE_BUTTON_MIDDLE);
    EXPECT_EQ(stage.scene().n_handles(), 0);
    EXPECT_EQ(stage.state.camera.pose().target, before.target);
    EXPECT_GT(stage.state.camera.pose().orientation.angularDistance(before.orientation), 0.1);
}

TEST(Navigation, RightAndShiftedDragsMoveTheView) {
    for (const auto& [button, modifiers] :
         {std::pair(GLFW_MOUSE_BUTTON_RIGHT, 0), std::pair(GLFW_MOUSE_BUTTON_MIDDLE, GLFW_MOD_SHIFT),
          std::pair(GLFW_MOUSE_BUTTON_MIDDLE, GLFW_MOD_CONTROL), std::pair(GLFW_MOUSE_BUTTON_LEFT, GLFW_MOD_SHIFT)}) {
        Stage stage;
        const Eigen::Vector3d target = stage.state.camera.pose().target;
        const Eigen::Vector2d before = stage.pixel(target);
        stage.modifiers = modifiers;
        stage.drag(stage.empty_place(), stage.empty_place() + kStroke, button);
        EXPECT_LT((stage.pixel(target) - before - kStroke).norm(), 1e-6) << button;
    }
}

TEST(Navigation, TheWheelComesCloserToWhatIsUnderTheCursor) {
    Stage stage;
    const int v = stage.vertex_near({1, 0, 1});
    const Eigen::Vector2d before = stage.pixel(v);
    const double distance = stage.state.camera.pose().distance;
    stage.move(before);
    stage.scroll(3.0);
    EXPECT_LT((stage.pixel(v) - before).norm(), 0.5);
    EXPECT_LT(stage.state.camera.pose().distance, 0.8 * distance);
    stage.scroll(-3.0);
    EXPECT_NEAR(stage.state.camera.pose().distance, distance, 1e-9 * distance);
}

TEST(Navigation, ADoubleClickAsksToFrameTheBodyOnce) {
    Stage stage;
    stage.move(stage.empty_place());
    for (int i = 0; i < 2; ++i) {
        stage.press();
        stage.release();
    }
    EXPECT_TRUE(stage.state.gestures.take_frame_request());
    EXPECT_FALSE(stage.state.gestures.take_frame_request());
}

TEST(Navigation, TwoSlowClicksAreNoDoubleClick) {
    Stage stage;
    stage.click(stage.empty_place());
    stage.click(stage.empty_place());
    EXPECT_FALSE(stage.state.gestures.take_frame_request());
}

TEST(Navigation, ADoubleClickOnTheBodyLeavesNoHandle) {
    Stage stage;
    stage.move(stage.pixel(stage.vertex_near({1, 0.33, 0.33})));
    for (int i = 0; i < 2; ++i) {
        stage.press();
        stage.release();
    }
    EXPECT_TRUE(stage.state.gestures.take_frame_request());
    EXPECT_EQ(stage.scene().n_handles(), 0);
}

TEST(Navigation, APressOutsideTheSceneDoesNothing) {
    Stage stage;
    const CameraPose before = stage.state.camera.pose();
    stage.drag({10, 400}, {300, 500});
    EXPECT_TRUE(stage.state.camera.pose().orientation.isApprox(before.orientation, 0.0));
    EXPECT_EQ(stage.scene().n_handles(), 0);
}

TEST(Navigation, FramingTakesTheDeformedBodyIntoAccount) {
    Stage stage;
    const int v = stage.vertex_near({1, 0, 1});
    stage.drag(stage.pixel(v), stage.pixel(v) + Eigen::Vector2d(0, -500));
    stage.settle();
    stage.state.frame_body();
    EXPECT_TRUE(stage.state.shown.viewports.front().place.contains(stage.pixel(v)));
}

}  // namespace
}  // namespace elastolab::test
