#include "app/window/file_dialog.hpp"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "app/panels/bare_gui.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

TEST(FileDialog, ANameWithoutAKnownExtensionGetsTheSuggestedOne) {
    const FileDialog::Purpose scene{"", {".json"}, "cube.json", {}};
    EXPECT_EQ(with_extension("/a/beam", scene), "/a/beam.json");
    EXPECT_EQ(with_extension("beam.v2", scene), "beam.v2.json");
    EXPECT_EQ(with_extension("beam.JSON", scene), "beam.JSON");
    const FileDialog::Purpose mesh{"", {".obj", ".ply"}, "cube-deformed.obj", {}};
    EXPECT_EQ(with_extension("beam.ply", mesh), "beam.ply");
    EXPECT_EQ(with_extension("beam", mesh), "beam.obj");
}

/// The key that opened it, as in a menu, saves nothing.
TEST(FileDialog, AnEnterThatIsDownAlreadyIsNotMeantForIt) {
    const test::TemporaryFolder folder;
    BareGui gui;
    FileDialog dialog;
    std::filesystem::path saved;
    const auto draw = [&] {
        ImGui::Begin("background");
        dialog.draw(1.0f);
        ImGui::End();
    };
    gui.frame(draw);
    ImGui::GetIO().KeysDown[static_cast<int>(ImGuiKey_Enter)] = true;
    dialog.open({.title = "Save",
                 .extensions = {".png"},
                 .suggestion = "scene.png",
                 .done = [&](const auto& file) { saved = file; },
                 .folder = folder.path()});
    for (int i = 0; i < 3; ++i) gui.frame(draw);
    EXPECT_TRUE(dialog.is_open());
    EXPECT_TRUE(saved.empty());
    ImGui::GetIO().KeysDown[static_cast<int>(ImGuiKey_Enter)] = false;
    for (int i = 0; i < 3; ++i) gui.frame(draw);
    gui.press(ImGuiKey_Enter, draw);
    EXPECT_EQ(saved, folder.path() / "scene.png");
}

/// The keys go to the name, and Enter opens what is named; in the list it opens a folder.
TEST(FileDialog, EnterOpensWhatWasChosen) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "inside");
    folder.write("a.obj", "");
    folder.write("inside/b.3ds", "");
    BareGui gui;
    FileDialog dialog;
    std::filesystem::path opened;
    dialog.open({.title = "Open",
                 .extensions = {".obj"},
                 .suggestion = "",
                 .done = [&](const auto& file) { opened = file; },
                 .folder = folder.path()});
    const auto draw = [&] {
        ImGui::Begin("background");
        dialog.draw(1.0f);
        ImGui::End();
    };
    const auto shows = [&](std::string_view name) {
        bool found = false;
        dialog.visit_texts([&](std::string_view text) { found = found || text == name; });
        return found;
    };
    for (int i = 0; i < 4; ++i) gui.frame(draw);
    ASSERT_TRUE(shows("a.obj"));
    ASSERT_TRUE(shows("inside/"));
    gui.type("inside", draw);
    gui.press(ImGuiKey_Enter, draw);
    for (int i = 0; i < 3; ++i) gui.frame(draw);
    EXPECT_TRUE(dialog.is_open()) << "a folder is listed";
    EXPECT_TRUE(opened.empty());
    EXPECT_FALSE(shows("b.3ds")) << "not one of those that are asked for";
    gui.type("b.3ds", draw);
    gui.press(ImGuiKey_Enter, draw);
    EXPECT_EQ(opened.filename(), "b.3ds") << "the field has the keys again, and is empty";
    EXPECT_FALSE(dialog.is_open());
}

/// Also in a window that is narrower than it would like to be.
TEST(FileDialog, AMissingFolderIsNamedAndTheNameStays) {
    const test::TemporaryFolder folder;
    BareGui gui;
    FileDialog dialog;
    std::filesystem::path saved;
    dialog.open({.title = "Save",
                 .extensions = {".json"},
                 .suggestion = "cube.json",
                 .done = [&](const auto& file) { saved = file; },
                 .folder = folder.path()});
    float width = 0.0f;
    const auto draw = [&] {
        ImGui::Begin("background");
        dialog.draw(3.0f);
        ImGui::End();
        if (const ImGuiWindow* window = ImGui::FindWindowByName("###file-dialog")) width = window->Size.x;
    };
    for (int i = 0; i < 4; ++i) gui.frame(draw);
    EXPECT_GT(width, 0.0f);
    EXPECT_LE(width, ImGui::GetIO().DisplaySize.x);
    gui.type("missing/mine", draw);
    gui.press(ImGuiKey_Enter, draw);
    for (int i = 0; i < 3; ++i) gui.frame(draw);
    EXPECT_TRUE(dialog.is_open());
    EXPECT_TRUE(saved.empty());
    bool told = false, stays = false;
    dialog.visit_texts([&](std::string_view text) {
        told = told || text.find("missing is no folder") != std::string_view::npos;
        stays = stays || text == "missing/mine";
    });
    EXPECT_TRUE(told);
    EXPECT_TRUE(stays);
}

}  // namespace
}  // namespace elastolab
