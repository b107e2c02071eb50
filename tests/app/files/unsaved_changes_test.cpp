// No change is lost without a question.
#include "app/files/unsaved_changes.hpp"

#include <gmock/gmock.h>

#include "app/stage.hpp"
#include "scene/file/scene_file.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::Stage;
using test::TemporaryFolder;

/// A cube of 26 vertices with a handle that nobody has saved, and ways to lose it.
class Unsaved : public testing::Test {
protected:
    Unsaved() {
        save_scene(folder.path() / "other.json", test::cube_document(3));
        stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 1, 1})});
        stage.scene().commit();
        stage.settle();
    }
    bool is_kept() { return stage.scene().mesh().n_vertices() == 26 && stage.scene().n_handles() == 1; }
    ViewerState& state() { return stage.state; }
    const TemporaryFolder folder;
    Stage stage{2};
};

TEST_F(Unsaved, NothingHappensBeforeTheAnswerAndNothingAfterACancel) {
    const std::vector<std::function<void()>> losses = {
        [&] { state().files.open(folder.path() / "other.json"); },
        [&] { state().open_primitive({.name = "sphere", .resolution = 2, .size = {}}); },
        [&] { state().quit(); },
    };
    for (const auto& lose : losses) {
        lose();
        EXPECT_TRUE(state().files.unsaved.asking());
        stage.settle();
        EXPECT_TRUE(is_kept());
        state().files.answer(UnsavedAnswer::cancel);
        stage.settle();
        EXPECT_FALSE(state().files.unsaved.asking());
        EXPECT_TRUE(is_kept());
        EXPECT_FALSE(state().requests.quit);
        EXPECT_TRUE(state().scene().modified());
    }
}

TEST_F(Unsaved, DiscardedChangesGo) {
    state().files.open(folder.path() / "other.json");
    state().files.answer(UnsavedAnswer::discard);
    stage.settle();
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 56);
    EXPECT_FALSE(state().files.unsaved.asking());
    state().open_primitive({.name = "cube", .resolution = 1, .size = {}});  // nothing to lose: no question
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 8);
    state().quit();
    EXPECT_TRUE(state().requests.quit);
}

TEST_F(Unsaved, SavingAsksForANameWhereThereIsNone) {
    state().quit();
    state().files.answer(UnsavedAnswer::save);
    EXPECT_TRUE(state().files.wants_name);
    EXPECT_TRUE(state().files.unsaved.asking());
    EXPECT_FALSE(state().requests.quit);
}

TEST_F(Unsaved, SavingWritesOverAFileOnceItWasSavedTo) {
    const auto file = folder.path() / "other.json";
    state().files.open_now(file);
    stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 1, 1})});
    state().quit();
    state().files.answer(UnsavedAnswer::save);
    EXPECT_TRUE(state().files.wants_name) << "it was only read: an example, say";
    EXPECT_FALSE(state().requests.quit);
    EXPECT_EQ(load_scene(file).handles.size(), 0u);
    state().files.answer(UnsavedAnswer::cancel);
    state().files.save(file);
    stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 1, 0})});
    state().quit();
    state().files.answer(UnsavedAnswer::save);
    EXPECT_TRUE(state().requests.quit);
    EXPECT_EQ(load_scene(file).handles.size(), 2u);
}

/// A film moves the handles: what is saved meanwhile would be one of its frames.
TEST_F(Unsaved, NothingIsSavedWhileAFilmMovesTheHandles) {
    state().posed_for_film = true;
    EXPECT_FALSE(state().files.save(folder.path() / "mine.json"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "mine.json"));
    EXPECT_EQ(test::n_errors(state()), 1);
    state().posed_for_film = false;
    EXPECT_TRUE(state().files.save(folder.path() / "mine.json"));
}

TEST_F(Unsaved, ASaveThatFailsLosesNothing) {
    std::filesystem::create_directories(folder.path() / "gone");
    save_scene(folder.path() / "gone" / "cube.json", test::cube_document(2));
    state().files.open_now(folder.path() / "gone" / "cube.json");
    state().files.save(folder.path() / "gone" / "cube.json");
    stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 1, 1})});
    std::filesystem::remove_all(folder.path() / "gone");
    state().quit();
    state().files.answer(UnsavedAnswer::save);
    EXPECT_FALSE(state().requests.quit);
    EXPECT_TRUE(state().files.unsaved.asking());
    EXPECT_TRUE(is_kept());
}

TEST_F(Unsaved, WhatIsChangedWhileAFileIsLoadedCounts) {
    state().files.save(folder.path() / "mine.json");
    state().files.open(folder.path() / "other.json");
    EXPECT_TRUE(state().files.loading());
    stage.scene().clear_handles();
    stage.settle();
    EXPECT_TRUE(state().files.unsaved.asking());
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 26);
    state().files.answer(UnsavedAnswer::discard);
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 56);
}

TEST_F(Unsaved, ABodyThatIsAskedForWhileAFileIsLoadedEndsThat) {
    state().files.save(folder.path() / "mine.json");
    state().files.open(folder.path() / "other.json");
    state().start_with({.field = Field::von_mises, .cut_axis = {}});
    state().open_primitive({.name = "cube", .resolution = 1, .size = {}});
    stage.settle();
    EXPECT_FALSE(state().files.loading());
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 8);
    EXPECT_FALSE(state().files.unsaved.asking());
}

TEST_F(Unsaved, ADragThatIsNotOverIsAChange) {
    state().files.save(folder.path() / "mine.json");
    stage.move(stage.pixel(stage.vertex_near({1, 1, 1})));
    stage.press();
    stage.move(stage.pixel(stage.vertex_near({1, 1, 1})) + Eigen::Vector2d(40, 0));
    state().quit();
    EXPECT_TRUE(state().files.unsaved.asking());
}

TEST_F(Unsaved, NobodyIsAskedWhereChangesAreKeptAnyway) {
    state().files.unsaved.never_ask();
    state().quit();
    EXPECT_TRUE(state().requests.quit);
}

}  // namespace
}  // namespace elastolab
