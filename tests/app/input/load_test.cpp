// What the mouse does with loads: the force tool, arrows, the pressure brush, gravity.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "app/picture/load_arrows.hpp"
#include "app/selection.hpp"
#include "app/stage.hpp"
#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

const Eigen::Vector2d kDragged(60.0, -50.0);

int vertex_on_top(const Stage& stage) { return stage.vertex_near({2.0 / 3, 1.0 / 3, 1.0}); }

Eigen::Vector3d force_of(const Stage& stage, int load) {
    return std::get<ForceLoad>(stage.state.scene().document().loads[static_cast<std::size_t>(load)].value).force;
}

LoadArrow arrow_of(Stage& stage, int load) {
    for (const LoadArrow& arrow : stage.state.gesture_context().load_arrows)
        if (arrow.load == load) return arrow;
    throw std::out_of_range("no arrow");
}

/// Before the method has answered, too: the press comes first.
TEST(ForceTool, PullsAtAPatchByAnArrowThatEndsAtTheCursor) {
    for (const bool settled : {true, false}) {
        Stage stage;
        stage.state.tools.tool = Tool::force;
        stage.settle();
        if (!settled) {
            stage.state.select_method(kQuadraticFem);
            stage.frame();
        }
        const int v = vertex_on_top(stage);
        const Eigen::Vector2d from = stage.pixel(v);
        stage.move(from);
        stage.press();
        for (const double part : {0.3, 0.6, 1.0}) {
            stage.move(from + part * kDragged);
            stage.frame();
        }
        ASSERT_EQ(stage.scene().n_loads(), 1);
        const Eigen::Vector3d force = force_of(stage, 0);
        EXPECT_GT(force.norm(), 0.0);
        EXPECT_NEAR(force.dot(stage.state.camera.backward()), 0.0, 1e-9 * force.norm()) << "in the plane of the screen";
        stage.release();
        stage.settle();
        EXPECT_EQ(stage.scene().n_handles(), 0);
        const Eigen::Vector3d moved = stage.place(v) - stage.scene().mesh().vertices.col(v);
        EXPECT_GT(moved.dot(force), 0.0);
        EXPECT_EQ(stage.state.gestures.selected_load(), 0);
        stage.state.undo();
        EXPECT_EQ(stage.scene().n_loads(), 0) << "one step";
        stage.state.redo();
        EXPECT_EQ(force_of(stage, 0), force);
    }
}

/// It was drawn from the patch to the cursor, and stands there still when the button is let go.
TEST(ForceTool, LeavesTheArrowWhereItWasDrawn) {
    Stage stage;
    stage.state.tools.tool = Tool::force;
    stage.settle();
    // From the side that is seen, so that the force goes into the body and not away from it.
    const int v = stage.vertex_near({1.0, 2.0 / 3, 1.0 / 3});
    for (const Eigen::Vector2d& dragged : {Eigen::Vector2d(60, 0), Eigen::Vector2d(-60, 0), Eigen::Vector2d(0, 60)}) {
        const Eigen::Vector2d from = stage.pixel(v);
        stage.drag(from, from + dragged);
        ASSERT_EQ(stage.scene().n_loads(), 1);
        const LoadArrow arrow = arrow_of(stage, 0);
        EXPECT_GT((stage.pixel(arrow.end) - stage.pixel(arrow.place)).dot(dragged), 0.0) << dragged.transpose();
        stage.state.clear_loads();
        stage.settle();
        stage.wait(1.0);
    }
}

/// What is shown as selected is what Del removes.
TEST(ForceTool, SelectsItsLoadInPlaceOfAHandle) {
    Stage stage;
    stage.settle();
    const Eigen::Vector2d place = stage.pixel(vertex_on_top(stage));
    stage.drag(place, place + kDragged);
    stage.wait(1.0);
    ASSERT_EQ(stage.state.gestures.selected_handle(), 0);
    stage.state.tools.tool = Tool::force;
    const Eigen::Vector2d other = stage.pixel(stage.vertex_near({1.0, 2.0 / 3, 1.0 / 3}));
    stage.drag(other, other + kDragged);
    ASSERT_EQ(stage.scene().n_loads() + stage.scene().n_handles(), 2);
    ASSERT_EQ(stage.state.gestures.selected_load(), 0);
    EXPECT_EQ(stage.state.gestures.selected_handle(), -1);
    stage.state.gestures.select_handle(0);
    EXPECT_FALSE(stage.state.gestures.selected_load());
}

TEST(ForceTool, WithShiftPressesAlongTheNormalAndAClickLoadsNothing) {
    Stage stage;
    stage.state.tools.tool = Tool::force;
    stage.settle();
    stage.click(stage.pixel(vertex_on_top(stage)));
    EXPECT_EQ(stage.scene().n_loads(), 0);
    EXPECT_FALSE(stage.scene().can_undo());
    stage.wait(1.0);
    stage.modifiers = GLFW_MOD_SHIFT;
    const Eigen::Vector2d from = stage.pixel(vertex_on_top(stage));
    stage.drag(from, from + Eigen::Vector2d(0, 40));
    const Eigen::Vector3d force = force_of(stage, 0);
    EXPECT_LT(force.z(), 0.0);
    EXPECT_LT(force.head<2>().norm(), 1e-12 * force.norm());
}

/// Cut open, too, where the triangles that are seen are others.
TEST(ForceTool, TakesTheForceThatActsThereAlready) {
    for (const bool cut : {false, true}) {
        SCOPED_TRACE(cut);
        Stage stage;
        stage.state.tools.tool = Tool::force;
        stage.state.tools.patch_radius = 0.4;
        stage.state.display.section = cut;
        stage.state.display.cut.axis = 1;
        stage.state.display.cut.place = 0.9;
        stage.settle();
        const int v = vertex_on_top(stage);
        ASSERT_EQ(stage.state.shown.bodies().at(0).section().has_value(), cut);
        stage.drag(stage.pixel(v), stage.pixel(v) + kDragged);
        stage.settle();
        const Eigen::Vector3d before = force_of(stage, 0);
        stage.wait(1.0);
        stage.drag(stage.pixel(v), stage.pixel(v) + Eigen::Vector2d(20, 0));
        ASSERT_EQ(stage.scene().n_loads(), 1);
        EXPECT_GT((force_of(stage, 0) - before).dot(stage.state.camera.right()), 0.0);
    }
}

TEST(ForceTool, HasNothingToDoWhereTheBodyIsConstrained) {
    Stage stage;
    stage.state.tools.tool = Tool::force;
    stage.state.tools.patch_radius = 0.0;
    std::vector<int> all(static_cast<std::size_t>(stage.scene().mesh().n_vertices()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    stage.scene().fix(all);
    stage.settle();
    const int v = vertex_on_top(stage);
    stage.move(stage.pixel(v));
    stage.press();
    EXPECT_EQ(stage.state.gestures.action(), Gestures::Action::blocked);
    EXPECT_NE(stage.state.gestures.hint().find("no effect"), std::string::npos);
    stage.release();
    EXPECT_EQ(stage.scene().n_loads(), 0);
}

/// The end follows the cursor, by any tool that does not paint; Delete takes the load away.
TEST(LoadArrow, IsDraggedByItsEnd) {
    Stage stage;
    stage.settle();
    const int top = stage.vertex_near({0.5, 0.5, 1.0});
    std::vector<int> patch;
    for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v)
        if (stage.scene().mesh().vertices(2, v) > 1.0 - 1e-9) patch.push_back(v);
    ASSERT_EQ(stage.scene().add_load(patch, ForceLoad{{0, 0, 1e-3}}), 0);
    stage.scene().commit();
    stage.settle();
    const LoadArrow before = arrow_of(stage, 0);
    EXPECT_GT((before.end - before.place).norm(), 0.0) << top;
    const Eigen::Vector2d from = stage.pixel(before.end);
    stage.move(from);
    EXPECT_EQ(stage.state.gestures.hover().load, 0);
    stage.press();
    stage.move(from + kDragged);
    stage.frame();
    const Eigen::Vector3d change = force_of(stage, 0) - Eigen::Vector3d(0, 0, 1e-3);
    const Eigen::Vector2d end = stage.pixel(Eigen::Vector3d(before.end + change / before.value_per_length));
    EXPECT_LT((end - from - kDragged).norm(), 1e-6);
    stage.key(GLFW_KEY_DELETE, true);
    EXPECT_EQ(stage.scene().n_loads(), 0);
    stage.release();
    stage.state.undo();
    EXPECT_EQ(force_of(stage, 0), Eigen::Vector3d(0, 0, 1e-3));
}

/// A change of size or direction is a frame: the method's set stays, and nothing is computed by a worker.
TEST(LoadArrow, IsDraggedWithoutASolve) {
    Stage stage;
    stage.settle();
    stage.scene().set_gravity(Eigen::Vector3d(0, 0, -0.01), 1.0);
    stage.scene().commit();
    stage.settle();
    const LoadArrow gravity = arrow_of(stage, LiveScene::kGravity);
    const Eigen::Vector2d from = stage.pixel(gravity.end);
    stage.move(from);
    stage.press();
    for (int step = 1; step <= 5; ++step) {
        stage.move(from + 0.2 * step * kDragged);
        stage.frame();
        EXPECT_FALSE(stage.state.simulation.waiting());
        EXPECT_TRUE(stage.state.simulation.runner(stage.state.method).answers());
    }
    stage.release();
    EXPECT_GT((*stage.scene().document().gravity - Eigen::Vector3d(0, 0, -0.01)).norm(), 1e-3);
}

TEST(PressureBrush, PaintsAPressureAndTakesItOff) {
    Stage stage(6);
    stage.state.tools.tool = Tool::pressure;
    stage.state.tools.pressure = 0.02;
    stage.state.tools.brush_pixels = 60.0;
    stage.settle();
    stage.drag(stage.pixel(Eigen::Vector3d(0.3, 0.6, 1.0)), stage.pixel(Eigen::Vector3d(0.3, 0.4, 1.0)));
    ASSERT_EQ(stage.scene().n_loads(), 1);
    const auto n_triangles = [&] { return stage.scene().applied_load(0)->triangles.size(); };
    const std::size_t first = n_triangles();
    EXPECT_GE(first, 2u);
    stage.settle();
    EXPECT_LT(stage.place(stage.vertex_near({0.33, 0.33, 1.0})).z(), 1.0) << "presses in";
    stage.wait(1.0);
    stage.drag(stage.pixel(Eigen::Vector3d(0.8, 0.6, 1.0)), stage.pixel(Eigen::Vector3d(0.8, 0.4, 1.0)));
    ASSERT_EQ(stage.scene().n_loads(), 1) << "the selected pressure grows";
    EXPECT_GT(n_triangles(), first);
    stage.modifiers = GLFW_MOD_SHIFT;
    stage.wait(1.0);
    stage.drag(stage.pixel(Eigen::Vector3d(0.8, 0.6, 1.0)), stage.pixel(Eigen::Vector3d(0.8, 0.4, 1.0)));
    ASSERT_EQ(stage.scene().n_loads(), 1);
    EXPECT_EQ(n_triangles(), first) << "what the second stroke has put on is off";
    remove_selection(stage.state);
    EXPECT_EQ(stage.scene().n_loads(), 0);
}

/// A force is dosed by the body that gives way to it: a slender one bends under a hundredth of what a stout one takes.
TEST(ForceTool, MovesThePatchOfASlenderBodyByAboutAsMuchAsTheMouse) {
    for (const char* name : {"cube", "beam"}) {
        Document document;
        document.mesh = Primitive{.name = name, .resolution = 3, .size = {}};
        document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
        LiveScene scene(document, "scene.json");
        const SurfaceMesh& mesh = scene.mesh();
        const double end = mesh.vertices.row(0).maxCoeff();
        std::vector<int> patch;
        for (int v = 0; v < mesh.n_vertices(); ++v)
            if (mesh.vertices(0, v) > end - 1e-9) patch.push_back(v);
        const int load = scene.add_load(patch, ForceLoad{{0, 0, 0}});
        const double ratio = load_arrow(scene, load, mesh.vertices, 1.0)->value_per_length;
        scene.set_load(load, ForceLoad{{0, 0, ratio}});
        Control control;
        Deformer deformer(precompute(scene.body(kFem), Method{.kind = kFem}, control));
        deformer.constrain(scene.constraints().set, control);
        const Eigen::VectorXd u = deformer.displace(scene.constraints().values);
        const double moved = u.reshaped(3, mesh.n_vertices()).colwise().norm().maxCoeff();
        EXPECT_GT(moved, 0.1) << name;
        EXPECT_LT(moved, 3.0) << name;
    }
}

TEST(PressureBrush, PressesTheTriangleUnderTheCursorHoweverSmallItIs) {
    Stage stage(3);
    stage.state.tools.tool = Tool::pressure;
    stage.state.tools.pressure = 0.02;
    stage.state.tools.brush_pixels = 1.0;
    stage.settle();
    stage.drag(stage.pixel(Eigen::Vector3d(0.45, 0.6, 1.0)), stage.pixel(Eigen::Vector3d(0.55, 0.4, 1.0)));
    ASSERT_EQ(stage.scene().n_loads(), 1);
    const std::size_t n = stage.scene().applied_load(0)->triangles.size();
    EXPECT_GE(n, 1u);
    EXPECT_LE(n, 4u);
    stage.modifiers = GLFW_MOD_SHIFT;
    stage.wait(1.0);
    stage.drag(stage.pixel(Eigen::Vector3d(0.45, 0.6, 1.0)), stage.pixel(Eigen::Vector3d(0.55, 0.4, 1.0)));
    EXPECT_EQ(stage.scene().n_loads(), 0) << "and takes it off";
}

TEST(GravityGizmo, TurnsGravity) {
    Stage stage;
    stage.scene().set_gravity(Eigen::Vector3d(0, 0, -9.81), 1e-3);
    stage.scene().commit();
    stage.settle();
    EXPECT_TRUE(stage.state.gizmos().empty());
    stage.state.gestures.select_load(LiveScene::kGravity);
    const std::vector<Gizmo> gizmos = stage.state.gizmos();
    ASSERT_EQ(gizmos.size(), 1u);
    const GizmoPart ring{GizmoPart::Kind::ring, 1};
    const std::vector<Eigen::Vector2d> line =
        outline(gizmos.front(), ring, stage.state.camera, stage.state.shown.viewports.front().place);
    ASSERT_GT(line.size(), 20u);
    stage.drag(line[line.size() / 2], line[line.size() / 2 + 8]);
    const Eigen::Vector3d turned = *stage.scene().document().gravity;
    EXPECT_NEAR(turned.norm(), 9.81, 1e-9);
    EXPECT_NEAR(turned.y(), 0.0, 1e-9);
    EXPECT_GT(std::abs(turned.x()), 0.5);
    stage.state.undo();
    EXPECT_EQ(*stage.scene().document().gravity, Eigen::Vector3d(0, 0, -9.81));
}

/// The patch follows by as much as the spring is stronger than the body; let go, it stays and has the spring's force.
TEST(SpringPull, LetsTheBodyGiveWayAndLeavesAForce) {
    double last = 0.0;
    for (const double stiffness : {0.05, 0.5, 5.0}) {
        Stage stage;
        stage.state.tools.patch_radius = 0.4;
        stage.state.tools.pull_mode = PullMode::spring;
        stage.state.tools.spring = stiffness;
        stage.settle();
        const int v = vertex_on_top(stage);
        const Eigen::Vector2d from = stage.pixel(v);
        stage.move(from);
        stage.press();
        stage.move(from + kDragged);
        stage.settle();
        ASSERT_EQ(stage.scene().n_handles(), 1);
        const GripForce pulled = *stage.scene().document().handles[0].force;
        EXPECT_EQ(pulled.spring, stiffness);
        const Eigen::Vector3d shift =
            mean_displacement(stage.scene().document().handles[0].motion, stage.scene().rest_positions(0));
        EXPECT_GT(shift.norm(), last) << "a stiffer spring moves it further";
        EXPECT_LT(shift.norm(), pulled.force.norm() / stiffness) << "but not as far as the cursor";
        last = shift.norm();
        const Eigen::Vector3d place = stage.place(v);
        stage.release();
        stage.settle();
        const GripForce left = *stage.scene().document().handles[0].force;
        EXPECT_EQ(left.spring, 0.0);
        EXPECT_LT((left.force - (pulled.force - stiffness * shift)).norm(), 1e-12);
        EXPECT_LT((stage.place(v) - place).norm(), 1e-9) << "nothing jumps";
        stage.state.undo();
        EXPECT_EQ(stage.scene().n_handles(), 0);
    }
}

/// A spring is a frame: after the set is there, a drag needs no worker.
TEST(SpringPull, FollowsTheCursorWithoutAWorker) {
    Stage stage;
    stage.state.tools.patch_radius = 0.4;
    stage.state.tools.pull_mode = PullMode::spring;
    stage.state.tools.spring = 0.5;
    stage.settle();
    const Eigen::Vector2d from = stage.pixel(vertex_on_top(stage));
    stage.move(from);
    stage.press();
    stage.move(from + 0.2 * kDragged);
    stage.settle();
    double last = 0.0;
    for (int step = 2; step <= 6; ++step) {
        stage.move(from + 0.2 * step * kDragged);
        stage.frame();
        EXPECT_TRUE(stage.state.simulation.runner(stage.state.method).answers());
        const double moved = (stage.place(vertex_on_top(stage)) - Eigen::Vector3d(2.0 / 3, 1.0 / 3, 1.0)).norm();
        EXPECT_GT(moved, last);
        last = moved;
    }
}

/// Pulled without a spring, a handle under a force goes on from where it is, and is where it is put from then on.
TEST(SpringPull, IsTakenOverByAnOrdinaryPull) {
    Stage stage(4);
    Document document = cube_document_with_handle(4);
    document.handles[0].force = GripForce{.force = {0.0, 0.0, 0.02 * document.material.young_modulus}};
    stage.open(document);
    const int v = stage.vertex_near({1.0, 0.5, 0.5});
    const Eigen::Vector3d before = stage.place(v);
    EXPECT_GT(before.z(), 0.501) << "it has moved to where the force holds it";
    const Eigen::Vector2d from = stage.pixel(v);
    stage.drag(from, from + kDragged);
    stage.settle();
    EXPECT_FALSE(stage.scene().document().handles[0].force.has_value());
    EXPECT_LT((stage.pixel(v) - from - kDragged).norm(), 1e-6);
}

TEST(LoadArrows, AreComputedAnewOnlyWhenTheSetALoadOrThePositionsHaveChanged) {
    Stage stage;
    stage.open(cube_document_with_handle(3));
    std::vector<int> patch;
    for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v)
        if (stage.scene().mesh().vertices(2, v) > 1.0 - 1e-9) patch.push_back(v);
    const int load = stage.scene().add_load(patch, ForceLoad{{0.0, 0.0, 0.01}});
    ASSERT_EQ(load, 0);
    stage.scene().commit();
    stage.settle();
    const auto computed = [&] {
        stage.state.gesture_context();
        return stage.state.shown.n_load_arrows_computed(stage.state.method);
    };
    const int before = computed();
    EXPECT_GT(before, 0);
    stage.frame();
    stage.state.camera.orbit(10.0, 5.0, {0, 0, 640, 480});
    stage.frame();
    EXPECT_EQ(computed(), before) << "looked at from elsewhere";
    stage.scene().set_load(load, ForceLoad{{0.0, 0.0, 0.02}});
    EXPECT_EQ(computed(), before + 1) << "another load, the positions not yet";
    stage.settle();
    const int pressed = computed();
    EXPECT_GT(pressed, before + 1) << "the body has followed";
    const Eigen::Vector3d place = arrow_of(stage, load).place;
    stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0.0, 0.0}});
    stage.settle();
    EXPECT_GT(computed(), pressed) << "pulled";
    EXPECT_GT((arrow_of(stage, load).place - place).norm(), 0.01);
}

TEST(ForceTool, AfterAClickThatLoadsNothingDeleteRemovesTheHandle) {
    Stage stage(3);
    stage.drag(stage.pixel(stage.vertex_near({1, 0, 1})), stage.empty_place());
    stage.settle();
    ASSERT_EQ(stage.scene().n_handles(), 1);
    stage.state.tools.tool = Tool::force;
    stage.state.tools.patch_radius = 0.5;
    stage.frame();
    stage.click(stage.pixel(stage.vertex_near({1, 0, 0})));
    ASSERT_EQ(stage.scene().n_loads(), 0);
    remove_selection(stage.state);
    EXPECT_EQ(stage.scene().n_handles(), 0);
}

}  // namespace
}  // namespace elastolab::test
