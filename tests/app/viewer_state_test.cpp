#include "app/viewer_state.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "app/stage.hpp"
#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

using test::Stage;
using test::TemporaryFolder;
using test::wait_for;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

int n_errors(const ViewerState& state) {
    const auto& all = state.messages.all();
    return static_cast<int>(std::count_if(all.begin(), all.end(), [](const auto& m) { return m.is_error; }));
}

TEST(ViewerState, BeginsWithTheCubeOfThePaperHeldAtItsLeft) {
    ViewerState state([] {});
    EXPECT_EQ(state.scene().mesh().n_vertices(), 1016);
    for (const int v : state.scene().vertices(LiveScene::kFixed)) EXPECT_EQ(state.scene().mesh().vertices(0, v), 0.0);
    EXPECT_EQ(state.method, first_method());
}

TEST(ViewerState, ABadFileIsTellingAndKeepsTheOldScene) {
    const TemporaryFolder folder;
    for (const auto& file :
         {folder.write("bad.obj", "f 1 2 3\n"), folder.write("bad.json", "{}"),
          folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv nan 0 0\nf 1 2 3\n"), folder.path() / "none.stl"}) {
        Stage stage(2);
        const LiveScene* before = &stage.scene();
        stage.state.open(file);
        EXPECT_TRUE(stage.state.loading());
        stage.settle();
        EXPECT_EQ(&stage.scene(), before);
        EXPECT_EQ(n_errors(stage.state), 1);
        EXPECT_THAT(stage.state.messages.all()[0].text,
                    AllOf(HasSubstr(file.filename().string()), Not(HasSubstr("\n"))));
        EXPECT_THROW(stage.state.open_now(file), Error);
        EXPECT_THAT(stage.state.recent_files(), IsEmpty());
    }
}

TEST(ViewerState, ShowsNothingThatCouldBePulledWhileItsFirstFileIsOpened) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "box.obj";
    save_surface(file, make_box(3));
    ViewerState state([] {});
    const Viewport scene{0, 0, 800, 600};
    state.open(file);
    state.update_displacements();
    EXPECT_TRUE(state.blank());
    EXPECT_THAT(viewports_of(state, scene, 1.0), IsEmpty());
    EXPECT_THAT(state.gesture_context().targets, IsEmpty());
    wait_for([&] {
        state.update_displacements();
        return !state.loading();
    });
    EXPECT_FALSE(state.blank());
    EXPECT_EQ(state.scene().mesh().n_vertices(), 56);
    EXPECT_THAT(viewports_of(state, scene, 1.0), SizeIs(1));
    state.open(file);
    state.update_displacements();
    EXPECT_FALSE(state.blank()) << "the body before stays until the next is there";
}

TEST(ViewerState, ShowsItsCubeWhereTheFirstFileCannotBeOpened) {
    ViewerState state([] {});
    state.open("/there/is/no/such.obj");
    wait_for([&] {
        state.update_displacements();
        return !state.loading();
    });
    EXPECT_FALSE(state.blank());
    EXPECT_EQ(n_errors(state), 1);
    EXPECT_THAT(viewports_of(state, {0, 0, 800, 600}, 1.0), SizeIs(1));
}

TEST(ViewerState, ALargeMeshBeginsWithAMethodThatIsExactSoonAndSaysSo) {
    const TemporaryFolder folder;
    Control control;
    save_surface(folder.path() / "small.ply", make_box(5));
    const LoadedScene small = load_scene_or_mesh(folder.path() / "small.ply", control);
    EXPECT_EQ(small.scene->document().method, first_method());
    EXPECT_THAT(small.note, IsEmpty());
    save_surface(folder.path() / "large.ply", make_box(90));
    const LoadedScene large = load_scene_or_mesh(folder.path() / "large.ply", control);
    EXPECT_NE(large.scene->document().method, first_method());
    EXPECT_THAT(large.note, AllOf(HasSubstr("exact in about"), HasSubstr("Galerkin BEM would take")));
    EXPECT_FALSE(large.scene->modified());
}

TEST(ViewerState, ABareMeshIsHeldAtItsLowestPart) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "box.obj";
    save_surface(file, make_box(3));
    Stage stage(2);
    stage.state.open(file);
    stage.settle();
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 56);
    const std::span<const int> fixed = stage.scene().vertices(LiveScene::kFixed);
    EXPECT_THAT(fixed, SizeIs(16));
    for (const int v : fixed) EXPECT_EQ(stage.scene().mesh().vertices(1, v), 0.0);  // meshes from files have Y up
    EXPECT_THAT(stage.state.recent_files(), SizeIs(1));
    EXPECT_FALSE(stage.scene().modified()) << "nobody has changed anything yet";
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

TEST(ViewerState, TheMethodOfTheCommandLineOutlivesTheLoadingOfTheScene) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", test::cube_document(2));
    Stage stage(2);
    stage.state.open(folder.path() / "cube.json");
    stage.state.start_with(kFem);
    stage.settle();
    EXPECT_EQ(stage.state.method, kFem);
    stage.state.open(folder.path() / "cube.json");
    stage.settle();
    EXPECT_EQ(stage.state.method, kLinearBem);  // the scene's own, from then on
}

TEST(ViewerState, TheMethodOfTheCommandLineEndsWithAFileThatCannotBeLoaded) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", test::cube_document(2));
    Stage stage(2);
    stage.state.open(folder.write("bad.obj", "f 1 2 3\n"));
    stage.state.start_with(kFem);
    stage.settle();
    stage.state.open(folder.path() / "cube.json");
    stage.settle();
    EXPECT_EQ(stage.state.method, kLinearBem);
}

TEST(ViewerState, ASavedSceneComesBackWithTheMethodAndTheHandles) {
    const TemporaryFolder folder;
    Stage stage(3);
    stage.scene().add_handle(std::vector<int>{5, 7});
    stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0.2, 1.0 / 3.0}});
    stage.state.method = kConstantBem;
    EXPECT_TRUE(stage.scene().modified());
    stage.state.save_scene(folder.path() / "saved.json");
    EXPECT_EQ(n_errors(stage.state), 0);
    EXPECT_FALSE(stage.scene().modified());
    const Document saved = load_scene(folder.path() / "saved.json");
    EXPECT_EQ(saved.method, kConstantBem);
    EXPECT_EQ(saved.handles, stage.scene().document().handles);
}

TEST(ViewerState, ASceneSavedElsewhereStillFindsItsMesh) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "a");
    std::filesystem::create_directories(folder.path() / "b" / "c");
    save_surface(folder.path() / "a" / "box.obj", make_box(2));
    Stage stage(2);
    stage.state.open_now(folder.path() / "a" / "box.obj");
    stage.state.save_scene(folder.path() / "b" / "c" / "scene.json");
    stage.state.save_scene(folder.path() / "scene.json");
    for (const char* scene : {"b/c/scene.json", "scene.json"}) {
        Stage other(2);
        other.state.open_now(folder.path() / scene);
        EXPECT_EQ(other.scene().mesh().n_vertices(), 26);
        EXPECT_THAT(test::read_text(folder.path() / scene), Not(HasSubstr(folder.path().string())));
    }
}

TEST(ViewerState, ExportsTheDeformedMesh) {
    const TemporaryFolder folder;
    Stage stage(2);
    const int v = stage.vertex_near({1, 1, 1});
    stage.scene().add_handle(std::vector<int>{v});
    stage.scene().set_motion(0, AffineMotion{.translate = {0.5, 0, 0}});
    stage.settle();
    stage.state.export_mesh(folder.path() / "out.obj");
    const LiveScene read(document_for_mesh(folder.path() / "out.obj"), folder.path() / "scene.json");
    EXPECT_NEAR(read.mesh().vertices.row(0).maxCoeff(), 1.5, 1e-9);
}

TEST(ViewerState, ExportsFieldsOfTheAnswerOnAWorker) {
    const TemporaryFolder folder;
    Stage stage(2);
    stage.state.method = kFem;
    const int v = stage.vertex_near({1, 1, 1});
    stage.scene().add_handle(std::vector<int>{v});
    stage.scene().set_motion(0, AffineMotion{.translate = {0.5, 0, 0}});
    stage.settle();
    for (const char* name : {"out.ply", "out.vtp", "out.vtu", "out.csv"}) {
        stage.state.export_mesh(folder.path() / name);
        EXPECT_TRUE(stage.state.waiting());
        stage.settle();
        EXPECT_GT(std::filesystem::file_size(folder.path() / name), 500u) << name;
    }
    EXPECT_EQ(n_errors(stage.state), 0);
    std::ifstream table(folder.path() / "out.csv");
    std::string row;
    for (int i = -2; i < v; ++i) std::getline(table, row);
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream numbers(row);
    std::vector<double> values{std::istream_iterator<double>(numbers), {}};
    ASSERT_EQ(values.size(), 17u);
    EXPECT_EQ(values[0], v);
    EXPECT_NEAR(values[4], 0.5, 1e-12);
    EXPECT_GT(values[7], 0.0) << "von Mises";

    stage.state.export_mesh(folder.path() / "first.vtp");
    EXPECT_EQ(stage.state.exported_file(), folder.path() / "first.vtp");
    stage.state.export_mesh(folder.path() / "second.vtp");
    EXPECT_EQ(n_errors(stage.state), 1) << "the first is still being written";
    EXPECT_THAT(stage.state.messages.all().back().text, HasSubstr("first.vtp is still being written"));
    stage.settle();
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "first.vtp"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "second.vtp"));

    stage.state.method = kLinearBem;
    stage.settle();
    stage.state.export_mesh(folder.path() / "none.vtu");
    stage.settle();
    EXPECT_EQ(n_errors(stage.state), 2);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "none.vtu"));
}

TEST(ViewerState, FailuresOfOutputsBecomeMessages) {
    Stage stage(2);
    stage.state.save_scene("/no/such/folder/scene.json");
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
    stage.state.open(folder.path() / "cube.json");
    stage.state.cancel_workers();
    stage.settle();
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 26);  // the old scene
    stage.open(test::cube_document(2));
    stage.state.choices.preview = false;  // else the method has not begun yet
    stage.state.open_document(test::cube_document(10), "scene.json");
    stage.frame();
    stage.state.cancel_workers();
    stage.settle();
    EXPECT_FALSE(stage.state.stopping());
    EXPECT_EQ(stage.state.frame_record({}, 0.0).state, "idle");
}

TEST(ViewerState, ARangeByHandIsKept) {
    Stage stage(2);
    EXPECT_EQ(stage.state.shown.field_range(stage.state.display), std::pair(0.0, 1.0));  // never empty
    stage.state.display.auto_range = false;
    stage.state.display.range_low = 2.0;
    stage.state.display.range_high = 3.0;
    EXPECT_EQ(stage.state.shown.field_range(stage.state.display), std::pair(2.0, 3.0));
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

}  // namespace
}  // namespace elastolab
