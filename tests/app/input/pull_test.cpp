// What pulling at the body does to the scene, and where the pulled vertex then is on the screen.
#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include <Eigen/LU>

#include "app/stage.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kPixels = 1e-6;  // the cursor is followed but for rounding
const Eigen::Vector2d kAside(2.0, -1.0), kDrag(70.0, -40.0);

/// In the middle of the top, which the camera looks down on.
int top_vertex(const Stage& stage) { return stage.vertex_near({2.0 / 3, 1.0 / 3, 1.0}); }

class EveryMethod : public testing::TestWithParam<MethodKind> {};
INSTANTIATE_TEST_SUITE_P(Pull, EveryMethod, testing::ValuesIn(all_methods()),
                         [](const auto& tested) { return test_name(tested.param); });

TEST_P(EveryMethod, KeepsTheVertexUnderTheCursor) {
    Stage stage;
    stage.state.method = GetParam();
    stage.settle();
    const int v = top_vertex(stage);
    const Eigen::Vector2d before = stage.pixel(v);
    stage.move(before + kAside);
    ASSERT_EQ(stage.hovered(), v);
    stage.press();
    stage.move(before + kAside + kDrag);
    stage.settle();
    EXPECT_LT((stage.pixel(v) - before - kDrag).norm(), kPixels);
    stage.release();
    stage.settle();
    EXPECT_LT((stage.pixel(v) - before - kDrag).norm(), kPixels);
    EXPECT_EQ(stage.scene().owner(v), 0);
}

TEST(Pull, MovesInThePlaneOfTheScreen) {
    Stage stage;
    const int v = top_vertex(stage);
    const Eigen::Vector3d before = stage.place(v);
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    stage.settle();
    EXPECT_NEAR((stage.place(v) - before).dot(stage.state.camera.backward()), 0.0, 1e-12);
    EXPECT_GT((stage.place(v) - before).norm(), 0.01);
}

TEST(Pull, WithShiftGoesAlongTheNormal) {
    Stage stage;
    const int v = top_vertex(stage);
    const Eigen::Vector3d up(0, 0, 0.2);
    stage.modifiers = GLFW_MOD_SHIFT;
    stage.drag(stage.pixel(v), stage.pixel(stage.place(v) + up));
    EXPECT_LT((stage.motion(0).translate - up).norm(), 1e-9) << stage.motion(0).translate.transpose();
}

TEST(Pull, WithAnAxisKeyGoesAlongThatAxis) {
    for (int axis = 0; axis < 3; ++axis) {
        Stage stage;
        const int v = top_vertex(stage);
        const Eigen::Vector3d shift = 0.2 * Eigen::Vector3d::Unit(axis);
        stage.key(GLFW_KEY_X + axis, true);
        stage.drag(stage.pixel(v), stage.pixel(stage.place(v) + shift));
        EXPECT_LT((stage.motion(0).translate - shift).norm(), 1e-9) << stage.motion(0).translate.transpose();
    }
}

/// As chosen in the panel, for those who have no key at hand; a key still asks for another.
TEST(Pull, GoesTheWayThatIsChosenInThePanel) {
    Stage stage;
    stage.state.tools.pull_mode = PullMode::axis_x;
    const int v = top_vertex(stage);
    const Eigen::Vector3d along_x(0.2, 0, 0), along_y(0, 0.1, 0);
    stage.drag(stage.pixel(v), stage.pixel(stage.place(v) + along_x));
    EXPECT_LT((stage.motion(0).translate - along_x).norm(), 1e-9);
    stage.settle();
    stage.key(GLFW_KEY_Y, true);
    stage.drag(stage.pixel(v), stage.pixel(stage.place(v) + along_y));
    EXPECT_LT((stage.motion(0).translate - along_x - along_y).norm(), 1e-9);
}

TEST(Pull, ForgetsAKeyThatWasLetGoOrLostWithTheFocus) {
    for (const bool focus : {false, true}) {
        Stage stage;
        const int v = top_vertex(stage);
        stage.key(GLFW_KEY_X, true);
        GestureContext context = stage.state.gesture_context();
        if (focus)
            stage.state.gestures.handle({.kind = InputEvent::Kind::focus}, context);
        else
            stage.key(GLFW_KEY_X, false);
        stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
        EXPECT_GT(stage.motion(0).translate.tail(2).norm(), 0.01);
    }
}

TEST(Pull, ChangesItsWayWithoutAJump) {
    Stage stage;
    const int v = top_vertex(stage);
    const Eigen::Vector3d start = stage.place(v), up(0, 0, 0.15);
    stage.move(stage.pixel(v));
    stage.press();
    stage.move(stage.pixel(v) + kDrag);  // no frame from here on: what is shown lags behind
    const Eigen::Vector3d first = stage.motion(0).translate;
    stage.modifiers = GLFW_MOD_SHIFT;
    stage.key(GLFW_KEY_LEFT_SHIFT, true);
    EXPECT_EQ(stage.motion(0).translate, first);
    stage.move(stage.pixel(start + first + up));
    EXPECT_LT((stage.motion(0).translate - first - up).norm(), 1e-9);
}

TEST(Pull, WithControlTurnsThePatchAboutItsMiddle) {
    Stage stage;
    stage.state.tools.patch_radius = 0.35;
    const int v = top_vertex(stage);
    stage.modifiers = GLFW_MOD_CONTROL;
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    const AffineMotion motion = stage.motion(0);
    const Eigen::Matrix3d map = Eigen::Matrix3d::Identity() + map_of(motion).matrix;
    EXPECT_LT((map * map.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_GT(motion.rotate.degrees, 10.0);
    const std::vector<int> patch(stage.scene().vertices(0).begin(), stage.scene().vertices(0).end());
    ASSERT_GT(std::ssize(patch), 3);
    const Positions rest = stage.scene().mesh().vertices(Eigen::all, patch);
    EXPECT_LT(mean_displacement(motion, rest).norm(), 1e-12);
}

/// A hundredth of a radian a pixel: what goes on in one direction goes round and round.
TEST(Pull, WithControlTurnsByMoreThanAFullTurn) {
    Stage stage;
    stage.state.tools.patch_radius = 0.35;
    const Eigen::Vector2d from = stage.pixel(top_vertex(stage));
    stage.modifiers = GLFW_MOD_CONTROL;
    stage.drag(from, from + Eigen::Vector2d(-700, 0));
    EXPECT_NEAR(stage.motion(0).rotate.degrees, 7.0 * 180.0 / std::acos(-1.0), 1e-9);
    EXPECT_LT((stage.motion(0).rotate.axis + stage.state.camera.up()).norm(), 1e-9);
}

TEST(Pull, WithAltScalesThePatchUpwardLarger) {
    Stage stage;
    stage.state.tools.patch_radius = 0.35;
    const int v = top_vertex(stage);
    stage.modifiers = GLFW_MOD_ALT;
    stage.drag(stage.pixel(v), stage.pixel(v) - Eigen::Vector2d(0, 60));
    const Eigen::Matrix3d matrix = stage.motion(0).matrix;
    EXPECT_GT(matrix(0, 0), 0.1);
    EXPECT_LT((matrix - matrix(0, 0) * Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(Pull, AClickMakesNoHandle) {
    Stage stage;
    stage.click(stage.pixel(top_vertex(stage)));
    EXPECT_EQ(stage.scene().n_handles(), 0);
    EXPECT_FALSE(stage.scene().can_undo());
    EXPECT_FALSE(stage.scene().modified());
}

TEST(Pull, GrabsAHandleAgain) {
    Stage stage;
    const int v = top_vertex(stage);
    const Eigen::Vector2d before = stage.pixel(v);
    for (int i = 1; i <= 2; ++i) {
        stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
        stage.settle();
        EXPECT_EQ(stage.scene().n_handles(), 1);
        EXPECT_LT((stage.pixel(v) - before - i * kDrag).norm(), kPixels);
    }
    stage.state.undo();
    stage.settle();
    EXPECT_LT((stage.pixel(v) - before - kDrag).norm(), kPixels);
}

TEST(Pull, AClickOnAHandleChoosesIt) {
    Stage stage;
    const int first = top_vertex(stage), second = stage.vertex_near({1, 0, 0.67});
    for (const int v : {first, second}) {
        stage.drag(stage.pixel(v), stage.pixel(v) + 0.2 * kDrag);
        stage.settle();
    }
    ASSERT_EQ(stage.scene().n_handles(), 2);
    stage.click(stage.pixel(first));
    EXPECT_EQ(stage.state.gestures.selected_handle(), 0);
    stage.state.remove_handle(0);
    EXPECT_EQ(stage.scene().owner(first), LiveScene::kNobody);
    EXPECT_EQ(stage.scene().owner(second), 0);
}

TEST(Pull, SpringsBackWhereThatIsChosen) {
    Stage stage;
    stage.state.tools.release = Release::spring_back;
    const int v = top_vertex(stage);
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    GestureContext context = stage.state.gesture_context();
    double size = stage.motion(0).translate.norm();
    ASSERT_TRUE(stage.state.gestures.animate(10.0, context));
    for (double now = 10.05; stage.state.gestures.animate(now, context); now += 0.05) {
        ASSERT_LT(stage.motion(0).translate.norm(), size);
        size = stage.motion(0).translate.norm();
        ASSERT_LT(now, 20.0) << "it never comes to rest";
    }
    EXPECT_EQ(stage.scene().n_handles(), 0);
    EXPECT_FALSE(stage.scene().can_undo());
}

TEST(Pull, ARemovalWhileAnotherHandleSpringsBackTakesTheOneThatWasMeant) {
    Stage stage;
    const int first = top_vertex(stage), second = stage.vertex_near({1, 0, 0.67});
    for (const int v : {first, second}) {
        stage.drag(stage.pixel(v), stage.pixel(v) + 0.2 * kDrag);
        stage.settle();
    }
    const int third = stage.vertex_near({1, 0.67, 0.33});
    stage.drag(stage.pixel(third), stage.pixel(third) + 0.2 * kDrag);
    stage.settle();
    stage.state.tools.release = Release::spring_back;
    stage.drag(stage.pixel(first), stage.pixel(first) + 0.2 * kDrag);
    stage.state.remove_handle(stage.scene().owner(second));
    EXPECT_EQ(stage.scene().owner(first), LiveScene::kNobody);
    EXPECT_EQ(stage.scene().owner(second), LiveScene::kNobody);
    EXPECT_EQ(stage.scene().owner(third), 0);
}

TEST(Pull, AFixedVertexIsNotPulledAndSaysWhy) {
    Stage stage;
    const int v = stage.vertex_near({0, 1.0 / 3, 1});
    const Eigen::Vector3d eye = stage.state.camera.eye();
    stage.drag(stage.pixel(v) + Eigen::Vector2d(1.0, 1.0), stage.pixel(v) + kDrag);
    EXPECT_EQ(stage.scene().n_handles(), 0);
    EXPECT_THAT(stage.state.gestures.hint(), HasSubstr("fixed"));
    EXPECT_EQ(stage.state.camera.eye(), eye) << "the view has turned";
    EXPECT_EQ(stage.state.gestures.action(), Gestures::Action::none);
}

TEST(Pull, DeleteDuringADragRemovesTheHandleAndUndoBringsItBackAsItWas) {
    Stage stage;
    const int v = top_vertex(stage);
    stage.drag(stage.pixel(v) + kAside, stage.pixel(v) + kAside + kDrag);  // made and left
    stage.settle();
    const AffineMotion before = stage.motion(0);
    stage.wait(1.0);
    stage.move(stage.pixel(v) + kAside);
    stage.press();
    stage.move(stage.pixel(v) + kAside + kDrag);
    stage.key(GLFW_KEY_DELETE, true);
    stage.key(GLFW_KEY_DELETE, false);
    EXPECT_EQ(stage.scene().n_handles(), 0);
    const Eigen::Vector3d eye = stage.state.camera.eye();
    stage.move(stage.pixel(v));  // the button is still down
    stage.release();
    EXPECT_EQ(stage.state.camera.eye(), eye);
    EXPECT_EQ(stage.scene().n_handles(), 0);
    stage.state.undo();
    ASSERT_EQ(stage.scene().n_handles(), 1);
    EXPECT_EQ(stage.motion(0), before);
}

/// What another handle has bent is taken hold of where it is: nothing moves before the mouse does.
TEST(Pull, OfAPatchThatIsDeformedBeginsWhereItIs) {
    for (const double scale : {1.0, 2.0}) {
        Stage stage(6);
        stage.state.display.deformation_scale = scale;
        stage.settle();
        const int first = stage.vertex_near({1, 0, 1});
        stage.drag(stage.pixel(first), stage.pixel(first) + Eigen::Vector2d(0, -60));
        stage.settle();
        stage.state.tools.patch_radius = 0.3;
        const int v = stage.vertex_near({0.67, 0.33, 1});
        const Positions before = *stage.state.gesture_context().targets[0].positions;
        ASSERT_GT((before.col(v) - stage.scene().mesh().vertices.col(v)).norm(), 0.02);
        const Eigen::Vector2d at = stage.pixel(v), small(4.0, 0.0);
        stage.wait(1.0);
        stage.move(at);
        stage.press();
        stage.move(at + small);
        stage.settle();
        ASSERT_EQ(stage.scene().n_handles(), 2);
        const Eigen::Vector3d shift = stage.place(v) - before.col(v);
        for (const int other : stage.scene().vertices(1))
            EXPECT_LT((stage.place(other) - before.col(other) - shift).norm(), 0.012 * scale * 0.3) << other;
        EXPECT_LT((stage.pixel(v) - at - small).norm(), 1.5);
        stage.release();
    }
}

/// With the body let go as it was, and not by way of its rest.
TEST(Pull, OfAPatchThatIsDeformedSpringsBackToWhereItWas) {
    Stage stage(4);
    const int first = stage.vertex_near({1, 0, 1}), v = stage.vertex_near({0.75, 0.25, 1});
    stage.drag(stage.pixel(first), stage.pixel(first) + Eigen::Vector2d(0, -60));
    stage.settle();
    const Eigen::Vector3d before = stage.place(v);
    stage.state.tools.release = Release::spring_back;
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    GestureContext context = stage.state.gesture_context();
    ASSERT_TRUE(stage.state.gestures.animate(10.0, context));
    double distance = 1e9;
    for (double now = 10.02; stage.state.gestures.animate(now, context); now += 0.02) {
        const Motion& motion = stage.scene().document().handles.at(1).motion;
        const Eigen::Vector3d rest = stage.scene().mesh().vertices.col(v);
        distance = (rest + mean_displacement(motion, rest) - before).norm();
    }
    EXPECT_LT(distance, 0.02);
    stage.settle();
    EXPECT_LT((stage.place(v) - before).norm(), 1e-9);
}

TEST(Pull, EscapeTakesItBack) {
    Stage stage;
    const int v = top_vertex(stage);
    const auto escape_from_a_pull = [&] {
        stage.wait(1.0);
        stage.move(stage.pixel(v) + kAside);
        stage.press();
        stage.move(stage.pixel(v) + kAside + kDrag);
        EXPECT_TRUE(stage.state.gestures.dragging());
        stage.key(GLFW_KEY_ESCAPE, true);
        stage.key(GLFW_KEY_ESCAPE, false);
        stage.move(stage.pixel(v));  // the button is still down
        stage.release();
        stage.settle();
    };
    escape_from_a_pull();
    EXPECT_EQ(stage.scene().n_handles(), 0);
    EXPECT_FALSE(stage.scene().can_undo());
    stage.drag(stage.pixel(v) + kAside, stage.pixel(v) + kAside + kDrag);
    stage.settle();
    const AffineMotion before = stage.motion(0);
    escape_from_a_pull();
    ASSERT_EQ(stage.scene().n_handles(), 1);
    EXPECT_EQ(stage.motion(0), before);
    stage.state.undo();
    EXPECT_EQ(stage.scene().n_handles(), 0) << "the pull that was taken back is no step";
}

TEST(Pull, FollowsTheCursorInAnExaggeratedView) {
    Stage stage;
    stage.state.display.deformation_scale = 3.0;
    stage.settle();
    const int v = top_vertex(stage);
    const Eigen::Vector2d before = stage.pixel(v);
    stage.drag(before, before + kDrag);
    stage.settle();
    EXPECT_LT((stage.pixel(v) - before - kDrag).norm(), kPixels);
}

TEST(Pull, ThroughASpringKeepsTheMomentOfAHandle) {
    Stage stage;
    stage.settle();
    const int v = top_vertex(stage);
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    stage.scene().set_force(0, GripForce{{0, 0, 0.01}, {0.001, 0, 0.002}});
    stage.settle();
    stage.state.tools.pull_mode = PullMode::spring;
    stage.state.tools.spring = 1.0;
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    const std::optional<GripForce> force = stage.scene().document().handles[0].force;
    ASSERT_TRUE(force);
    EXPECT_NE(force->force, Eigen::Vector3d(0, 0, 0.01));
    EXPECT_EQ(force->moment, Eigen::Vector3d(0.001, 0, 0.002));
}

TEST(Pull, OfAHandleUnderAForceSaysThatTheForceIsGone) {
    Stage stage;
    stage.settle();
    const int v = top_vertex(stage);
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    EXPECT_EQ(stage.state.gestures.hint(), "");
    stage.scene().set_force(0, GripForce{.force = {0, 0, 0.01}, .moment = {0, 0, 0}});
    stage.scene().commit();
    stage.settle();
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    EXPECT_FALSE(stage.scene().document().handles[0].force);
    EXPECT_THAT(stage.state.gestures.hint(), HasSubstr("Undo"));
    stage.state.undo();
    EXPECT_TRUE(stage.scene().document().handles[0].force);
    EXPECT_EQ(stage.state.gestures.hint(), "") << "it is back";
}

TEST(Pull, WorksInEveryViewOfAComparison) {
    Stage stage;
    stage.state.compare.mode = CompareMode::side_by_side;
    stage.settle();
    stage.state.frame_body();
    ASSERT_THAT(stage.state.shown.viewports, SizeIs(4));
    const int v = top_vertex(stage);
    const Eigen::Vector2d before = stage.pixel(v, 2);
    stage.move(before);
    ASSERT_EQ(stage.hovered(), v);
    stage.drag(before, before + 0.3 * kDrag);
    stage.settle();
    for (std::size_t view = 0; view < 4; ++view) {
        const Eigen::Vector2d corner(stage.state.shown.viewports[view].place.x,
                                     stage.state.shown.viewports[view].place.y);
        const Eigen::Vector2d of_pulled(stage.state.shown.viewports[2].place.x, stage.state.shown.viewports[2].place.y);
        EXPECT_LT((stage.pixel(v, view) - corner - stage.pixel(v, 2) + of_pulled).norm(), kPixels) << view;
    }
    EXPECT_LT((stage.pixel(v, 2) - before - 0.3 * kDrag).norm(), kPixels);
}

TEST(Pull, HoveringShowsThePatchThatAPressWouldGrab) {
    Stage stage;
    stage.state.tools.patch_radius = 0.35;
    const int v = top_vertex(stage);
    stage.move(stage.pixel(v));
    const std::vector<int> patch = stage.state.gestures.hover().patch;
    EXPECT_THAT(patch, SizeIs(testing::Gt(3)));
    stage.drag(stage.pixel(v), stage.pixel(v) + kDrag);
    EXPECT_EQ(std::vector<int>(stage.scene().vertices(0).begin(), stage.scene().vertices(0).end()), patch);
    stage.move(stage.empty_place());
    EXPECT_EQ(stage.state.gestures.hover(), Hover{});
}

TEST(Pull, HiddenVerticesAreNotPicked) {
    Stage stage;
    for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v) {
        const Eigen::Vector3d to_eye = stage.state.camera.eye() - stage.place(v);
        stage.move(stage.pixel(v));
        if (stage.hovered() != v) continue;
        const Eigen::Vector3d x = stage.place(v);
        const bool faces_eye =
            (x.array() < 1e-9 && to_eye.array() < 0.0).any() || (x.array() > 1 - 1e-9 && to_eye.array() > 0.0).any();
        EXPECT_TRUE(faces_eye) << x.transpose();
    }
}

TEST(Pull, EndsWhenTheSceneIsReplaced) {
    Stage stage;
    stage.move(stage.pixel(top_vertex(stage)));
    stage.press();
    stage.move(stage.pixel(top_vertex(stage)) + kDrag);
    stage.open(cube_document(2));
    EXPECT_FALSE(stage.state.gestures.pulling());
    stage.move(stage.pixel(3) + kDrag);
    stage.release();
    EXPECT_EQ(stage.scene().n_handles(), 0);
}

}  // namespace
}  // namespace elastolab::test
