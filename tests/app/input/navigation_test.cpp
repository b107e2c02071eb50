// What mouse gestures beside the body do to the camera.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/stage.hpp"
#include "render/drawing/axes_gizmo.hpp"

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

/// What a drag did to the view.
enum class Moved { turned, panned, zoomed };
Moved moved_by(Navigation navigation, int button, int modifiers) {
    Stage stage;
    stage.state.tools.navigation = navigation;
    const CameraPose before = stage.state.camera.pose();
    stage.modifiers = modifiers;
    stage.drag(stage.empty_place(), stage.empty_place() + Eigen::Vector2d(20.0, -60.0), button);
    const CameraPose& after = stage.state.camera.pose();
    if (after.orientation.angularDistance(before.orientation) > 0.05) return Moved::turned;
    return after.distance < 0.9 * before.distance ? Moved::zoomed : Moved::panned;
}

TEST(Navigation, PresetsDoWhatOtherProgramsDo) {
    constexpr int kLeft = GLFW_MOUSE_BUTTON_LEFT, kMiddle = GLFW_MOUSE_BUTTON_MIDDLE, kRight = GLFW_MOUSE_BUTTON_RIGHT;
    constexpr int kShift = GLFW_MOD_SHIFT, kControl = GLFW_MOD_CONTROL;
    EXPECT_EQ(moved_by(Navigation::blender, kMiddle, 0), Moved::turned);
    EXPECT_EQ(moved_by(Navigation::blender, kMiddle, kShift), Moved::panned);
    EXPECT_EQ(moved_by(Navigation::blender, kMiddle, kControl), Moved::zoomed);
    EXPECT_EQ(moved_by(Navigation::paraview, kLeft, 0), Moved::turned);
    EXPECT_EQ(moved_by(Navigation::paraview, kMiddle, 0), Moved::panned);
    EXPECT_EQ(moved_by(Navigation::paraview, kRight, 0), Moved::zoomed);
    EXPECT_EQ(moved_by(Navigation::paraview, kLeft, kControl), Moved::zoomed);
    EXPECT_EQ(moved_by(Navigation::paraview, kMiddle, kShift), Moved::turned);
    EXPECT_EQ(moved_by(Navigation::polyscope, kLeft, 0), Moved::turned);
    EXPECT_EQ(moved_by(Navigation::polyscope, kRight, 0), Moved::panned);
    EXPECT_EQ(moved_by(Navigation::polyscope, kLeft, kShift | kControl), Moved::zoomed);
    EXPECT_EQ(moved_by(Navigation::trackpad, kLeft, 0), Moved::turned);
}

TEST(Navigation, TwoFingersOnATrackpadTurnMoveAndZoom) {
    Stage stage;
    stage.state.tools.navigation = Navigation::trackpad;
    stage.move(stage.empty_place());
    const CameraPose before = stage.state.camera.pose();
    stage.scroll(2.0);
    EXPECT_GT(stage.state.camera.pose().orientation.angularDistance(before.orientation), 0.1);
    EXPECT_EQ(stage.state.camera.pose().distance, before.distance);
    stage.modifiers = GLFW_MOD_SHIFT;
    stage.scroll(2.0);
    EXPECT_GT((stage.state.camera.pose().target - before.target).norm(), 0.01);
    EXPECT_EQ(stage.state.camera.pose().distance, before.distance);
    stage.modifiers = GLFW_MOD_CONTROL;
    stage.scroll(2.0);
    EXPECT_LT(stage.state.camera.pose().distance, 0.9 * before.distance);
}

TEST(Navigation, AClickOnALetterOfTheAxesLooksAlongThatAxisAndThenFromTheOtherSide) {
    Stage stage;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0}) {
            const Viewport place = AxesGizmo::place_in(stage.state.shown.viewports.front().place);
            stage.wait(1.0);
            stage.click(AxesGizmo::labels(stage.state.camera, place).pixel[static_cast<std::size_t>(axis)]);
            EXPECT_LT((stage.state.camera.backward() - side * Eigen::Vector3d::Unit(axis)).norm(), 1e-9) << axis;
        }
    EXPECT_EQ(stage.scene().n_handles(), 0);
}

/// Pulled exactly as in perspective: what is under the cursor stays there.
TEST(Navigation, APullInAnOrthographicViewStaysUnderTheCursor) {
    Stage stage;
    stage.settle();
    stage.state.camera.set_projection_kind(Projection::orthographic);
    const int v = stage.vertex_near({1, 2.0 / 3, 2.0 / 3});
    const Eigen::Vector2d from = stage.pixel(v);
    stage.drag(from, from + kStroke);
    stage.settle();
    ASSERT_EQ(stage.scene().n_handles(), 1);
    EXPECT_LT((stage.pixel(v) - from - kStroke).norm(), 1e-3);
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
