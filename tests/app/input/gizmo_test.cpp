// Gizmos, as a person takes hold of them: where they are drawn is where they can be dragged, and what was dragged under
// the cursor stays there.
#include "app/input/gizmo.hpp"

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <numbers>

#include "app/stage.hpp"

namespace elastolab::test {
namespace {

using Kind = GizmoPart::Kind;

/// A cube with a handle on its far face that is selected.
class GizmoTest : public testing::Test {
protected:
    GizmoTest() {
        std::vector<int> face;
        for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v)
            if (stage.scene().mesh().vertices(0, v) > 0.999) face.push_back(v);
        stage.scene().add_handle(face);
        stage.scene().commit();
        stage.state.gestures.select_handle(0);
        stage.settle();
    }

    const Viewport& viewport() const { return stage.state.shown.viewports.front().place; }
    Gizmo gizmo() const { return stage.state.gizmos().front(); }
    /// Where a part can be taken hold of: not near others.
    Eigen::Vector2d place_of(const GizmoPart& part) const {
        for (const Eigen::Vector2d& pixel : outline(gizmo(), part, stage.state.camera, viewport()))
            if (part_at(gizmo(), stage.state.camera, viewport(), pixel) == part) return pixel;
        ADD_FAILURE() << "the part cannot be taken hold of";
        return {0, 0};
    }
    /// Drags a part until its axis has gone on by this much, as seen.
    void drag_along(int axis, double length) {
        const Eigen::Vector2d from = place_of({Kind::arrow, axis}), middle = stage.pixel(gizmo().center);
        const Eigen::Vector2d to = stage.pixel(gizmo().center + length * gizmo().axes.col(axis));
        stage.drag(from, from + (to - middle));
        stage.settle();
    }
    Eigen::Vector3d moved() const {
        const auto vertices = stage.state.scene().vertices(0);
        return mean_displacement(stage.motion(0), stage.state.scene().mesh().vertices(
                                                      Eigen::all, std::vector<int>(vertices.begin(), vertices.end())));
    }

    Stage stage;
};

TEST_F(GizmoTest, StandsAtTheSelectedHandleOnly) {
    ASSERT_EQ(stage.state.gizmos().size(), 1u);
    EXPECT_LT((gizmo().center - Eigen::Vector3d(1.0, 0.5, 0.5)).norm(), 1e-12);
    EXPECT_EQ(gizmo().parts.size(), 6u);
    stage.state.gestures.select_handle(-1);
    EXPECT_TRUE(stage.state.gizmos().empty());
    stage.state.gestures.select_handle(0);
    stage.state.tools.tool = Tool::brush;
    EXPECT_TRUE(stage.state.gizmos().empty());
    stage.state.tools.tool = Tool::pull;
    stage.state.tools.gizmo = false;
    EXPECT_TRUE(stage.state.gizmos().empty());
}

/// A key may remove a handle, and a press follow, before the next frame says what can be taken hold of.
TEST_F(GizmoTest, OfAHandleThatIsGoneIsNotTakenHoldOf) {
    GestureContext before = stage.state.gesture_context();
    ASSERT_EQ(before.gizmos.size(), 1u);
    const Eigen::Vector2d place = place_of({Kind::arrow, 2});
    stage.scene().remove_handle(0);
    Gestures& gestures = stage.state.gestures;
    gestures.handle({.kind = InputEvent::Kind::cursor, .cursor = place}, before);
    gestures.handle({.kind = InputEvent::Kind::button, .code = 0, .pressed = true, .seconds = 10.0}, before);
    EXPECT_FALSE(gestures.gizmo_drag());
}

TEST_F(GizmoTest, ArrowsMoveAlongTheirAxisOnly) {
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d before = moved();
        drag_along(axis, 0.15);
        const Eigen::Vector3d by = moved() - before;
        EXPECT_NEAR(by[axis], 0.15, 0.02) << axis;  // the drag began at the arrow, whose perspective differs
        EXPECT_NEAR(by[(axis + 1) % 3], 0.0, 1e-12);
        EXPECT_NEAR(by[(axis + 2) % 3], 0.0, 1e-12);
    }
}

TEST_F(GizmoTest, RingsTurnAboutTheirAxisAndTheMiddle) {
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Matrix3d before = Eigen::Matrix3d::Identity() + map_of(stage.motion(0)).matrix;
        const Eigen::Vector2d from = place_of({Kind::ring, axis}), middle = stage.pixel(gizmo().center);
        stage.drag(from, middle + Eigen::Rotation2Dd(0.3) * (from - middle));
        stage.settle();
        const Eigen::Matrix3d turn =
            (Eigen::Matrix3d::Identity() + map_of(stage.motion(0)).matrix) * before.transpose();
        const Eigen::AngleAxisd found(turn);
        EXPECT_GT(std::abs(found.angle()), 0.05) << axis;
        EXPECT_NEAR(std::abs(found.axis()[axis]), 1.0, 1e-9);
        EXPECT_LT(moved().norm(), 1e-9);
    }
}

/// The point of the ring that was taken hold of stays under the cursor.
TEST_F(GizmoTest, RingsFollowTheCursor) {
    const GizmoPart part{Kind::ring, 0};
    const Eigen::Vector2d from = place_of(part), middle = stage.pixel(gizmo().center);
    const Gizmo before = gizmo();
    const Eigen::Vector2d to = middle + Eigen::Rotation2Dd(0.4) * (from - middle);
    const double angle = dragged(before, part, stage.state.camera, viewport(), from, to);
    stage.drag(from, to);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(Eigen::Matrix3d::Identity() + map_of(stage.motion(0)).matrix));
    EXPECT_NEAR(turn.angle() * turn.axis()[0], angle, 1e-9);
    // The rays of both cursors meet the plane of the ring in directions that lie this angle apart.
    const auto direction = [&](const Eigen::Vector2d& cursor) {
        const Ray ray = stage.state.camera.ray(cursor, viewport());
        const double t = (before.center.x() - ray.origin.x()) / ray.direction.x();
        return (ray.origin + t * ray.direction - before.center).normalized();
    };
    EXPECT_LT((turn * direction(from) - direction(to)).norm(), 1e-9);
}

/// Round and round: what is turned adds up beyond half a turn, and back again, in one step of undo.
TEST_F(GizmoTest, RingsTurnBySeveralFullTurns) {
    const GizmoPart part{Kind::ring, 0};
    const Gizmo before = gizmo();
    const Eigen::Vector2d from = place_of(part);
    const Eigen::Vector3d start = before.center + 0.3 * before.axes.col(1);
    const auto cursor = [&](double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0;
        return stage.pixel(before.center + Eigen::AngleAxisd(angle, before.axes.col(0)) * (start - before.center));
    };
    stage.move(from);
    stage.press();
    stage.move(cursor(0.0));
    const auto turned = [&] { return stage.motion(0).rotate.degrees * stage.motion(0).rotate.axis[0]; };
    const double first = turned();
    for (int degrees = 40; degrees <= 800; degrees += 40) stage.move(cursor(degrees));
    EXPECT_NEAR(std::abs(turned() - first), 800.0, 1e-6);
    EXPECT_NEAR(std::abs(stage.motion(0).rotate.axis[0]), 1.0, 1e-12);
    for (int degrees = 760; degrees >= 720; degrees -= 40) stage.move(cursor(degrees));
    stage.release();
    EXPECT_NEAR(std::abs(turned() - first), 720.0, 1e-6);
    EXPECT_LT(moved().norm(), 1e-9);
    const AffineMotion left = stage.motion(0);
    stage.state.undo();
    EXPECT_EQ(stage.motion(0), AffineMotion{});
    stage.state.redo();
    EXPECT_EQ(stage.motion(0), left);
}

TEST_F(GizmoTest, WithControlGoesInSteps) {
    stage.modifiers = GLFW_MOD_CONTROL;
    drag_along(1, 0.13);
    const double step = snap_length(stage.scene());
    EXPECT_GT(std::abs(moved().y()), 0.05);
    EXPECT_NEAR(std::remainder(moved().y(), step), 0.0, 1e-12);
    const Eigen::Vector2d from = place_of({Kind::ring, 2}), middle = stage.pixel(gizmo().center);
    stage.drag(from, middle + Eigen::Rotation2Dd(0.8) * (from - middle));
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(Eigen::Matrix3d::Identity() + map_of(stage.motion(0)).matrix));
    EXPECT_GT(turn.angle(), 0.1);
    EXPECT_NEAR(std::remainder(turn.angle(), std::numbers::pi / 12.0), 0.0, 1e-9);
}

TEST_F(GizmoTest, HasAxesOfWorldSurfaceAndHandle) {
    stage.state.tools.gizmo_axes = GizmoAxes::surface;
    EXPECT_LT((gizmo().axes.col(2) - Eigen::Vector3d::UnitX()).norm(), 1e-12);  // the normal of the face
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()).toRotationMatrix();
    stage.scene().set_motion(0, AffineMotion{.matrix = 1.3 * turn - Eigen::Matrix3d::Identity()});
    stage.settle();
    stage.state.tools.gizmo_axes = GizmoAxes::own;
    EXPECT_LT((gizmo().axes - turn).norm(), 1e-12);
    stage.state.tools.gizmo_axes = GizmoAxes::world;
    EXPECT_EQ(gizmo().axes, Eigen::Matrix3d::Identity());
}

TEST_F(GizmoTest, LeavesTheMiddleToTheHandleItself) {
    const Eigen::Vector2d middle = stage.pixel(gizmo().center);
    EXPECT_FALSE(part_at(gizmo(), stage.state.camera, viewport(), middle));
    stage.move(place_of({Kind::arrow, 1}));
    EXPECT_EQ(stage.state.gestures.hover().part, std::pair(0, GizmoPart{Kind::arrow, 1}));
    EXPECT_TRUE(stage.state.gestures.hover().patch.empty());
    stage.move(stage.empty_place());
    EXPECT_FALSE(stage.state.gestures.hover().part);
}

TEST_F(GizmoTest, IsOneStepOfUndoAndAClickIsNone) {
    const Eigen::Vector2d from = place_of({Kind::arrow, 2});
    stage.click(from);
    EXPECT_EQ(stage.motion(0), AffineMotion{});
    drag_along(2, 0.2);
    EXPECT_GT(moved().norm(), 0.1);
    stage.state.undo();
    EXPECT_EQ(stage.motion(0), AffineMotion{});
}

TEST_F(GizmoTest, StaysWhereItWasPutWhenPatchesSpringBack) {
    stage.state.tools.release = Release::spring_back;
    drag_along(2, 0.2);
    EXPECT_EQ(stage.scene().n_handles(), 1);
    EXPECT_GT(moved().z(), 0.1);
}

TEST_F(GizmoTest, MovesAndTurnsThePlaneOfTheCut) {
    stage.state.gestures.select_handle(-1);
    stage.state.display.section = true;
    stage.state.display.cut.axis = 1;
    stage.settle();
    ASSERT_EQ(stage.state.gizmos().size(), 1u);
    EXPECT_LT((gizmo().center - Eigen::Vector3d(0.5, 0.5, 0.5)).norm(), 1e-12);
    drag_along(0, 0.2);
    EXPECT_NEAR(stage.state.display.cut.place, 0.7, 0.03);
    EXPECT_NEAR(gizmo().center.y(), stage.state.display.cut.place, 1e-12);
    EXPECT_EQ(stage.scene().n_handles(), 1);
    for (const int axis : {1, 2}) {
        const Eigen::Vector2d from = place_of({Kind::ring, axis}), middle = stage.pixel(gizmo().center);
        stage.drag(from, middle + Eigen::Rotation2Dd(0.3) * (from - middle));
        stage.settle();
    }
    EXPECT_GT(std::abs(stage.state.display.cut.turn), 3.0);
    EXPECT_GT(std::abs(stage.state.display.cut.tilt), 3.0);
    EXPECT_LT(std::abs(stage.state.display.cut.turn), 90.0);
}

/// Turned by a ring, the normal turns by the angle that was dragged.
TEST_F(GizmoTest, TurnsTheNormalOfTheCutWithTheRing) {
    stage.state.gestures.select_handle(-1);
    stage.state.display.section = true;
    stage.state.display.cut.turn = 20.0;
    stage.settle();
    for (const int axis : {1, 2}) {
        const Gizmo before = gizmo();
        const Eigen::Vector2d from = place_of({Kind::ring, axis}), middle = stage.pixel(before.center);
        const Eigen::Vector2d to = middle + Eigen::Rotation2Dd(0.2) * (from - middle);
        const double angle = dragged(before, {Kind::ring, axis}, stage.state.camera, viewport(), from, to);
        stage.drag(from, to);
        stage.settle();
        const Eigen::Vector3d expected = Eigen::AngleAxisd(angle, before.axes.col(axis)) * before.axes.col(0);
        EXPECT_LT((gizmo().axes.col(0) - expected).norm(), 1e-9) << axis;
    }
}

}  // namespace
}  // namespace elastolab::test
