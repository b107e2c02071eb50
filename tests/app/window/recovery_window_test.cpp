// A viewer that is killed loses nothing.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <thread>

#include "app/real_window.hpp"
#include "app/stage.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

using testing::IsEmpty;

class RecoveryWindow : public testing::Test {
protected:
    RecoveryWindow() { save_scene(folder.path() / "cube.json", cube_document(4)); }

    /// A viewer in which a handle was pulled, as soon as that is kept.
    void start_and_pull() {
        window.emplace(std::vector<std::string>{"cube.json", "--size", "640x480"}, folder.path());
        window->settle();
        window->drag({430, 240}, {465, 210});
        window->settle();
        for (int i = 0; i < 1000 && kept().empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        ASSERT_FALSE(kept().empty());
    }
    void kill_it() {
        kill(window->process(), SIGKILL);
        window->wait();
        window.reset();
    }
    /// Starts the next viewer with this scene, answers its question with these keys, and ends it. What it had then.
    Document next_session(const std::vector<std::string>& keys, const std::vector<std::string>& scene = {"cube.json"}) {
        std::vector<std::string> arguments{"--size", "640x480", "--scene-out", "out.json"};
        arguments.insert(arguments.end(), scene.begin(), scene.end());
        RealWindow next(arguments, folder.path());
        next.settle();
        for (const std::string& key : keys) {
            next.key(key);
            next.settle();
        }
        const ProgramRun run = next.quit();
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_THAT(run.err, IsEmpty());
        return load_scene(folder.path() / "out.json");
    }
    static std::vector<std::filesystem::path> kept() {
        std::vector<std::filesystem::path> found;
        std::error_code none;
        const std::filesystem::path state = std::getenv("XDG_STATE_HOME");
        for (const auto& entry : std::filesystem::directory_iterator(state / "elastolab" / "autosave", none))
            if (entry.path().extension() == ".json") found.push_back(entry.path());
        return found;
    }
    const TemporaryFolder folder;
    std::optional<RealWindow> window;
};

TEST_F(RecoveryWindow, WhatAKilledOneHadIsOfferedAndRecovered) {
    start_and_pull();
    kill_it();
    const Document recovered = next_session({"Return"}, {"--method", "fem"});  // without a file
    ASSERT_EQ(recovered.handles.size(), 1u);
    EXPECT_GT(std::get<AffineMotion>(recovered.handles[0].motion).translate.norm(), 0.01);
    EXPECT_TRUE(kept().empty()) << "that session has ended as it should";
    EXPECT_EQ(next_session({}).handles.size(), 0u);
}

TEST_F(RecoveryWindow, LaterAsksAgainAndDiscardDoesNot) {
    start_and_pull();
    kill_it();
    EXPECT_EQ(next_session({"Escape"}).handles.size(), 0u);
    EXPECT_EQ(kept().size(), 1u);
    EXPECT_EQ(next_session({"Tab", "Return"}).handles.size(), 0u);
    EXPECT_TRUE(kept().empty());
}

TEST_F(RecoveryWindow, AViewerThatRunsKeepsItsOwn) {
    start_and_pull();
    EXPECT_EQ(next_session({}).handles.size(), 0u) << "nothing is asked";
    EXPECT_EQ(kept().size(), 1u);
    kill_it();
    EXPECT_EQ(next_session({"Return"}).handles.size(), 1u);
}

}  // namespace
}  // namespace elastolab::test
