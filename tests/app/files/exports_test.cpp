#include "app/files/exports.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "app/stage.hpp"
#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
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

}  // namespace
}  // namespace elastolab
