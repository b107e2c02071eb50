// Fixing and freeing vertices with the brush.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/stage.hpp"

namespace elastolab::test {
namespace {

class Brush : public testing::Test {
protected:
    Brush() {
        stage.state.tools.tool = Tool::brush;
        n_fixed_before = n_fixed();
    }
    std::ptrdiff_t n_fixed() { return std::ssize(stage.scene().vertices(LiveScene::kFixed)); }
    bool is_fixed(int v) { return stage.scene().owner(v) == LiveScene::kFixed; }
    /// A stroke over the top, from one side to the other.
    void stroke() { stage.drag(stage.pixel(left), stage.pixel(right)); }

    Stage stage{4};
    int left = stage.vertex_near({0.25, 0.5, 1}), right = stage.vertex_near({0.75, 0.5, 1});
    std::ptrdiff_t n_fixed_before = 0;
};

TEST_F(Brush, AStrokeFixesWhatItCrossesAndIsOneStep) {
    stroke();
    EXPECT_TRUE(is_fixed(right));
    EXPECT_GT(n_fixed(), n_fixed_before);
    EXPECT_FALSE(is_fixed(stage.vertex_near({0.5, 0.5, 0})));  // hidden below
    stage.state.undo();
    EXPECT_EQ(n_fixed(), n_fixed_before);
    EXPECT_FALSE(stage.scene().can_undo());
}

TEST_F(Brush, AStrokeOfOneJumpFixesAllBetween) {
    const int middle = stage.vertex_near({0.5, 0.5, 1});
    stage.move(stage.pixel(left));
    stage.press();
    stage.move(stage.pixel(right));
    stage.release();
    for (const int v : {left, middle, right}) EXPECT_TRUE(is_fixed(v)) << v;
}

TEST_F(Brush, WithShiftItFrees) {
    stroke();
    stage.modifiers = GLFW_MOD_SHIFT;
    stroke();
    EXPECT_FALSE(is_fixed(right));
    EXPECT_EQ(n_fixed(), n_fixed_before);
}

TEST_F(Brush, AClickFixesOneVertexAndTheNextFreesIt) {
    stage.click(stage.pixel(right));
    EXPECT_TRUE(is_fixed(right));
    EXPECT_EQ(n_fixed(), n_fixed_before + 1);
    stage.click(stage.pixel(right));
    EXPECT_EQ(n_fixed(), n_fixed_before);
}

TEST_F(Brush, ChangesTheSelectedFixedSetOnly) {
    const LiveScene& scene = stage.scene();
    stage.state.gestures.select_fixed(scene.n_fixed_sets());  // a new one
    stroke();
    ASSERT_EQ(scene.n_fixed_sets(), 2);
    EXPECT_EQ(scene.fixed_set_of(right), 1);
    EXPECT_EQ(stage.state.gestures.selected_fixed(), 1);
    EXPECT_EQ(std::ssize(scene.fixed_vertices(0)), n_fixed_before);
    stage.state.gestures.select_fixed(0);
    stage.modifiers = GLFW_MOD_SHIFT;
    stroke();
    EXPECT_EQ(scene.fixed_set_of(right), 1) << "belongs to another one";
    stage.state.gestures.select_fixed(-1);
    stroke();
    EXPECT_FALSE(is_fixed(right)) << "none selected: of all";
}

TEST_F(Brush, AClickInAnotherFixedSetSaysWhoseVertexItIs) {
    stage.state.gestures.select_fixed(1);
    stage.click(stage.pixel(right));
    stage.state.gestures.select_fixed(0);
    stage.click(stage.pixel(right));
    EXPECT_TRUE(is_fixed(right));
    EXPECT_NE(stage.state.gestures.hint().find("\"fixed-1\""), std::string::npos);
}

/// The number of a set that has lost its last vertex is that of the next one.
TEST_F(Brush, GoesOnWithNoOtherFixedSetWhenItHasEmptiedItsOwn) {
    const LiveScene& scene = stage.scene();
    stage.state.gestures.select_fixed(1);
    stage.click(stage.pixel(left));
    stage.state.gestures.select_fixed(2);
    stage.click(stage.pixel(right));
    ASSERT_EQ(scene.n_fixed_sets(), 3);
    stage.state.gestures.select_fixed(1);
    stage.modifiers = GLFW_MOD_SHIFT;
    stage.move(stage.pixel(left));
    stage.press();
    stage.move(stage.pixel(left) + Eigen::Vector2d(5, 0));
    stage.move(stage.pixel(right));
    stage.release();
    EXPECT_FALSE(is_fixed(left));
    EXPECT_TRUE(is_fixed(right));
}

TEST_F(Brush, UndoKeepsTheSelectedFixedSetByItsName) {
    stage.state.gestures.select_fixed(0);
    stroke();
    stage.state.undo();
    EXPECT_EQ(stage.state.gestures.selected_fixed(), 0);
    stage.state.remove_fixed_set(0);
    EXPECT_EQ(stage.state.gestures.selected_fixed(), -1);
    EXPECT_EQ(n_fixed(), 0);
    stage.state.undo();
    EXPECT_EQ(n_fixed(), n_fixed_before);
}

TEST_F(Brush, LeavesHandlesAlone) {
    stage.scene().add_handle(std::vector<int>{right});
    stage.settle();
    stroke();
    EXPECT_EQ(stage.scene().owner(right), 0);
}

TEST_F(Brush, TurnsTheViewBesideTheBody) {
    const CameraPose before = stage.state.camera.pose();
    stage.drag(stage.empty_place(), stage.empty_place() + Eigen::Vector2d(50, 0));
    EXPECT_GT(stage.state.camera.pose().orientation.angularDistance(before.orientation), 0.1);
    EXPECT_EQ(n_fixed(), n_fixed_before);
}

}  // namespace
}  // namespace elastolab::test
