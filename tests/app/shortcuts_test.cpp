#include "app/shortcuts.hpp"

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <set>

#include "app/names.hpp"
#include "app/panels/panels.hpp"
#include "app/selection.hpp"
#include "app/stage.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "methods/registry.hpp"

namespace elastolab {
namespace {

class Shortcuts : public testing::Test {
protected:
    bool press(int key, int modifiers = 0) {
        return run_shortcut({.kind = InputEvent::Kind::key, .code = key, .pressed = true, .modifiers = modifiers},
                            stage.state, panels);
    }
    test::Stage stage{2};
    Panels panels;
};

TEST_F(Shortcuts, NoKeyMeansTwoThingsAndEachSaysWhatItDoes) {
    std::set<std::pair<int, int>> seen;
    for (const Shortcut& shortcut : shortcuts()) {
        EXPECT_TRUE(seen.insert({shortcut.key, shortcut.modifiers}).second) << shortcut.keys;
        EXPECT_FALSE(shortcut.keys.empty());
        EXPECT_FALSE(shortcut.action.empty());
    }
}

/// "Shift + left or middle; right": what the help says of a mouse is what that mouse does.
TEST(GestureHelp, SaysWhatEachMouseDoes) {
    const std::map<std::string, ViewDrag> rows = {
        {"to turn the view", ViewDrag::orbit}, {"to move it", ViewDrag::pan}, {"to zoom", ViewDrag::zoom}};
    const std::map<std::string, int> buttons = {
        {"left", GLFW_MOUSE_BUTTON_LEFT}, {"middle", GLFW_MOUSE_BUTTON_MIDDLE}, {"right", GLFW_MOUSE_BUTTON_RIGHT}};
    const std::regex gesture("((?:(?:Shift|Ctrl)(?: \\+ | or ))*)(left|middle|right)(?: or (left|middle|right))?");
    for (const Navigation navigation : {Navigation::standard, Navigation::blender, Navigation::paraview,
                                        Navigation::polyscope, Navigation::trackpad}) {
        int n_said = 0;
        for (const GestureHelp& help : gesture_help(navigation)) {
            const auto row = rows.find(help.gesture);
            if (row == rows.end()) continue;
            const std::string text = help.action;
            for (std::sregex_iterator at(text.begin(), text.end(), gesture), end; at != end; ++at) {
                const std::string modifiers = (*at)[1];
                const bool either = modifiers.find("or") != std::string::npos;
                const int shift = modifiers.find("Shift") != std::string::npos ? GLFW_MOD_SHIFT : 0,
                          control = modifiers.find("Ctrl") != std::string::npos ? GLFW_MOD_CONTROL : 0;
                for (const std::string& button : {at->str(2), at->str(3)}) {
                    if (button.empty()) continue;
                    ++n_said;
                    for (const int held : either ? std::vector{shift, control} : std::vector{shift | control})
                        EXPECT_EQ(view_drag(navigation, buttons.at(button), held), row->second)
                            << text << ": " << at->str();
                }
            }
        }
        EXPECT_GE(n_said, 3) << static_cast<int>(navigation);
    }
}

TEST_F(Shortcuts, NumbersChooseTheMethods) {
    for (std::size_t i = 0; i < all_methods().size(); ++i) {
        EXPECT_TRUE(press(GLFW_KEY_1 + static_cast<int>(i)));
        EXPECT_EQ(stage.state.method, all_methods()[i]);
    }
}

TEST_F(Shortcuts, ModifiersMakeAnotherKey) {
    EXPECT_FALSE(press(GLFW_KEY_Z));
    EXPECT_TRUE(press(GLFW_KEY_Q, GLFW_MOD_CONTROL | GLFW_MOD_NUM_LOCK));  // locks do not
    EXPECT_TRUE(stage.state.requests.quit);
}

TEST_F(Shortcuts, EscapeClosesHelpAndMessages) {
    stage.state.show_help = true;
    stage.state.messages.error("bad");
    EXPECT_TRUE(press(GLFW_KEY_ESCAPE));
    EXPECT_FALSE(stage.state.show_help);
    EXPECT_TRUE(stage.state.messages.all().empty());
}

TEST_F(Shortcuts, ReleasesAreNone) {
    EXPECT_FALSE(run_shortcut({.kind = InputEvent::Kind::key, .code = GLFW_KEY_1}, stage.state, panels));
    EXPECT_FALSE(
        run_shortcut({.kind = InputEvent::Kind::text, .code = GLFW_KEY_1, .pressed = true}, stage.state, panels));
}

TEST_F(Shortcuts, UndoAndRedoGoThroughTheSteps) {
    stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 1, 1})});
    stage.scene().commit();
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    EXPECT_EQ(stage.scene().n_handles(), 0);
    press(GLFW_KEY_Y, GLFW_MOD_CONTROL);
    EXPECT_EQ(stage.scene().n_handles(), 1);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
    EXPECT_EQ(stage.scene().n_handles(), 1);
    press(GLFW_KEY_DELETE, GLFW_MOD_SHIFT);
    EXPECT_EQ(stage.scene().n_handles(), 0);
    press(GLFW_KEY_DELETE);  // nothing is chosen: nothing happens
}

TEST_F(Shortcuts, ActOnTheHandleOrFixedSetThatWasSelectedLast) {
    for (const Eigen::Vector3d& corner : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 0, 0)})
        stage.scene().add_handle(std::vector<int>{stage.vertex_near(corner)});
    stage.scene().fix(std::vector<int>{stage.vertex_near({1, 1, 0})}, 1);
    stage.settle();
    EXPECT_FALSE(selection(stage.state));
    const std::string last_handle = stage.scene().handle_name(1);
    press(GLFW_KEY_H);
    press(GLFW_KEY_H);
    EXPECT_EQ(selected_name(stage.state), last_handle);
    press(GLFW_KEY_J);
    EXPECT_EQ(selected_name(stage.state), stage.scene().fixed_name(0));
    press(GLFW_KEY_J);
    EXPECT_EQ(selected_name(stage.state), stage.scene().fixed_name(1));
    press(GLFW_KEY_F, GLFW_MOD_SHIFT);
    EXPECT_LT((stage.state.camera.pose().target - Eigen::Vector3d(1, 1, 0)).norm(), 1e-6);
    press(GLFW_KEY_DELETE);
    EXPECT_EQ(stage.scene().n_fixed_sets(), 1);
    EXPECT_EQ(stage.scene().n_handles(), 2);
    EXPECT_FALSE(selection(stage.state)) << "the set took the handle's place";
    press(GLFW_KEY_H);
    press(GLFW_KEY_DELETE);
    ASSERT_EQ(stage.scene().n_handles(), 1);
    EXPECT_EQ(stage.scene().handle_name(0), last_handle);
    EXPECT_FALSE(selection(stage.state));
    press(GLFW_KEY_DELETE);  // nothing is selected: nothing happens
    EXPECT_EQ(stage.scene().n_handles(), 1);
    EXPECT_EQ(stage.scene().n_fixed_sets(), 1);
}

TEST_F(Shortcuts, AFixedSetIsBegunWithABrush) {
    press(GLFW_KEY_N, GLFW_MOD_SHIFT);
    EXPECT_EQ(stage.state.tools.tool, Tool::brush);
    EXPECT_EQ(stage.state.gestures.selected_fixed(), stage.scene().n_fixed_sets());
    EXPECT_FALSE(selection(stage.state)) << "it is not there yet";
    press(GLFW_KEY_J);
    EXPECT_EQ(stage.state.gestures.selected_fixed(), 0) << "from there to the first";
}

TEST_F(Shortcuts, DeleteAfterAnUndoneHandleLeavesTheSetOfTheBrush) {
    press(GLFW_KEY_J);
    stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 1, 1})});
    stage.scene().commit();
    press(GLFW_KEY_H);
    press(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    EXPECT_EQ(stage.state.gestures.selected_fixed(), 0);
    press(GLFW_KEY_DELETE);
    EXPECT_EQ(stage.scene().n_fixed_sets(), 1);
}

TEST_F(Shortcuts, BracketsChangeThePatchDownToASingleVertex) {
    for (int i = 0; i < 5; ++i) press(GLFW_KEY_RIGHT_BRACKET);
    EXPECT_GT(stage.state.tools.patch_radius, 0.0);
    for (int i = 0; i < 50; ++i) press(GLFW_KEY_LEFT_BRACKET);
    EXPECT_EQ(stage.state.tools.patch_radius, 0.0);
}

TEST_F(Shortcuts, ComparisonsGoOnAndOff) {
    press(GLFW_KEY_C);
    EXPECT_EQ(stage.state.compare.mode, CompareMode::side_by_side);
    press(GLFW_KEY_G);
    EXPECT_EQ(stage.state.compare.mode, CompareMode::ghosts);
    press(GLFW_KEY_G);
    EXPECT_FALSE(stage.state.comparing());
}

TEST(Names, OfMethodsAreMadeFromThoseInFiles) {
    EXPECT_EQ(title(kFem), "FEM");
    EXPECT_EQ(title(kConstantBem), "Constant BEM");
    EXPECT_EQ(title(kLinearBem), "Linear BEM");
}

}  // namespace
}  // namespace elastolab
