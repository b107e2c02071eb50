// The panel of the real window: what is typed and clicked there, and that it keeps still.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string_view>
#include <thread>
#include <vector>

#include "app/pixels.hpp"
#include "app/real_window.hpp"
#include "app/screen.hpp"
#include "app/stage.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

// Places in the panel of a window of 1000 x 1000 pixels.
const Eigen::Vector2d kSecondRow(60, 434), kRemoveFirst(261, 413), kNewFixedSet(58, 527), kName(90, 577),
    kMove(38, 606);

/// The row of a handle in the panel chooses it; its name and numbers are typed, from field to field by the Tab key.
TEST(RealPanel, AHandleIsNamedMovedAndTurnedByTyping) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document_with_handle(4));
    RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.click(kSecondRow);
    window.settle();
    window.type_into(kName, "tip");
    window.click(kMove);  // along x
    window.stroke("ctrl+a");
    for (const char* key : {"0", "period", "2", "5", "Tab", "Tab", "Tab", "Tab", "Tab", "7", "5", "0"})
        window.stroke(key);
    window.type("");
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);

    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.handles.size(), 1u);
    EXPECT_EQ(left.handles[0].name, "tip");
    const auto& motion = std::get<AffineMotion>(left.handles[0].motion);
    const Eigen::Vector3d middle(1, 0.5, 0.5);
    EXPECT_LT((map_of(motion).displacement(middle) - Eigen::Vector3d(0.25, 0, 0)).norm(), 1e-6);
    EXPECT_NEAR(motion.rotate.degrees, 750.0, 1e-9) << "two full turns and a bit";
    EXPECT_LT((motion.rotate.axis - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

/// "1e4" is a number on the way to "1e400", which is none.
TEST(RealPanel, WhatIsNoNumberLeavesWhatWasThere) {
    const TemporaryFolder folder;
    const Document document = cube_document_with_handle(4);
    save_scene(folder.path() / "cube.json", document);
    RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.click(kSecondRow);
    window.settle();
    window.click(kMove);
    window.stroke("ctrl+a");
    for (const char* key : {"1", "e", "4", "0", "0"}) window.stroke(key);
    window.type("");
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);
    EXPECT_EQ(load_scene(folder.path() / "out.json"), document);
}

/// A press at the body ends the typing of what is selected still, as a step of its own.
TEST(RealPanel, WhatIsTypedCountsWhenTheBodyIsPulledNext) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document_with_handle(4));
    RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.click(kSecondRow);
    window.settle();
    const auto type_and_pull = [&](const Eigen::Vector2d& field, const std::vector<const char*>& keys,
                                   const Eigen::Vector2d& from) {
        window.click(field);
        window.stroke("ctrl+a");
        for (const char* key : keys) window.stroke(key);
        window.drag(from, from + Eigen::Vector2d(20, -40));
        window.settle();
    };
    type_and_pull(kName, {"t", "i", "p"}, {620, 380});
    window.click(kSecondRow);
    window.settle();
    type_and_pull(kMove, {"0", "period", "2", "5"}, {470, 420});
    window.key("ctrl+z");  // the second pull only
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);
    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.handles.size(), 2u);
    EXPECT_EQ(left.handles[0].name, "tip");
    const Eigen::Vector3d middle(1, 0.5, 0.5);
    EXPECT_NEAR(map_of(std::get<AffineMotion>(left.handles[0].motion)).displacement(middle).x(), 0.25, 1e-6);
}

/// What is selected is named after F2, whether it is a handle or a fixed set, and removed by Del.
TEST(RealPanel, KeysNameAndRemoveWhatIsSelected) {
    const TemporaryFolder folder;
    Document document = cube_document(4);
    for (const double x : {0.5, 1.0})
        document.handles.push_back(
            {.name = "", .select = {PlaneSelector{{x, 0, 0}, {1, 0, 0}, 1e-9}}, .motion = AffineMotion{}});
    save_scene(folder.path() / "cube.json", document);
    RealWindow window({"cube.json", "--size", "800x600", "--scene-out", "out.json"}, folder.path());
    window.settle();
    const auto name_selection = [&](const std::string& name) {
        window.key("F2");
        window.type(name);  // at once: letters are no shortcuts from then on
        window.settle();
    };
    window.stroke("h");
    name_selection("middle");
    window.stroke("j");
    name_selection("wall");
    window.stroke("h");
    window.stroke("Delete");
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);
    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.handles.size(), 1u);
    EXPECT_EQ(left.handles[0].name, "middle");
    ASSERT_EQ(left.fixed.size(), 1u);
    EXPECT_EQ(left.fixed[0].name, "wall");
}

/// Below the panel linear answers say how far linear theory is off, with a button that switches to the method that is
/// not; they say nothing of a motion that it is right for, whose place of the button is empty.
TEST(RealPanel, WhereLinearTheoryIsOffAButtonSwitchesToNonlinearFem) {
    const Eigen::Vector2d button(80, 909);  // above two warnings of a coarse mesh
    for (const double degrees : {2.0, 60.0}) {
        const TemporaryFolder folder;
        Document document = cube_document_with_handle(4);
        document.handles[0].motion =
            AffineMotion{.rotate = {.axis = Eigen::Vector3d::UnitX(), .degrees = degrees, .center = {1, 0.5, 0.5}}};
        save_scene(folder.path() / "cube.json", document);
        RealWindow window({"cube.json", "--method", "fem", "--size", "1000x1000", "--scene-out", "out.json"},
                          folder.path());
        for (int attempt = 0; attempt < 5; ++attempt) {  // what says so comes after the answer, from a worker
            std::this_thread::sleep_for(std::chrono::milliseconds(500));
            window.settle();
            window.click(button);
        }
        window.settle();
        ASSERT_EQ(window.quit().exit_code, 0);
        EXPECT_EQ(name(load_scene(folder.path() / "out.json").method),
                  std::string_view(degrees > 10.0 ? "nonlinear-fem" : "fem"));
    }
}

/// Where the bars that head the sections of the panel begin and end: right of everything else in it, and above where
/// warnings come up, which cover what is below them and move nothing.
std::vector<int> bars(const std::filesystem::path& picture) {
    const Pixels pixels(picture);
    std::vector<int> places;
    for (int y = 30; y < 850; ++y)
        if (pixels.at({299, y}) != pixels.at({299, y - 1})) places.push_back(y);
    return places;
}

/// The panel of a cube after what was done with its window: before, while and after something is pulled.
TEST(RealPanel, NothingInItMovesDuringADrag) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    const Screen screen(folder.path() / "cube.json", {1000, 1000});
    const Eigen::Vector2d beside(600, 930);
    const auto bars_after = [&](const std::function<void(RealWindow&)>& action) {
        RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json", "--screenshot", "panel.png"},
                          folder.path());
        window.settle();
        action(window);
        EXPECT_EQ(window.wait().exit_code, 0);
        return bars(folder.path() / "panel.png");
    };
    const std::vector<int> at_rest = bars_after([&](RealWindow& window) {
        window.move(beside);  // nothing of the panel explains itself
        window.settle();
        window.close();
    });
    EXPECT_GE(at_rest.size(), 6u);
    const Eigen::Vector2d from = screen.pixel({0.75, 0.25, 1}), to = from + Eigen::Vector2d(20, -30);
    EXPECT_EQ(at_rest, bars_after([&](RealWindow& window) {
                  window.move(from);
                  window.press();
                  for (const double part : {0.3, 0.6, 1.0}) window.move(from + part * (to - from));
                  window.settle();
                  window.close();
              }));
    EXPECT_EQ(at_rest, bars_after([&](RealWindow& window) {
                  window.drag(from, to);
                  window.settle();
                  window.close();
              }));
}

/// Nor does it when another tool is chosen, each of which has settings of its own.
TEST(RealPanel, AnotherToolMovesNothingBelowIt) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    const auto bars_with = [&](const char* tool) {
        RealWindow window({"cube.json", "--size", "1000x1000", "--screenshot", "panel.png"}, folder.path());
        window.settle();
        window.move({600, 930});
        window.stroke(tool);
        window.settle();
        EXPECT_EQ(window.quit().exit_code, 0);
        return bars(folder.path() / "panel.png");
    };
    const std::vector<int> pulling = bars_with("v");
    EXPECT_GE(pulling.size(), 6u);
    for (const char* tool : {"b", "n", "i"}) EXPECT_EQ(bars_with(tool), pulling) << tool;
}

/// Of a handle and a fixed set that were selected one after the other, the list shows only the last as selected; none
/// when that is given up.
TEST(RealPanel, OneRowAtMostIsShownAsSelected) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document_with_handle(4));
    const auto selected_rows = [&](const std::vector<const char*>& keys, bool gives_up) {
        RealWindow window({"cube.json", "--size", "1000x1000", "--screenshot", "panel.png"}, folder.path());
        window.settle();
        for (const char* key : keys) window.stroke(key);
        if (gives_up) window.click(kSecondRow);
        window.move({500, 900});
        window.settle();
        EXPECT_EQ(window.quit().exit_code, 0);
        const Pixels pixels(folder.path() / "panel.png");
        const Eigen::Vector2d right(140, 0), first = kSecondRow + right - Eigen::Vector2d(0, 21),
                                             second = kSecondRow + right, empty = second + Eigen::Vector2d(0, 42);
        return std::vector{pixels.at(first) != pixels.at(empty), pixels.at(second) != pixels.at(empty)};
    };
    EXPECT_EQ(selected_rows({"j"}, false), (std::vector{true, false}));
    EXPECT_EQ(selected_rows({"j", "h"}, false), (std::vector{false, true}));
    EXPECT_EQ(selected_rows({"j", "h"}, true), (std::vector{false, false}));
}

/// In a small window the sections share the room below the method: what "Show" has is one click away, not scrolled to.
TEST(RealPanel, ShowIsWithinReachInASmallWindow) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    RealWindow window({"cube.json", "--method", "fem", "--size", "800x600", "--screenshot", "panel.png"},
                      folder.path());
    window.settle();
    window.click({158, 251});  // "Show"
    window.settle();
    window.click({136, 518});  // "light theme"
    window.settle();
    EXPECT_EQ(window.quit().exit_code, 0);
    EXPECT_GT(Pixels(folder.path() / "panel.png").at({300, 500}).minCoeff(), 128);
}

/// Where there is no room for the panel, the name is typed over the scene.
TEST(RealPanel, ANameIsTypedInAWindowTooSmallForThePanel) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    RealWindow window({"cube.json", "--size", "340x300", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.stroke("j");
    window.stroke("F2");
    window.settle();
    window.stroke("ctrl+a");
    window.type("wall");
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);
    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.fixed.size(), 1u);
    EXPECT_EQ(left.fixed[0].name, "wall");
}

/// The button begins a set, a stroke of the brush makes it, its name is typed, and the set that was there is removed.
TEST(RealPanel, AFixedSetIsBegunPaintedNamedAndAnotherRemoved) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document_with_handle(4));
    const Screen screen(folder.path() / "cube.json", {1000, 1000});
    RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.click(kNewFixedSet);
    window.settle();
    window.drag(screen.pixel({0.25, 0.5, 1}), screen.pixel({0.75, 0.5, 1}));
    window.settle();
    window.type_into(kName, "clamp");
    // Esc takes a stroke back.
    window.move(screen.pixel({0.25, 0.25, 1}));
    window.press();
    window.move(screen.pixel({0.75, 0.25, 1}));
    window.settle();
    window.key("Escape");
    window.release();
    window.settle();
    window.click(kRemoveFirst);
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);

    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.fixed.size(), 1u);
    EXPECT_EQ(left.fixed[0].name, "clamp");
    const auto& painted = std::get<VertexSelector>(left.fixed[0].select.shape).vertices;
    EXPECT_GE(painted.size(), 2u);
    for (const int v : painted) {
        EXPECT_EQ(screen.mesh().vertices(2, v), 1.0) << "on the top";
        EXPECT_EQ(screen.mesh().vertices(1, v), 0.5) << "along the stroke";
    }
}

/// A single vertex is pulled, which is warned of as soon as the button is let go: the field for its name is where it
/// was.
TEST(RealPanel, AWarningDoesNotMoveWhatIsToBeClicked) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    const Screen screen(folder.path() / "cube.json", {1000, 1000});
    RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.key("bracketleft", 20);
    const Eigen::Vector2d from = screen.pixel({0.75, 0.25, 1});
    window.drag(from, from + Eigen::Vector2d(20, -30));
    window.settle();
    window.type_into(kName, "tip");
    ASSERT_EQ(window.quit().exit_code, 0);
    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.handles.size(), 1u);
    EXPECT_EQ(left.handles[0].name, "tip");
    ASSERT_EQ(run_program({"solve", "out.json", "--report", "report.json", "--quiet"}, folder.path()).exit_code, 0);
    EXPECT_NE(read_text(folder.path() / "report.json").find("constrained alone"), std::string::npos)
        << "nothing warned of";
}

}  // namespace
}  // namespace elastolab::test
