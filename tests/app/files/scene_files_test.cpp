#include "app/files/scene_files.hpp"

#include <gmock/gmock.h>

#include "app/stage.hpp"
#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::n_errors;
using test::Stage;
using test::TemporaryFolder;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(SceneFiles, ABadFileIsTellingAndKeepsTheOldScene) {
    const TemporaryFolder folder;
    for (const auto& file :
         {folder.write("bad.obj", "f 1 2 3\n"), folder.write("bad.json", "{}"),
          folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv nan 0 0\nf 1 2 3\n"), folder.path() / "none.stl"}) {
        Stage stage(2);
        const LiveScene* before = &stage.scene();
        stage.state.files.open(file);
        EXPECT_TRUE(stage.state.files.loading());
        stage.settle();
        EXPECT_EQ(&stage.scene(), before);
        EXPECT_EQ(n_errors(stage.state), 1);
        EXPECT_THAT(stage.state.messages.all()[0].text,
                    AllOf(HasSubstr(file.filename().string()), Not(HasSubstr("\n"))));
        EXPECT_THROW(stage.state.files.open_now(file), Error);
        EXPECT_THAT(stage.state.files.recent(), IsEmpty());
    }
}

/// A person is not asked to mend what a proxy stands for.
TEST(SceneFiles, TellsOfDefectsInOneMessageWhereAProxyIsSimulated) {
    const TemporaryFolder folder;
    SurfaceMesh open = make_box(5);
    open.triangles.conservativeResize(3, open.n_triangles() - 3);
    save_surface(folder.path() / "open.ply", open);
    Stage stage(2);
    stage.state.files.open_now(folder.path() / "open.ply");
    ASSERT_THAT(stage.state.messages.all(), SizeIs(1));
    const std::string text = stage.state.messages.all()[0].text;
    EXPECT_THAT(text, AllOf(HasSubstr("open.ply: "), HasSubstr("open edges"), HasSubstr("simulated in its place")));
    EXPECT_THAT(text, Not(AnyOf(HasSubstr("reload"), HasSubstr("/"))));
}

TEST(SceneFiles, ALargeMeshBeginsWithAMethodThatIsExactSoonAndSaysSo) {
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

TEST(SceneFiles, ABareMeshIsHeldAtItsLowestPart) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "box.obj";
    save_surface(file, make_box(3));
    Stage stage(2);
    stage.state.files.open(file);
    stage.settle();
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 56);
    const std::span<const int> fixed = stage.scene().vertices(LiveScene::kFixed);
    EXPECT_THAT(fixed, SizeIs(16));
    for (const int v : fixed) EXPECT_EQ(stage.scene().mesh().vertices(1, v), 0.0);  // meshes from files have Y up
    EXPECT_THAT(stage.state.files.recent(), SizeIs(1));
    EXPECT_FALSE(stage.scene().modified()) << "nobody has changed anything yet";
}

TEST(SceneFiles, TheMethodOfTheCommandLineOutlivesTheLoadingOfTheScene) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", test::cube_document(2));
    Stage stage(2);
    stage.state.files.open(folder.path() / "cube.json");
    stage.state.start_with({.method = kFem});
    stage.settle();
    EXPECT_EQ(stage.state.method, kFem);
    stage.state.files.open(folder.path() / "cube.json");
    stage.settle();
    EXPECT_EQ(stage.state.method, kLinearBem);  // the scene's own, from then on
}

TEST(SceneFiles, TheMethodOfTheCommandLineEndsWithAFileThatCannotBeLoaded) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", test::cube_document(2));
    Stage stage(2);
    stage.state.files.open(folder.write("bad.obj", "f 1 2 3\n"));
    stage.state.start_with({.method = kFem});
    stage.settle();
    stage.state.files.open(folder.path() / "cube.json");
    stage.settle();
    EXPECT_EQ(stage.state.method, kLinearBem);
}

TEST(SceneFiles, ASavedSceneComesBackWithTheMethodAndTheHandles) {
    const TemporaryFolder folder;
    Stage stage(3);
    stage.scene().add_handle(std::vector<int>{5, 7});
    stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0.2, 1.0 / 3.0}});
    stage.state.method = kConstantBem;
    EXPECT_TRUE(stage.scene().modified());
    stage.state.files.save(folder.path() / "saved.json");
    EXPECT_EQ(n_errors(stage.state), 0);
    EXPECT_FALSE(stage.scene().modified());
    const Document saved = load_scene(folder.path() / "saved.json");
    EXPECT_EQ(saved.method, kConstantBem);
    EXPECT_EQ(saved.handles, stage.scene().document().handles);
}

/// It holds the name of its mesh only: without that, or with another one under that name, it is worth nothing.
TEST(SceneFiles, ASceneIsNotSavedInSilenceWhoseMeshIsGone) {
    const TemporaryFolder folder;
    const auto mesh = folder.path() / "box.obj", saved = folder.path() / "saved.json";
    save_surface(mesh, make_box(3));
    Stage stage(2);
    stage.state.files.open_now(mesh);
    EXPECT_TRUE(stage.state.files.save(saved));
    const auto written = last_write_time(mesh);
    last_write_time(mesh, written + std::chrono::seconds(5));
    EXPECT_FALSE(stage.state.files.save(saved));
    EXPECT_THAT(stage.state.messages.all().back().text, AllOf(HasSubstr("box.obj"), HasSubstr("is another file")));
    remove(mesh);
    EXPECT_FALSE(stage.state.files.save(saved));
    EXPECT_THAT(stage.state.messages.all().back().text, AllOf(HasSubstr("box.obj"), HasSubstr("is no longer there")));
    save_surface(mesh, make_box(3));
    last_write_time(mesh, written);
    EXPECT_TRUE(stage.state.files.save(saved));
}

TEST(SceneFiles, ASceneSavedElsewhereStillFindsItsMesh) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "a");
    std::filesystem::create_directories(folder.path() / "b" / "c");
    save_surface(folder.path() / "a" / "box.obj", make_box(2));
    Stage stage(2);
    stage.state.files.open_now(folder.path() / "a" / "box.obj");
    stage.state.files.save(folder.path() / "b" / "c" / "scene.json");
    stage.state.files.save(folder.path() / "scene.json");
    stage.state.files.save(folder.path() / "b" / "c" / ".." / ".." / "b" / "up.json");
    for (const char* scene : {"b/c/scene.json", "scene.json", "b/up.json"}) {
        Stage other(2);
        other.state.files.open_now(folder.path() / scene);
        EXPECT_EQ(other.scene().mesh().n_vertices(), 26);
        EXPECT_THAT(test::read_text(folder.path() / scene), Not(HasSubstr(folder.path().string())));
    }
}

}  // namespace
}  // namespace elastolab
