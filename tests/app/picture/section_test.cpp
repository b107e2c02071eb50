// A body of FEM that is cut open: what is left of it, and that only this can be pointed at.
#include "app/picture/section.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "app/stage.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "mesh/tets/tetrahedralize.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

TEST(Section, LeavesAClosedSurfaceAroundTheTetrahedraOfOneSide) {
    Control control;
    const TetMesh mesh = tetrahedralize(make_box(4), "box", {}, control);
    double volume = 0.0;
    for (const bool flip : {false, true}) {
        const SurfaceMesh part{mesh.vertices, cut_faces(mesh, {.axis = 1, .coordinate = 0.4, .flip = flip})};
        volume += enclosed_volume(part);
        std::multiset<std::pair<int, int>> directed;
        for (const auto& t : part.triangles.colwise())
            for (int i = 0; i < 3; ++i) directed.emplace(t[i], t[(i + 1) % 3]);
        for (const auto& [a, b] : directed) EXPECT_EQ(directed.count({a, b}), directed.count({b, a}));
    }
    EXPECT_NEAR(volume, 1.0, 1e-12);
}

class CutOpen : public testing::Test {
protected:
    CutOpen() {
        stage.state.method = kFem;
        stage.state.display.section = true;  // keeps x < 0.5
        stage.settle();
    }
    Stage stage{6};
    int kept = stage.vertex_near({1.0 / 6, 0.5, 1}), gone = stage.vertex_near({5.0 / 6, 0.5, 1});
};

TEST_F(CutOpen, WhatIsCutAwayIsNotPointedAt) {
    ASSERT_TRUE(stage.state.shown.body(kFem)->section());
    stage.move(stage.pixel(kept));
    EXPECT_EQ(stage.hovered(), kept);
    stage.move(stage.pixel(gone));
    EXPECT_NE(stage.hovered(), gone);
    stage.state.display.section = false;
    stage.settle();
    stage.move(stage.pixel(gone) + Eigen::Vector2d(1, 0));
    EXPECT_EQ(stage.hovered(), gone);
}

TEST_F(CutOpen, StaysOpenWhenTheModelIsCompleted) {
    stage.state.choices.complete_up_to = 2000;
    do {
        stage.frame();
        EXPECT_TRUE(stage.state.shown.body(kFem)->section());
    } while (stage.state.simulation.busy());
    EXPECT_TRUE(stage.state.simulation.runner(kFem).has_inverse());
    EXPECT_FALSE(stage.state.shown.cutting());
}

TEST_F(CutOpen, TheCutAppearsByItself) {
    stage.state.display.section = false;
    stage.settle();
    stage.state.display.section = true;
    stage.frame();
    ASSERT_TRUE(stage.state.shown.cutting());
    while (!stage.state.update_displacements()) EXPECT_TRUE(stage.state.shown.cutting());
    stage.state.update_picture();
    EXPECT_TRUE(stage.state.shown.body(kFem)->section());
}

TEST_F(CutOpen, OnlyDisplacementsColourTheCut) {
    for (const Field field : {Field::displacement, Field::von_mises}) {
        stage.state.display.field = field;
        stage.settle();
        EXPECT_EQ(stage.state.shown.body(kFem)->is_coloured(), field == Field::displacement);
    }
}

TEST_F(CutOpen, ABoxFixesWhatIsLeft) {
    stage.state.tools.tool = Tool::box;
    stage.state.tools.box_reach = Reach::through;
    const Viewport& place = stage.state.shown.viewports.front().place;
    stage.drag({place.x + 1, place.y + 1}, {place.x + place.width - 2, place.y + place.height - 2});
    EXPECT_EQ(stage.scene().owner(kept), LiveScene::kFixed);
    EXPECT_EQ(stage.scene().owner(gone), LiveScene::kNobody);
}

TEST_F(CutOpen, APressOnTheCutPullsNothingInside) {
    const auto& section = *stage.state.shown.body(kFem)->section();
    for (int v = stage.scene().mesh().n_vertices(); v < section.positions.cols(); ++v) {
        const Eigen::Vector2d at = stage.pixel(Eigen::Vector3d(section.positions.col(v)));
        stage.drag(at, at + Eigen::Vector2d(20, 0));
        stage.drag(at + Eigen::Vector2d(20, 0), at);
    }
    for (int h = 0; h < stage.scene().n_handles(); ++h)
        for (const int v : stage.scene().vertices(h)) EXPECT_LT(v, stage.scene().mesh().n_vertices());
}

}  // namespace
}  // namespace elastolab::test
