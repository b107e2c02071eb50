#include "app/files/exports.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "app/files/export_source.hpp"
#include "app/stage.hpp"
#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "methods/registry.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::n_errors;
using test::Stage;
using test::TemporaryFolder;
using testing::HasSubstr;

TEST(Exports, AreTheDeformedMesh) {
    const TemporaryFolder folder;
    Stage stage(2);
    const int v = stage.vertex_near({1, 1, 1});
    stage.scene().add_handle(std::vector<int>{v});
    stage.scene().set_motion(0, AffineMotion{.translate = {0.5, 0, 0}});
    stage.settle();
    stage.state.export_mesh(folder.path() / "out.obj");
    const LiveScene read(document_for_mesh(folder.path() / "out.obj"), folder.path() / "scene.json");
    EXPECT_NEAR(read.mesh().vertices.row(0).maxCoeff(), 1.5, 1e-9);
}

/// What is written is what is seen; where that is not the present scene's answer, a word tells.
TEST(Exports, OfAFormerAnswerSaySo) {
    const TemporaryFolder folder;
    Stage stage(2);
    stage.state.method = kFem;
    stage.scene().add_load(std::vector<int>{stage.vertex_near({1, 1, 1}), stage.vertex_near({1, 1, 0.5}),
                                            stage.vertex_near({1, 0.5, 1}), stage.vertex_near({1, 0.5, 0.5})},
                           ForceLoad{{1, 0, 0}});
    stage.scene().commit();
    stage.settle();
    stage.state.export_mesh(folder.path() / "now.obj");
    EXPECT_THAT(stage.state.messages.all().back().text, testing::EndsWith("now.obj"));
    stage.state.choices.preview = false;
    stage.scene().set_material({1.0, 0.3});
    stage.state.update_displacements();
    stage.state.export_mesh(folder.path() / "then.obj");
    EXPECT_THAT(stage.state.messages.all().back().text, HasSubstr("the method is not ready yet"));
}

TEST(Exports, OfFieldsAreWrittenOnAWorker) {
    const TemporaryFolder folder;
    Stage stage(2);
    stage.state.method = kFem;
    const int v = stage.vertex_near({1, 1, 1});
    stage.scene().add_handle(std::vector<int>{v});
    stage.scene().set_motion(0, AffineMotion{.translate = {0.5, 0, 0}});
    stage.settle();
    for (const char* name : {"out.ply", "out.vtp", "out.vtu", "out.csv"}) {
        stage.state.export_mesh(folder.path() / name);
        EXPECT_TRUE(stage.state.waiting());
        stage.settle();
        EXPECT_GT(std::filesystem::file_size(folder.path() / name), 500u) << name;
    }
    EXPECT_EQ(n_errors(stage.state), 0);
    std::ifstream table(folder.path() / "out.csv");
    std::string row;
    for (int i = -2; i < v; ++i) std::getline(table, row);
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream numbers(row);
    std::vector<double> values{std::istream_iterator<double>(numbers), {}};
    ASSERT_EQ(values.size(), 17u);
    EXPECT_EQ(values[0], v);
    EXPECT_NEAR(values[4], 0.5, 1e-12);
    EXPECT_GT(values[7], 0.0) << "von Mises";

    stage.state.export_mesh(folder.path() / "first.vtp");
    EXPECT_EQ(stage.state.exported_file(), folder.path() / "first.vtp");
    stage.state.export_mesh(folder.path() / "second.vtp");
    EXPECT_EQ(n_errors(stage.state), 1) << "the first is still being written";
    EXPECT_THAT(stage.state.messages.all().back().text, HasSubstr("first.vtp is still being written"));
    stage.settle();
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "first.vtp"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "second.vtp"));

    stage.state.method = kLinearBem;
    stage.settle();
    stage.state.export_mesh(folder.path() / "none.vtu");
    stage.settle();
    EXPECT_EQ(n_errors(stage.state), 2);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "none.vtu"));
}

/// A second handle is being prepared while the first one's answer is shown.
TEST(Exports, OfAFigureWaitForTheAnswerToThePresentHandles) {
    const TemporaryFolder folder;
    Stage stage;
    stage.state.choices.rims = 3;
    Document document = test::cube_document_with_handle(6);
    document.method = first_method();
    stage.open(document);
    stage.settle();
    std::vector<int> below;
    for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v)
        if (const Eigen::Vector3d x = stage.scene().mesh().vertices.col(v); x.z() == 0.0 && x.x() > 0.4 && x.x() < 0.9)
            below.push_back(v);
    stage.scene().add_handle(below);
    stage.scene().commit();
    stage.state.update_displacements();
    Control control;
    const auto source = [&] { return export_source(stage.scene(), stage.state.simulation.answer(document.method)); };
    for (const char* file : {"pull.html", "pull.glb"}) {
        try {
            write_export(folder.path() / file, source(), control);
            ADD_FAILURE() << file << " was written";
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("Wait until the method is ready"));
        }
    }
    write_export(folder.path() / "u.csv", source(), control);
    stage.settle();
    EXPECT_NO_THROW(write_export(folder.path() / "pull.glb", source(), control));
}

}  // namespace
}  // namespace elastolab
