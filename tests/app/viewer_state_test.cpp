#include "app/viewer_state.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "app/stage.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

using test::n_errors;
using test::Stage;
using test::TemporaryFolder;
using test::wait_for;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(ViewerState, BeginsWithTheCubeOfThePaperHeldAtItsLeft) {
    ViewerState state([] {});
    EXPECT_EQ(state.scene().mesh().n_vertices(), 1016);
    for (const int v : state.scene().vertices(LiveScene::kFixed)) EXPECT_EQ(state.scene().mesh().vertices(0, v), 0.0);
    EXPECT_EQ(state.method, first_method());
}

TEST(ViewerState, ShowsNothingThatCouldBePulledWhileItsFirstFileIsOpened) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "box.obj";
    save_surface(file, make_box(3));
    ViewerState state([] {});
    const Viewport scene{0, 0, 800, 600};
    state.files.open(file);
    state.update_displacements();
    EXPECT_TRUE(state.blank());
    EXPECT_THAT(viewports_of(state, scene, 1.0), IsEmpty());
    EXPECT_THAT(state.gesture_context().targets, IsEmpty());
    wait_for([&] {
        state.update_displacements();
        return !state.files.loading();
    });
    EXPECT_FALSE(state.blank());
    EXPECT_EQ(state.scene().mesh().n_vertices(), 56);
    EXPECT_THAT(viewports_of(state, scene, 1.0), SizeIs(1));
    state.files.open(file);
    state.update_displacements();
    EXPECT_FALSE(state.blank()) << "the body before stays until the next is there";
}

/// Whether forces are shown or not.
TEST(ViewerState, AHandleThatIsMovedByAForceStaysWhereItWas) {
    Stage stage(3);
    ViewerState& state = stage.state;
    state.display.arrows = false;
    state.display.field = Field::none;
    stage.drag(stage.pixel(stage.vertex_near({1, 0, 1})), stage.empty_place());
    stage.settle();
    ASSERT_EQ(stage.scene().n_handles(), 1);
    const int vertex = stage.vertex_near({1, 0, 1});
    const Eigen::Vector3d before = stage.place(vertex);
    state.move_by_force(0);
    wait_for([&] {
        stage.frame();
        return stage.scene().document().handles[0].force.has_value();
    });
    stage.settle();
    EXPECT_GT(stage.scene().document().handles[0].force->force.norm(), 0.0);
    EXPECT_LT((stage.place(vertex) - before).norm(), 1e-3 * (before - Eigen::Vector3d(1, 0, 1)).norm());
    state.undo();
    EXPECT_FALSE(stage.scene().document().handles[0].force) << "one step";
    EXPECT_EQ(stage.scene().n_handles(), 1);
}

TEST(ViewerState, ShowsItsCubeWhereTheFirstFileCannotBeOpened) {
    ViewerState state([] {});
    state.files.open("/there/is/no/such.obj");
    wait_for([&] {
        state.update_displacements();
        return !state.files.loading();
    });
    EXPECT_FALSE(state.blank());
    EXPECT_EQ(n_errors(state), 1);
    EXPECT_THAT(viewports_of(state, {0, 0, 800, 600}, 1.0), SizeIs(1));
}

TEST(ViewerState, ABodyThatCannotBeMadeIsTellingAndKeepsTheOldScene) {
    Stage stage(2);
    const LiveScene* before = &stage.scene();
    stage.state.open_primitive({.name = "cube", .resolution = 0, .size = {}});
    EXPECT_EQ(&stage.scene(), before);
    EXPECT_EQ(n_errors(stage.state), 1);
}

TEST(ViewerState, ANewBodyHasThePresentMaterialAndIsHeld) {
    for (const std::string& name : primitive_names()) {
        Stage stage(2);
        stage.scene().set_material({.young_modulus = 5.0, .poisson_ratio = 0.2});
        stage.state.open_primitive({.name = name, .resolution = 3, .size = {}});
        EXPECT_EQ(n_errors(stage.state), 0) << name;
        EXPECT_EQ(stage.scene().document().material.poisson_ratio, 0.2);
        EXPECT_THAT(stage.scene().vertices(LiveScene::kFixed), Not(IsEmpty())) << name;
    }
}

TEST(ViewerState, YoungsModulusMustBeAPositiveNumber) {
    Stage stage(2);
    stage.state.set_young_modulus(4.0);
    for (const double value : {0.0, -1.0, std::numeric_limits<double>::infinity()})
        stage.state.set_young_modulus(value);
    EXPECT_EQ(stage.scene().document().material.young_modulus, 4.0);
    EXPECT_EQ(n_errors(stage.state), 1) << "the same text once";
    EXPECT_TRUE(stage.scene().can_undo());
}

TEST(ViewerState, FailuresOfOutputsBecomeMessages) {
    Stage stage(2);
    stage.state.files.save("/no/such/folder/scene.json");
    stage.state.export_mesh("/no/such/folder/out.obj");
    stage.state.record_timings("/no/such/folder/t.csv");
    EXPECT_EQ(n_errors(stage.state), 3);
    EXPECT_EQ(stage.state.measurements.timings, nullptr);
}

/// Before any method has answered.
TEST(ViewerState, ASceneIsFramedWithItsHandlesWhereTheyArePut) {
    Document document = test::cube_document(2);
    document.handles.push_back({.name = "end",
                                .select = {PlaneSelector{{1, 0, 0}, {1, 0, 0}, 1e-9}},
                                .motion = AffineMotion{.translate = {3, 0, 0}}});
    test::Stage stage(2);
    stage.open(document);
    const auto& viewports = stage.state.shown.viewports;
    const Viewport place = viewports.empty() ? Viewport{0.0, 0.0, 1300.0, 1000.0} : viewports.front().place;
    const Eigen::Vector2d pixel = stage.state.camera.project({4.0, 0.5, 0.5}, place).pixel;
    EXPECT_GT(pixel.x(), place.x);
    EXPECT_LT(pixel.x(), place.x + place.width);
    EXPECT_GT(pixel.y(), place.y);
    EXPECT_LT(pixel.y(), place.y + place.height);
}

TEST(ViewerState, AFrameRecordTellsMethodSizesAndState) {
    Stage stage(2);
    stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 1, 1})});
    stage.settle();
    const FrameRecord record = stage.state.frame_record({.update_ms = 1.0}, 2.0);
    EXPECT_EQ(record.method, "linear-bem");
    EXPECT_EQ(record.vertices, 26);
    EXPECT_EQ(record.constrained_vertices, 10);
    EXPECT_EQ(record.handle_vertices, 1);
    EXPECT_EQ(record.state, "ready");
    EXPECT_EQ(record.times.update_ms, 1.0);
    stage.state.method = kFem;
    stage.frame();
    EXPECT_EQ(stage.state.frame_record({}, 0.0).state, "precomputing");
}

TEST(ViewerState, SwitchingDuringAPrecomputationEndsAtTheLastChoice) {
    Stage stage(8);
    const int v = stage.vertex_near({1, 1, 1});
    stage.scene().add_handle(std::vector<int>{v});
    stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    for (const MethodKind kind : {kFem, kConstantBem, kFem, kLinearBem, kConstantBem}) {
        stage.state.select_method(kind);
        stage.frame();
    }
    stage.settle();
    EXPECT_EQ(stage.state.frame_record({}, 0.0).state, "ready");
    EXPECT_NEAR(stage.place(v).x(), 1.1, 1e-9);
}

TEST(ViewerState, CancelledWorkersStop) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", test::cube_document(12));
    Stage stage(2);
    stage.state.files.open(folder.path() / "cube.json");
    stage.state.cancel_workers();
    stage.settle();
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 26);  // the old scene
    stage.open(test::cube_document(2));
    stage.state.choices.preview = false;  // else the method has not begun yet
    stage.state.files.open_document(test::cube_document(10), "scene.json");
    stage.frame();
    stage.state.cancel_workers();
    stage.settle();
    EXPECT_FALSE(stage.state.stopping());
    EXPECT_EQ(stage.state.frame_record({}, 0.0).state, "idle");
}

TEST(ViewerState, ARangeByHandIsKept) {
    Stage stage(2);
    DisplaySettings& display = stage.state.display;
    display.field = Field::displacement;
    const auto range = [&] { return stage.state.shown.field_range(display); };
    EXPECT_EQ(range(), std::pair(0.0, 1.0));  // never empty
    display.typed_ranges[Field::displacement] = {2.0, 3.0};
    EXPECT_EQ(range(), std::pair(2.0, 3.0));
    display.typed_ranges[Field::displacement] = {3.0, 2.0};
    EXPECT_EQ(range(), std::pair(2.0, 3.0)) << "typed the other way round";
    display.field = Field::stress_xx;
    EXPECT_EQ(range(), std::pair(-1.0, 1.0)) << "lengths say nothing of stresses";
    display.field = Field::displacement;
    EXPECT_EQ(range(), std::pair(2.0, 3.0)) << "remembered";
}

/// A legend makes room for itself by moving the eye away; it is no part of what is saved.
TEST(ViewerState, AViewIsSavedAsItIsWithoutALegend) {
    Stage stage(2);
    Viewport& place = stage.state.shown.viewports.front().place;
    place = {0.0, 0.0, 500.0, 400.0};
    const auto eye = [&] { return stage.state.document_to_save().camera.value().eye; };
    const Eigen::Vector3d before = eye();
    place.covered = 200.0;
    CameraPose pose = stage.state.camera.pose();
    pose.distance /= place.free_aspect();
    stage.state.camera.set_pose(pose);
    EXPECT_LT((eye() - before).norm(), 1e-12 * before.norm());
}

/// A range that is held is one that was seen: a body at rest has none.
TEST(RangeOfColours, IsHeldFromTheBeginningOfAPull) {
    Stage stage;
    stage.open(test::cube_document_with_handle(3));
    DisplaySettings& display = stage.state.display;
    display.field = Field::displacement;
    display.hold_range = true;
    const auto pull = [&](double pixels, const char* direction) {
        const Eigen::Vector2d from = stage.pixel(stage.vertex_near({1, 0.33, 0.33}));
        stage.wait(1.0);
        stage.move(from);
        stage.press();
        stage.move(from + Eigen::Vector2d(pixels, 0.0));
        stage.settle();
        EXPECT_TRUE(stage.state.gestures.dragging()) << direction;
    };
    const auto range = [&] { return stage.state.shown.field_range(display).second; };
    const auto largest = [&] { return stage.state.shown.bodies().at(0).largest_magnitude(); };
    stage.settle();
    pull(40.0, "from rest");
    const double first = largest();
    EXPECT_GT(first, 0.0);
    EXPECT_EQ(range(), first);
    stage.release();
    stage.settle();
    pull(80.0, "further");
    EXPECT_GT(largest(), 1.1 * first);
    EXPECT_EQ(range(), first);
    stage.release();
    stage.settle();
    EXPECT_EQ(range(), largest());
}

/// The answer is still one to the handles before, for a frame or longer.
TEST(ViewerState, HandlesMayGoBeforeOneThatAForceMoves) {
    for (const MethodKind kind : all_methods()) {
        for (const bool all : {false, true}) {
            SCOPED_TRACE(std::string(name(kind)) + (all ? ", all" : ", the first"));
            Stage stage(8);
            stage.state.select_method(kind);
            stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 0, 0})});
            std::vector<int> pulled;
            for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v)
                if ((stage.scene().mesh().vertices.col(v) - Eigen::Vector3d::Ones()).norm() < 0.3) pulled.push_back(v);
            stage.scene().add_handle(pulled);
            stage.scene().set_force(1, GripForce{{0, 0, 0.01}, {0, 0, 0}});
            stage.scene().commit();
            stage.settle();
            const AffineMotion before = stage.motion(1);
            if (!all) {
                stage.state.remove_handle(0);
                stage.frame();
                ASSERT_EQ(stage.scene().n_handles(), 1);
                EXPECT_LT((stage.motion(0).translate - before.translate).norm(), 1e-9)
                    << "until the answer to it is there";
                stage.settle();
                EXPECT_TRUE(stage.scene().document().handles[0].force.has_value());
                EXPECT_GT(stage.motion(0).translate.norm(), 0.0);
                continue;
            }
            stage.state.clear_handles();
            stage.settle();
            EXPECT_EQ(stage.scene().n_handles(), 0);
        }
    }
}

/// An end turned by 120 degrees, and pushed on to 200: 160 the other way are nearer.
TEST(ViewerState, TellsWhetherTheEquilibriumFromRestIsAnother) {
    Stage stage;
    stage.open(test::cube_document_with_handle(2));
    stage.state.select_method(kNonlinearFem);
    const auto turned = [](double degrees) {
        return AffineMotion{.rotate = {.axis = {1, 0, 0}, .degrees = degrees, .center = {1, 0.5, 0.5}}};
    };
    stage.scene().set_motion(0, turned(120));
    stage.settle();
    const auto told = [&] {
        stage.state.begin_from_rest();
        stage.settle();
        return stage.state.messages.all().empty() ? std::string() : stage.state.messages.all().back().text;
    };
    EXPECT_THAT(told(), HasSubstr("the same shape"));
    VertexMotion pushed;
    const Eigen::Matrix3Xd u = displacements(Motion(turned(200)), stage.scene().rest_positions(0));
    for (Eigen::Index i = 0; i < u.cols(); ++i) pushed.displacements.emplace_back(u.col(i));
    stage.scene().set_motion(0, pushed);
    stage.settle();
    EXPECT_THAT(told(), HasSubstr("another shape"));
    EXPECT_THAT(told(), HasSubstr("the same shape"));
}

/// The forces that are known are those of the method before, which answered in this one's place.
TEST(ViewerState, AMethodWhoseSetWasCancelledShowsNoForcesOfTheOneBefore) {
    Stage stage;
    stage.state.choices.rims = 3;
    Document document = test::cube_document_with_handle(6);
    document.method = kFem;
    document.handles.at(0).motion = AffineMotion{.translate = {0.1, 0, 0}};
    stage.open(document);
    stage.state.display.arrows = true;
    stage.settle();
    ASSERT_THAT(stage.state.shown.body(kFem)->reactions(), Not(IsEmpty()));
    const MethodKind next = first_method();
    ASSERT_NE(next, kFem);
    stage.state.select_method(next);
    bool cancelled = false;
    wait_for([&] {
        stage.frame();
        cancelled = stage.state.simulation.runner(next).state() == MethodRunner::State::preparing;
        return cancelled || stage.state.simulation.runner(next).state() == MethodRunner::State::ready;
    });
    ASSERT_TRUE(cancelled);
    stage.state.simulation.runner(next).cancel();
    for (int i = 0; i < 20; ++i) stage.frame();
    EXPECT_FALSE(stage.state.simulation.answer(next).has_answer());
    EXPECT_THAT(stage.state.shown.body(next)->reactions(), IsEmpty());
}

TEST(ViewerState, AWishForAForceEndsWithItsScene) {
    Stage stage;
    stage.state.display.arrows = false;
    stage.state.display.field = Field::none;
    stage.open(test::cube_document_with_handle(3));
    stage.state.move_by_force(0);
    ASSERT_FALSE(stage.scene().document().handles.at(0).force) << "which is not known yet";
    Document other = test::cube_document_with_handle(4);
    other.handles.at(0).motion = AffineMotion{.translate = {0.1, 0, 0}};
    stage.open(other);
    stage.settle();
    EXPECT_FALSE(stage.scene().document().handles.at(0).force);
    EXPECT_FALSE(stage.scene().can_undo());
}

/// Taken while the answer is on its way, as large turns and far motions take long.
TEST(ViewerState, AForceOnAHandleIsThatOfWhereItIsNow) {
    for (const MethodKind kind : {kFem, kNonlinearFem}) {
        SCOPED_TRACE(name(kind));
        Stage stage;
        stage.state.display.arrows = true;
        Document document = test::cube_document_with_handle(5);
        document.method = kind;
        document.handles.at(0).motion = AffineMotion{.translate = {0.05, 0, 0}};
        stage.open(document);
        stage.settle();
        stage.scene().set_motion(0, AffineMotion{.translate = {0.5, 0, 0}});
        stage.scene().commit();
        stage.state.update_displacements();
        stage.state.move_by_force(0);
        wait_for([&] {
            stage.frame();
            return stage.scene().document().handles.at(0).force.has_value();
        });
        stage.settle();
        EXPECT_NEAR(stage.motion(0).translate.x(), 0.5, 0.01);
    }
}

TEST(ViewerState, LoadsThatBalanceNoLongerAreSaidAndTheAnswerBeforeStays) {
    Document document = test::cube_document(3);
    document.fixed.clear();
    document.method = kNonlinearFem;
    for (const double side : {0.0, 1.0})
        document.loads.push_back({.name = side > 0.0 ? "right" : "left",
                                  .select = {PlaneSelector{{side, 0, 0}, {1, 0, 0}, 1e-9}},
                                  .value = ForceLoad{{side > 0.0 ? 0.01 : -0.01, 0, 0}}});
    Stage stage;
    stage.open(document);
    stage.settle();
    const auto& answer = stage.state.simulation.answer(kNonlinearFem);
    const Eigen::VectorXd before = answer.displacement();
    ASSERT_GT(before.norm(), 0.0);
    stage.scene().set_load(0, ForceLoad{{-0.015, 0, 0}});
    for (int i = 0; i < 20; ++i) {
        EXPECT_NO_THROW(stage.frame());
        stage.settle();
    }
    EXPECT_THAT(stage.state.simulation.problem(kNonlinearFem), HasSubstr("balance"));
    EXPECT_EQ(answer.displacement(), before);
    stage.scene().set_load(0, ForceLoad{{-0.01, 0, 0}});
    stage.settle();
    EXPECT_EQ(stage.state.simulation.problem(kNonlinearFem), "");
}

TEST(ViewerState, WhatIsSaidOfOneBodyIsNotSaidOfTheNext) {
    Stage stage;
    Document large = test::cube_document_with_handle(8);
    large.method = first_method();
    large.handles.at(0).motion = AffineMotion{.translate = {0.2, 0.1, 0}};
    stage.open(large);
    stage.settle();
    ASSERT_TRUE(stage.state.simulation.preview_error(large.method));
    Document small = test::cube_document_with_handle(3);
    small.method = large.method;
    stage.open(small);
    stage.settle();
    EXPECT_FALSE(stage.state.simulation.preview_error(large.method)) << "there was no preview";

    Document refused = test::cube_document_with_handle(3);
    refused.method = kQuadraticFem;
    refused.material.poisson_ratio = 0.5;
    stage.open(refused);
    stage.frame();
    EXPECT_NE(stage.state.simulation.problem(kQuadraticFem), "");
    large.method = kQuadraticFem;
    stage.open(large);
    EXPECT_EQ(stage.state.simulation.problem(kQuadraticFem), "") << "while its preview is made";
}

}  // namespace
}  // namespace elastolab
