#include "app/panels/layout.hpp"

#include <gmock/gmock.h>

#include "app/stage.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "methods/registry.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

void expect_sensible(const Layout& layout, const Eigen::Vector2i& window) {
    for (const Viewport& part : {layout.menu, layout.panel, layout.scene, layout.status}) {
        EXPECT_GE(part.width, 0.0);
        EXPECT_GE(part.height, 0.0);
    }
    EXPECT_GE(layout.scene.width, 1.0) << window.transpose();
    EXPECT_GE(layout.scene.height, 1.0) << window.transpose();
    EXPECT_LE(layout.scene.x + layout.scene.width, std::max(1, window.x()));
}

TEST(Layout, FillsTheWindowWithoutOverlap) {
    const Layout layout = layout_of({1280, 800}, 1.0f);
    EXPECT_EQ(layout.panel.width + layout.scene.width, 1280);
    EXPECT_EQ(layout.menu.height + layout.scene.height + layout.status.height, 800);
    EXPECT_EQ(layout.scene.y, layout.menu.height);
    EXPECT_EQ(layout.status.y, layout.scene.y + layout.scene.height);
}

TEST(Layout, LeavesTheSceneSomethingInAnyWindow) {
    for (const int width : {0, 1, 2, 50, 319, 400, 1280, 16384})
        for (const int height : {0, 1, 2, 30, 60, 800, 16384})
            for (const float scale : {0.5f, 1.0f, 2.0f, 3.5f})
                expect_sensible(layout_of({width, height}, scale), {width, height});
}

TEST(Layout, ThePanelGivesWayInANarrowWindow) {
    EXPECT_EQ(layout_of({300, 800}, 1.0f).panel.width, 0.0);
    EXPECT_GT(layout_of({900, 800}, 1.0f).panel.width, 0.0);
    EXPECT_EQ(layout_of({900, 800}, 2.5f).panel.width, 0.0);
}

TEST(Layout, ThePanelIsNarrowerInASmallWindowAndAsWideAsItWasMade) {
    EXPECT_EQ(layout_of({1600, 1000}, 1.0f).panel.width, 320.0);
    EXPECT_LE(layout_of({700, 500}, 1.0f).panel.width, 0.35 * 700);
    DisplaySettings display;
    display.panel_width = 400.0;
    EXPECT_EQ(layout_of({1600, 1000}, 1.0f, display).panel.width, 400.0);
    EXPECT_EQ(layout_of({1600, 1000}, 1.5f, display).panel.width, 600.0);
    display.panel_width = 5000.0;
    EXPECT_GE(layout_of({1600, 1000}, 1.0f, display).scene.width, 160.0);
    display.panel = false;
    EXPECT_EQ(layout_of({1600, 1000}, 1.0f, display).scene.width, 1600.0);
}

TEST(Viewports, OneForTheActiveMethod) {
    test::Stage stage(2);
    const auto viewports = viewports_of(stage.state, {320, 27, 960, 746});
    ASSERT_THAT(viewports, SizeIs(1));
    EXPECT_THAT(viewports[0].kinds, ElementsAre(kLinearBem));
}

TEST(Viewports, OfAComparisonSideBySideShareTheWidthInTheOrderOfAllMethods) {
    test::Stage stage(2);
    stage.state.compare.mode = CompareMode::side_by_side;
    stage.state.compare.kinds = {kLinearBem, kFem, kConstantBem};
    const auto viewports = viewports_of(stage.state, {320, 27, 960, 746});
    ASSERT_THAT(viewports, SizeIs(3));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_THAT(viewports[i].kinds, ElementsAre(all_methods()[i]));
        EXPECT_EQ(viewports[i].place.width, viewports[0].place.width);
    }
    for (std::size_t i = 1; i < 3; ++i)
        EXPECT_GE(viewports[i].place.x, viewports[i - 1].place.x + viewports[i - 1].place.width);
    EXPECT_NEAR(viewports[2].place.x + viewports[2].place.width, 1280.0, 1e-9);
}

/// Four and more share two rows, so that bodies are large enough to be seen.
TEST(Viewports, OfFourAndMoreMethodsAreInTwoRows) {
    test::Stage stage(2);
    stage.state.compare.mode = CompareMode::side_by_side;
    const Viewport scene{320, 27, 960, 746};
    for (const std::size_t n : {4u, 5u, 6u}) {
        stage.state.compare.kinds.assign(all_methods().begin(), all_methods().begin() + static_cast<std::ptrdiff_t>(n));
        const auto viewports = viewports_of(stage.state, scene);
        ASSERT_THAT(viewports, SizeIs(n));
        const std::size_t n_columns = (n + 1) / 2;
        for (std::size_t i = 0; i < n; ++i) {
            const Viewport& place = viewports[i].place;
            EXPECT_EQ(place.y == scene.y, i < n_columns);
            EXPECT_LE(place.y + place.height, scene.y + scene.height + 1e-9);
            EXPECT_LE(place.x + place.width, scene.x + scene.width + 1e-9);
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_FALSE(viewports[j].place.contains(place.center())) << "no overlap";
        }
    }
}

/// Whatever is compared, the legend stands over no body: its strip is free, and all bodies have the same room.
TEST(Viewports, KeepTheStripOfTheLegendFree) {
    test::Stage stage(2);
    const Viewport scene{272, 23, 528, 550};
    for (const CompareMode mode : {CompareMode::off, CompareMode::ghosts, CompareMode::side_by_side}) {
        stage.state.compare.mode = mode;
        stage.state.display.field = Field::displacement;
        const auto viewports = viewports_of(stage.state, scene);
        const Viewport& last = viewports.back().place;
        EXPECT_EQ(last.covered, kLegendHeadingWidth + 26.0);
        EXPECT_NEAR(last.x + last.width, 800.0, 1e-9);
        for (const SceneViewport& viewport : viewports)
            EXPECT_NEAR(viewport.place.free_aspect(), last.free_aspect(), 1e-12);
        stage.state.display.field = Field::none;
        EXPECT_EQ(viewports_of(stage.state, scene).back().place.covered, 0.0);
    }
}

TEST(Viewports, OfGhostsLieOverEachOtherTheActiveMethodFirst) {
    test::Stage stage(2);
    stage.state.compare.mode = CompareMode::ghosts;
    stage.state.method = kConstantBem;
    const auto viewports = viewports_of(stage.state, {320, 27, 960, 746});
    ASSERT_THAT(viewports, SizeIs(1));
    EXPECT_THAT(viewports[0].kinds, ElementsAre(kConstantBem, kFem, kLinearBem, kGalerkinBem));
}

TEST(Viewports, OfASliverAreStillThere) {
    test::Stage stage(2);
    stage.state.compare.mode = CompareMode::side_by_side;
    for (const SceneViewport& viewport : viewports_of(stage.state, {0, 0, 1, 1})) {
        EXPECT_GE(viewport.place.width, 1.0);
        EXPECT_GE(viewport.place.height, 1.0);
    }
}

}  // namespace
}  // namespace elastolab
