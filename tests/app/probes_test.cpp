#include "app/probes.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "app/stage.hpp"
#include "fem/quadratic/method.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

class Probing : public ::testing::Test {
protected:
    Probing() {
        stage.settle();
        stage.state.tools.tool = Tool::probe;
        vertex = stage.vertex_near({1.0, 0.5, 1.0});
    }
    const ShownBody& body() { return *stage.state.shown.body(stage.state.method); }
    void record(double seconds) { stage.state.record_probes(seconds); }

    test::Stage stage;
    int vertex;
};

TEST_F(Probing, AClickChoosesTheVertexAndADragTurnsTheView) {
    stage.click(stage.pixel(vertex));
    EXPECT_EQ(stage.state.gestures.take_probed(), vertex);
    EXPECT_EQ(stage.scene().n_handles(), 0);
    const Eigen::Vector3d before = stage.state.camera.eye();
    stage.drag(stage.pixel(vertex), stage.pixel(vertex) + Eigen::Vector2d(60, 0));
    EXPECT_FALSE(stage.state.gestures.take_probed());
    EXPECT_FALSE(stage.state.camera.eye().isApprox(before));
}

TEST_F(Probing, TellsTrueDisplacementsWhateverThePictureScales) {
    const int handle = stage.scene().add_handle(std::vector{vertex});
    stage.scene().set_motion(handle, AffineMotion{.translate = {0.1, 0.2, -0.3}});
    stage.state.display.field = Field::displacement;
    for (const double scale : {1.0, 3.0}) {
        stage.state.display.deformation_scale = scale;
        stage.settle();
        const ProbeValue value = probe(vertex, stage.scene().mesh().vertices, body(), scale);
        EXPECT_TRUE(value.displacement.isApprox(Eigen::Vector3d(0.1, 0.2, -0.3), 1e-12));
        ASSERT_TRUE(value.field);
        EXPECT_NEAR(*value.field, std::sqrt(0.14), 1e-6);
    }
}

TEST_F(Probing, KeepsARowForEachChange) {
    stage.state.probes.toggle(vertex);
    record(0.0);
    record(1.0);  // nothing changed
    EXPECT_EQ(stage.state.probes.n_samples(), 1u);
    const int handle = stage.scene().add_handle(std::vector{vertex});
    stage.scene().set_motion(handle, AffineMotion{.translate = {0.25, 0.0, 0.0}});
    stage.settle();
    record(2.0);
    EXPECT_EQ(stage.state.probes.series(0, Field::none), (std::vector{0.0f, 0.25f}));
    const test::TemporaryFolder folder;
    stage.state.save_probes(folder.path() / "probes.csv");
    std::ifstream file(folder.path() / "probes.csv");
    std::string head, first, second, more;
    std::getline(file, head), std::getline(file, first), std::getline(file, second);
    EXPECT_EQ(head, "time_s,field,vertex,x,y,z,ux,uy,uz,value,tx,ty,tz,sxx,syy,szz,sxy,syz,sxz,method,state");
    EXPECT_TRUE(first.starts_with("0,," + std::to_string(vertex) + ",1,"));
    EXPECT_THAT(second, testing::HasSubstr(",0.25,0,0,,"));
    EXPECT_TRUE(second.ends_with("," + std::string(name(stage.state.method)) + ",exact")) << second;
    EXPECT_FALSE(std::getline(file, more));
    stage.state.probes.toggle(vertex);
    EXPECT_TRUE(stage.state.probes.vertices().empty());
}

/// What was recorded at one vertex stays when others are kept or forgotten.
TEST_F(Probing, EachVertexHasItsOwnPast) {
    Probes& probes = stage.state.probes;
    const int other =
        stage.vertex_near({1, 1, 1}) == vertex ? stage.vertex_near({1, 0, 0}) : stage.vertex_near({1, 1, 1});
    probes.toggle(vertex);
    record(0.0);
    const int handle = stage.scene().add_handle(std::vector{vertex});
    const auto move_to = [&](double x, double seconds) {
        stage.scene().set_motion(handle, AffineMotion{.translate = {x, 0.0, 0.0}});
        stage.settle();
        record(seconds);
    };
    move_to(0.25, 1.0);
    probes.toggle(other);
    record(1.5);  // what is shown already
    move_to(0.5, 2.0);
    EXPECT_EQ(probes.series(0, Field::none), (std::vector{0.0f, 0.25f, 0.5f}));
    EXPECT_EQ(probes.series(1, Field::none).size(), 2u);
    const test::TemporaryFolder folder;
    stage.state.save_probes(folder.path() / "probes.csv");
    std::ifstream file(folder.path() / "probes.csv");
    int n_rows = -1;
    for (std::string line; std::getline(file, line);) ++n_rows;
    EXPECT_EQ(n_rows, 5);
    probes.toggle(vertex);
    EXPECT_EQ(probes.vertices(), std::vector{other});
    EXPECT_EQ(probes.series(0, Field::none).size(), 2u);
}

/// Lengths and stresses are no one curve.
TEST_F(Probing, ASeriesIsOfOneField) {
    stage.state.probes.toggle(vertex);
    record(0.0);
    const int handle = stage.scene().add_handle(std::vector{vertex});
    stage.scene().set_motion(handle, AffineMotion{.translate = {0.25, 0.0, 0.0}});
    stage.state.display.field = Field::displacement_x;
    stage.settle();
    record(1.0);
    EXPECT_EQ(stage.state.probes.series(0, Field::displacement_x), std::vector{0.25f});
    EXPECT_EQ(stage.state.probes.series(0, Field::none), std::vector{0.0f});
    EXPECT_EQ(stage.state.probes.series(0, Field::von_mises).size(), 0u);
}

/// What stands there until the next set is prepared is no answer to it.
TEST_F(Probing, KeepsNothingOfASceneBefore) {
    stage.state.probes.toggle(vertex);
    record(0.0);
    const int handle = stage.scene().add_handle(std::vector{vertex});
    stage.scene().set_motion(handle, AffineMotion{.translate = {0.25, 0.0, 0.0}});
    stage.frame();
    stage.state.display.deformation_scale = 2.0;  // another picture
    stage.state.update_picture();
    const bool answers = stage.state.simulation.answer(stage.state.method).runner().answers();
    record(1.0);
    EXPECT_EQ(stage.state.probes.n_samples(), answers ? 2u : 1u);
    stage.settle();
    record(2.0);
    EXPECT_EQ(stage.state.probes.series(0, Field::none).back(), 0.25f);
}

TEST_F(Probing, NamesTheMethodThatDifferencesAreTo) {
    stage.state.probes.toggle(vertex);
    stage.state.display.field = Field::difference;
    stage.state.compare.reference = kQuadraticFem;
    record(0.0);
    const test::TemporaryFolder folder;
    stage.state.save_probes(folder.path() / "probes.csv");
    EXPECT_THAT(test::read_text(folder.path() / "probes.csv"), testing::HasSubstr("difference to Quadratic FEM"));
}

}  // namespace
}  // namespace elastolab
