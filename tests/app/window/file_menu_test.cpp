// The File menu, driven by mouse and keys.
#include <gmock/gmock.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/examples.hpp"
#include "app/real_window.hpp"
#include "app/stage.hpp"
#include "app/window/recent_files.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

using testing::IsEmpty;

constexpr double kExamples = 83.0, kPicture = 194.0;  ///< heights of menu entries

class FileMenu : public testing::Test {
protected:
    FileMenu() {
        save_scene(folder.path() / "cube.json", cube_document(2));
        window.emplace(
            std::vector<std::string>{"cube.json", "--size", "800x600", "--method", "fem", "--scene-out", "out.json"},
            folder.path());
        window->settle();
    }
    /// Opens the menu and chooses what is at this height.
    void choose(double y) {
        window->click({20, 10});
        window->settle();
        window->click({60, y});
        window->settle();
    }
    void end() {
        const ProgramRun run = window->quit();
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_THAT(run.err, IsEmpty());
    }
    const TemporaryFolder folder;
    std::optional<RealWindow> window;
};

TEST_F(FileMenu, OpensAnExampleByItsPicture) {
    choose(kExamples);
    window->click({350, 130});  // the first
    window->settle();
    end();
    const std::vector<Example> all = examples();
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.front().name, "beam twist");
    EXPECT_EQ(load_scene(folder.path() / "out.json"), load_scene(all.front().scene));
    for (const Example& example : all) EXPECT_FALSE(example.picture.empty()) << example.name;
}

/// The pictures come up beside the cursor, not under it, where a click after they have come up would choose one.
TEST_F(FileMenu, AClickOnTheEntryOfTheExamplesChoosesNone) {
    choose(kExamples);
    window->click({60, kExamples});
    window->settle();
    window->key("Escape");
    window->key("Escape");
    window->settle();
    end();
    EXPECT_TRUE(load_scene(folder.path() / "out.json").mesh == cube_document(2).mesh);
}

TEST_F(FileMenu, WritesAPictureOfTheSceneAlone) {
    choose(kPicture);
    window->key("Return");
    window->settle();
    const auto file = folder.path() / "scene.png";
    window->type(file.string());
    window->settle();
    const std::string bytes = read_text(file);
    ASSERT_GT(bytes.size(), 1000u);
    // The head of a PNG: width and height follow its signature and "IHDR", the highest byte first.
    const auto number = [&](std::size_t at) {
        return static_cast<unsigned char>(bytes[at + 2]) * 256 + static_cast<unsigned char>(bytes[at + 3]);
    };
    EXPECT_EQ(number(16), 1920);
    EXPECT_EQ(number(20), 1080);
    end();
}

TEST_F(FileMenu, AFolderOnceUsedIsWhereTheNextDialogBegins) {
    std::filesystem::create_directory(folder.path() / "deep");
    window->key("ctrl+s");
    window->settle();
    window->type((folder.path() / "deep" / "saved.json").string());
    window->settle();
    EXPECT_EQ(load_last_folder("open"), folder.path() / "deep");
    end();
}

}  // namespace
}  // namespace elastolab::test
