// What a scene keeps between sessions and between steps of undo: the camera, the field, the method.
#include <gmock/gmock.h>

#include "app/picture/view_point.hpp"
#include "app/selection.hpp"
#include "app/stage.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "scene/file/scene_file.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::Stage;
using test::TemporaryFolder;

constexpr double kPoseRounding = 1e-12;

TEST(KeptCamera, ComesBackWithItsSceneAndIsNoChangeOfIt) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "scene.json";
    Stage stage(2);
    stage.state.camera.set_up_axis(Eigen::Vector3d::UnitY());
    stage.state.camera.orbit(123.0, -45.0, stage.state.shown.viewports[0].place);
    stage.state.camera.zoom_to({500.0, 300.0}, 1.7, {0.5, 0.5, 0.5}, stage.state.shown.viewports[0].place);
    EXPECT_FALSE(stage.scene().modified());
    ASSERT_TRUE(stage.state.files.save(file));
    const CameraPose saved = stage.state.camera.pose();

    Stage other(3);
    other.state.files.open_now(file);
    other.state.frame_in_viewports(true);
    const CameraPose& pose = other.state.camera.pose();
    EXPECT_LT((pose.target - saved.target).norm(), kPoseRounding);
    EXPECT_LT(pose.orientation.angularDistance(saved.orientation), 1e-7);  // of a cosine near 1
    EXPECT_NEAR(pose.distance, saved.distance, kPoseRounding);
    EXPECT_EQ(other.state.camera.up_axis(), Eigen::Vector3d::UnitY());
    EXPECT_FALSE(other.scene().modified());
}

TEST(KeptCamera, OfNoUseIsLeftAside) {
    const TemporaryFolder folder;
    Document document = test::cube_document(2);
    document.camera = ViewPoint{.eye = {1e9, 0, 0}, .target = {0, 0, 0}};
    save_scene(folder.path() / "far.json", document);
    Stage stage(2);
    const CameraPose framed = stage.state.camera.pose();
    stage.state.files.open_now(folder.path() / "far.json");
    stage.state.frame_in_viewports(true);
    EXPECT_NEAR(stage.state.camera.pose().distance, framed.distance, 1e-9);
}

TEST(KeptField, ComesBackWithItsRangeAndTheCut) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "seen.json", plain = folder.path() / "plain.json";
    Stage stage(3);
    ASSERT_TRUE(stage.state.files.save(plain));
    stage.state.display.field = Field::stress_xz;
    stage.state.display.typed_ranges[Field::stress_xz] = {-2.0, 3.0};
    stage.state.display.section = true;
    stage.state.display.cut = {.axis = 1, .turn = 20.0, .tilt = -5.0, .place = 0.25, .flip = true};
    ASSERT_TRUE(stage.state.files.save(file));

    Stage other(3);
    other.state.display.typed_ranges[Field::displacement] = {0.0, 1.0};
    other.state.files.open(file);
    other.settle();
    const DisplaySettings& display = other.state.display;
    EXPECT_EQ(display.field, Field::stress_xz);
    EXPECT_EQ(display.typed_ranges.at(Field::stress_xz), std::pair(-2.0, 3.0));
    EXPECT_TRUE(display.typed_ranges.contains(Field::displacement)) << "those of other fields stay";
    EXPECT_TRUE(display.section);
    EXPECT_EQ(display.cut, stage.state.display.cut);
    EXPECT_FALSE(other.scene().modified());
    other.state.files.open(plain);
    other.settle();
    EXPECT_EQ(display.field, Field::none);
    EXPECT_FALSE(display.section);
}

TEST(KeptField, GivesWayToWhatIsAskedForAndStaysWhereASceneHasNone) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "seen.json", without = folder.path() / "without.json";
    Document document = test::cube_document(2);
    save_scene(without, document);
    document.shown = Shown{.field = Field::traction, .range = {{0.0, 1.0}}, .cut = Cut{.axis = 2, .place = 0.1}};
    save_scene(file, document);
    Stage stage(2);
    stage.state.files.open(file);
    stage.state.start_with({.field = Field::von_mises, .cut_axis = 0});
    stage.settle();
    EXPECT_EQ(stage.state.display.field, Field::von_mises);
    EXPECT_TRUE(stage.state.display.section);
    EXPECT_EQ(stage.state.display.cut, Cut{});
    stage.state.files.open(without);
    stage.settle();
    EXPECT_EQ(stage.state.display.field, Field::von_mises);
    stage.state.files.open(file);
    stage.settle();
    EXPECT_EQ(stage.state.display.field, Field::traction) << "asked for once";
    EXPECT_EQ(stage.state.display.cut.axis, 2);
}

TEST(KeptMethod, IsAStepOfUndo) {
    Stage stage(2);
    stage.state.method = kFem;
    stage.settle();
    stage.state.select_method(kConstantBem);
    stage.settle();
    stage.state.choices.tractions = Tractions::continuous;
    stage.settle();
    EXPECT_FALSE(stage.scene().modified()) << "nobody is to be asked about another look";
    stage.state.undo();
    EXPECT_EQ(stage.state.choices.tractions, Tractions::discontinuous);
    EXPECT_EQ(stage.state.method, kConstantBem);
    stage.state.undo();
    EXPECT_EQ(stage.state.method, kFem);
    stage.state.redo();
    stage.state.redo();
    EXPECT_EQ(stage.state.choices.tractions, Tractions::continuous);
    EXPECT_EQ(stage.state.method, kConstantBem);
    EXPECT_FALSE(stage.scene().can_redo());
}

TEST(KeptMethod, TakesNoRedoAway) {
    Stage stage(2);
    stage.drag(stage.pixel(stage.vertex_near({1, 0, 1})), stage.empty_place());
    stage.settle();
    ASSERT_EQ(stage.scene().n_handles(), 1);
    stage.state.undo();
    const MethodKind other = stage.state.method == kFem ? kConstantBem : kFem;
    stage.state.select_method(other);
    stage.settle();
    ASSERT_TRUE(stage.scene().can_redo());
    stage.state.redo();
    EXPECT_EQ(stage.scene().n_handles(), 1);
    EXPECT_EQ(stage.state.method, other) << "what is looked at stays";
    stage.state.undo();
    EXPECT_EQ(stage.state.method, other);
}

TEST(KeptMethod, AndAnEditInItAreTakenBackOneByOne) {
    Stage stage(2);
    const MethodKind first = stage.state.method;
    stage.state.select_method(first == kFem ? kLinearBem : kFem);
    stage.drag(stage.pixel(stage.vertex_near({1, 0, 1})), stage.empty_place());
    stage.settle();
    ASSERT_EQ(stage.scene().n_handles(), 1);
    stage.state.undo();
    EXPECT_EQ(stage.scene().n_handles(), 0);
    stage.state.undo();
    EXPECT_EQ(stage.state.method, first);
}

TEST(KeptSelection, OfAHandleComesThroughUndoAndRedo) {
    Stage stage(2);
    for (const Eigen::Vector3d& at : {Eigen::Vector3d(1, 0, 1), Eigen::Vector3d(1, 1, 1)}) {
        stage.scene().add_handle(std::vector<int>{stage.vertex_near(at)});
        stage.scene().commit();
    }
    stage.scene().set_motion(1, AffineMotion{.translate = {0.1, 0, 0}});
    stage.scene().commit();
    stage.state.gestures.select_handle(1);
    stage.state.undo();
    EXPECT_EQ(stage.state.gestures.selected_handle(), 1);
    stage.state.redo();
    EXPECT_EQ(stage.state.gestures.selected_handle(), 1);
    stage.state.undo();
    stage.state.undo();
    EXPECT_EQ(stage.state.gestures.selected_handle(), -1) << "it is not there any more";
    stage.state.redo();
    EXPECT_EQ(stage.state.gestures.selected_handle(), 1) << "as when it was made";
    stage.state.remove_handle(0);
    EXPECT_EQ(stage.state.gestures.selected_handle(), -1);
    stage.state.undo();
    EXPECT_EQ(selected_name(stage.state), stage.scene().handle_name(0)) << "it is there again";
    stage.state.clear_handles();
    stage.state.undo();
    EXPECT_EQ(stage.state.gestures.selected_handle(), -1) << "which of the two is not known";
}

TEST(KeptSelection, OfALoadComesThroughUndoAndRedo) {
    Stage stage(2);
    for (const double x : {0.0, 1.0}) {
        std::vector<int> side;
        for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v)
            if (stage.scene().mesh().vertices(1, v) == x) side.push_back(v);
        stage.scene().add_load(side, ForceLoad{{0, 0, 0.01}});
        stage.scene().commit();
    }
    stage.scene().set_gravity(Eigen::Vector3d(0, 0, -1), 1e-3);
    stage.scene().commit();
    stage.scene().set_load(1, ForceLoad{{0, 0, 0.02}});
    stage.scene().commit();
    stage.state.gestures.select_load(1);
    stage.state.undo();
    EXPECT_EQ(stage.state.gestures.selected_load(), 1);
    stage.state.redo();
    EXPECT_EQ(stage.state.gestures.selected_load(), 1);
    stage.state.gestures.select_load(LiveScene::kGravity);
    stage.state.undo();
    EXPECT_EQ(stage.state.gestures.selected_load(), LiveScene::kGravity);
    stage.state.undo();
    EXPECT_FALSE(stage.state.gestures.selected_load()) << "it is not there any more";
    stage.state.redo();
    EXPECT_EQ(stage.state.gestures.selected_load(), LiveScene::kGravity) << "as when it was made";
    stage.state.gestures.select_load(0);
    stage.state.remove_load(0);
    stage.state.undo();
    EXPECT_EQ(stage.state.gestures.selected_load(), 0) << "it is there again";
}

TEST(KeptMethod, ABodyJustOpenedIsNotChangedWhateverMethodItBeginsWith) {
    const TemporaryFolder folder;
    save_surface(folder.path() / "box.obj", make_box(3));
    Stage stage(2);
    for (const MethodKind kind : all_methods()) {
        stage.state.files.open_now(folder.path() / "box.obj");
        stage.state.start_with({.method = kind});
        stage.frame();
        EXPECT_FALSE(stage.scene().modified()) << name(kind);
        EXPECT_FALSE(stage.scene().can_undo()) << name(kind);
    }
}

}  // namespace
}  // namespace elastolab
