// Unsaved changes in a real window: whatever takes the scene away asks first, and mouse and keys answer.
#include <gmock/gmock.h>

#include "app/real_window.hpp"
#include "app/stage.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

using testing::IsEmpty;

/// The scene cube.json (98 vertices), changed by a drag, and other.json (26 vertices).
class UnsavedWindow : public testing::Test {
protected:
    UnsavedWindow() {
        save_scene(folder.path() / "cube.json", cube_document(4));
        save_scene(folder.path() / "other.json", cube_document(2));
        window.emplace(std::vector<std::string>{"cube.json", "--size", "640x480", "--timings", "t.csv"}, folder.path());
        window->settle();
        window->drag({430, 240}, {465, 210});  // the middle of the body
        window->settle();
    }
    void answer(const std::vector<std::string>& keys) {
        window->settle();
        EXPECT_FALSE(window->ended()) << "nobody was asked";
        for (const std::string& key : keys) {
            window->key(key);
            window->settle();
        }
    }
    void expect_good_end(const ProgramRun& run) {
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_THAT(run.err, IsEmpty());
    }
    /// Answers by the last of these keys, which ends the program.
    void answer_and_end(std::vector<std::string> keys) {
        const std::string last = keys.back();
        keys.pop_back();
        answer(keys);
        window->key(last);
        expect_good_end(window->wait());
    }
    std::size_t n_saved_handles() { return load_scene(folder.path() / "cube.json").handles.size(); }
    /// Of the body in the last frame.
    std::string n_vertices() {
        const std::string text = read_text(folder.path() / "t.csv");
        std::istringstream row(text.substr(text.rfind('\n', text.size() - 2) + 1));
        std::string field;
        for (int i = 0; i < 4; ++i) std::getline(row, field, ',');
        return field;
    }
    const TemporaryFolder folder;
    std::optional<RealWindow> window;
};

TEST_F(UnsavedWindow, ClosingAsksEscapeStaysAndEnterSaves) {
    window->close();
    answer({"Escape"});
    window->settle();
    EXPECT_FALSE(window->ended());
    window->close();
    answer_and_end({"Return", "Return", "Return"});  // save, by the name that is proposed, over what was only read
    EXPECT_EQ(n_saved_handles(), 1u);
}

TEST_F(UnsavedWindow, QuittingDiscardsWhenTold) {
    window->key("ctrl+q");
    answer_and_end({"Right", "space"});
    EXPECT_EQ(n_saved_handles(), 0u);
    EXPECT_EQ(n_vertices(), "98");
}

TEST_F(UnsavedWindow, ADroppedFileAsks) {
    window->drop(folder.path() / "other.json");
    answer({"Tab", "Tab", "Return"});  // cancel
    window->drop(folder.path() / "other.json");
    answer({"Tab", "Return"});  // discard
    expect_good_end(window->quit());
    EXPECT_EQ(n_saved_handles(), 0u);
    EXPECT_EQ(n_vertices(), "26");
}

TEST_F(UnsavedWindow, AFileFromTheDialogAsks) {
    window->key("ctrl+o");
    window->settle();
    window->type((folder.path() / "other.json").string());
    answer({"Return", "Return", "Return"});  // save, by the name that is proposed, over what was only read
    expect_good_end(window->quit());
    EXPECT_EQ(n_saved_handles(), 1u);
    EXPECT_EQ(n_vertices(), "26");
}

TEST_F(UnsavedWindow, WhereThereIsNoFileSavingAsksForAName) {
    window.reset();
    save_surface(folder.path() / "box.obj", make_box(4));
    window.emplace(std::vector<std::string>{"box.obj", "--method", "fem", "--size", "640x480"}, folder.path());
    window->settle();
    window->key("Escape");  // what the first viewer may have left is recovered later
    window->settle();
    window->drag({430, 240}, {465, 210});
    window->settle();
    window->close();
    answer({"Return", "Escape"});  // a name is asked for, and not given
    EXPECT_FALSE(window->ended());
    window->close();
    answer({"Return"});
    const std::string file = (folder.path() / "named.json").string();
    window->type(file);
    expect_good_end(window->wait());
    EXPECT_EQ(load_scene(file).handles.size(), 1u);
}

}  // namespace
}  // namespace elastolab::test
