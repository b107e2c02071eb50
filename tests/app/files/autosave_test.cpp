// What a viewer that is killed leaves behind, and who finds it.
#include "app/files/autosave.hpp"

#include <gmock/gmock.h>

#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <thread>

#include "app/stage.hpp"
#include "app/window/state_folder.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

using test::Stage;

/// A viewer that keeps a scene, without a window. Its end is that of a killed one, but for clear().
class Keeper {
public:
    void update(std::uint64_t revision, bool modified, double now, int cells = 2) {
        autosave.update({.revision = revision,
                         .modified = modified,
                         .origin = "/somewhere/cube.json",
                         .document = [=] { return test::cube_document(cells); }},
                        now);
    }
    Autosave autosave{[] {}};
};

std::vector<std::filesystem::path> files() {
    std::vector<std::filesystem::path> found;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(state_folder() / "autosave", none))
        found.push_back(entry.path());
    return found;
}

/// Until the worker has written.
void wait_for_file() {
    for (int i = 0; i < 2000; ++i) {
        for (const auto& file : files())
            if (file.extension() == ".json") return;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    FAIL() << "nothing is written";
}

/// As a viewer does that is killed.
void leave_a_copy() {
    Keeper keeper;
    keeper.update(1, true, 0.0);
    wait_for_file();
}

TEST(Autosave, OfAKilledViewerIsFoundWithItsFileAndOnlyOnce) {
    {
        Keeper keeper;
        keeper.update(1, true, 0.0);
        wait_for_file();
        EXPECT_THAT(find_autosaved(), IsEmpty()) << "that viewer still runs";
    }
    const std::vector<AutosavedScene> found = find_autosaved();
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].origin, "/somewhere/cube.json");
    EXPECT_EQ(load_scene(found[0].file), test::cube_document(2));
    EXPECT_THAT(find_autosaved(), IsEmpty()) << "another viewer has it";
}

TEST(Autosave, IsGoneAfterACleanEndAndOnceEverythingIsSaved) {
    Keeper keeper;
    keeper.update(1, true, 0.0);
    wait_for_file();
    keeper.update(2, false, 0.1);
    EXPECT_THAT(files(), IsEmpty());
    keeper.update(3, true, 10.0);
    wait_for_file();
    keeper.autosave.clear();
    EXPECT_THAT(files(), IsEmpty());
}

TEST(Autosave, WaitsBetweenWritesAndNotWhenThereIsNothingNew) {
    Keeper keeper;
    keeper.update(1, false, 0.0);
    EXPECT_LT(keeper.autosave.due_in(0.0), 0.0);
    keeper.update(2, true, 1.0);
    wait_for_file();
    EXPECT_LT(keeper.autosave.due_in(1.0), 0.0) << "it is written";
    keeper.update(3, true, 1.5, 3);
    EXPECT_NEAR(keeper.autosave.due_in(1.5), 1.5, 1e-9);
    EXPECT_EQ(load_scene(files().front().replace_extension(".json")), test::cube_document(2));
}

/// As on a full disk: while it lives, nothing can be written.
class FullDisk {
public:
    FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit nothing{0, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &nothing);
    }
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    void (*handler_)(int);
    rlimit before_{};
};

TEST(Autosave, SaysThatItFailedAndTriesAgainUnderTheSceneSName) {
    {
        Keeper keeper;
        {
            const FullDisk disk;
            keeper.update(1, true, 0.0);
            EXPECT_FALSE(keeper.autosave.failure().empty());
            EXPECT_NEAR(keeper.autosave.due_in(0.5), 1.5, 1e-9);
            keeper.update(1, true, 2.5);
            EXPECT_FALSE(keeper.autosave.failure().empty());
        }
        keeper.update(1, true, 5.0);
        wait_for_file();
        for (int i = 0; i < 2000 && !keeper.autosave.failure().empty(); ++i) {
            keeper.update(1, true, 5.1);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        EXPECT_THAT(keeper.autosave.failure(), IsEmpty());
    }
    const std::vector<AutosavedScene> found = find_autosaved();
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].origin, "/somewhere/cube.json");
}

TEST(Autosave, WhoseFileCannotBeWrittenKeepsTheOneBefore) {
    Keeper keeper;
    keeper.update(1, true, 0.0);
    wait_for_file();
    {
        const FullDisk disk;
        for (int i = 0; i < 2000 && keeper.autosave.failure().empty(); ++i) {
            keeper.update(2, true, 10.0, 3);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        EXPECT_FALSE(keeper.autosave.failure().empty());
        EXPECT_GT(keeper.autosave.due_in(10.0), 0.0) << "it is tried again";
    }
    EXPECT_EQ(load_scene(files().front().replace_extension(".json")), test::cube_document(2));
    keeper.update(3, false, 20.0);
    EXPECT_THAT(keeper.autosave.failure(), IsEmpty()) << "everything is saved";
}

TEST(Autosave, OfTwoViewersAreTwo) {
    {
        Keeper one, other;
        one.update(1, true, 0.0);
        other.update(1, true, 0.0, 3);
        for (int i = 0; i < 2000 && files().size() < 4; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        other.autosave.clear();
    }
    const std::vector<AutosavedScene> found = find_autosaved();
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(load_scene(found[0].file), test::cube_document(2));
}

TEST(Autosave, IsRecoveredUnsavedAndKeptFromThenOn) {
    ASSERT_NO_FATAL_FAILURE(leave_a_copy());
    Stage stage(3);
    stage.state.files.recoverable = find_autosaved();
    ASSERT_THAT(stage.state.files.recoverable, SizeIs(1));
    EXPECT_EQ(stage.state.files.recoverable[0].body, "cube") << "the question names it";
    stage.state.files.recover();
    stage.settle();
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 26);
    EXPECT_TRUE(stage.scene().modified());
    EXPECT_EQ(stage.state.files.file(), "/somewhere/cube.json");
    EXPECT_FALSE(stage.state.files.owns_file());
    EXPECT_THAT(files(), SizeIs(2)) << "it stays until the session ends";
    stage.state.files.keep_copy(0.0);
    stage.state.files.remove_copy();
    EXPECT_THAT(files(), IsEmpty());
}

/// Each in its turn, and none at the cost of another.
TEST(Autosave, OfSeveralViewersAreRecoveredWithoutLosingOne) {
    {
        Keeper one, other;
        one.update(1, true, 0.0);
        other.update(1, true, 0.0, 4);
        for (int i = 0; i < 2000 && files().size() < 4; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    Stage stage(3);
    SceneFiles& scenes = stage.state.files;
    scenes.recoverable = find_autosaved();
    ASSERT_THAT(scenes.recoverable, SizeIs(2));
    scenes.recover();
    stage.settle();
    scenes.keep_copy(0.0);
    ASSERT_THAT(files(), SizeIs(4));
    scenes.recover();
    stage.settle();
    ASSERT_TRUE(scenes.unsaved.asking()) << "the first one is not saved";
    scenes.answer(UnsavedAnswer::cancel);
    stage.settle();
    scenes.keep_copy(1.0);
    EXPECT_THAT(files(), SizeIs(4));
    EXPECT_THAT(find_autosaved(), SizeIs(1)) << "the second is offered again, the first is in use";
}

TEST(Autosave, ThatCannotBeReadStays) {
    ASSERT_NO_FATAL_FAILURE(leave_a_copy());
    Stage stage(3);
    stage.state.files.recoverable = find_autosaved();
    ASSERT_THAT(stage.state.files.recoverable, SizeIs(1));
    std::filesystem::resize_file(stage.state.files.recoverable[0].file, 10);
    stage.state.files.recover();
    stage.settle();
    EXPECT_EQ(stage.scene().mesh().n_vertices(), 56);
    EXPECT_THAT(stage.state.messages.all(), SizeIs(1));
    EXPECT_THAT(files(), SizeIs(2));
    EXPECT_THAT(find_autosaved(), SizeIs(1)) << "for another try";
}

}  // namespace
}  // namespace elastolab
