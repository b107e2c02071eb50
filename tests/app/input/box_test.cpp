// Fixing and freeing vertices with a box drawn over the scene.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/stage.hpp"

namespace elastolab::test {
namespace {

class Box : public testing::Test {
protected:
    Box() { stage.state.tools.tool = Tool::box; }
    std::ptrdiff_t n_fixed() { return std::ssize(stage.scene().vertices(LiveScene::kFixed)); }
    /// Around all that is there.
    void draw_around_all() {
        const Viewport& place = stage.state.shown.viewports.front().place;
        stage.drag({place.x + 1, place.y + 1}, {place.x + place.width - 2, place.y + place.height - 2});
    }
    Stage stage;
    std::ptrdiff_t n_before = n_fixed(), n_vertices = stage.scene().mesh().n_vertices();
};

TEST_F(Box, ReachesThroughTheBodyOrOnlyWhatIsSeen) {
    stage.state.tools.box_reach = Reach::visible;
    draw_around_all();
    EXPECT_GT(n_fixed(), n_before);
    EXPECT_LT(n_fixed(), n_vertices);
    stage.state.tools.box_reach = Reach::through;
    draw_around_all();
    EXPECT_EQ(n_fixed(), n_vertices);
}

TEST_F(Box, WithShiftFreesAndTheBaseMayBecomeEmpty) {
    stage.state.tools.box_reach = Reach::through;
    stage.modifiers = GLFW_MOD_SHIFT;
    draw_around_all();
    EXPECT_EQ(n_fixed(), 0);
    stage.settle();
    stage.state.undo();
    EXPECT_EQ(n_fixed(), n_before);
}

TEST_F(Box, IsShownWhileItIsDrawn) {
    EXPECT_FALSE(stage.state.gestures.box());
    stage.move(stage.empty_place());
    stage.press();
    stage.move(stage.empty_place() + Eigen::Vector2d(30, 20));
    ASSERT_TRUE(stage.state.gestures.box());
    EXPECT_EQ(stage.state.gestures.box()->first, stage.empty_place());
    stage.release();
    EXPECT_FALSE(stage.state.gestures.box());
}

TEST_F(Box, AClickFixesNothing) {
    stage.click(stage.pixel(stage.vertex_near({0.67, 0.33, 1})));
    EXPECT_EQ(n_fixed(), n_before);
    EXPECT_FALSE(stage.scene().can_undo());
}

}  // namespace
}  // namespace elastolab::test
