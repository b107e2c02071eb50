#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::ProgramRun;
using test::run_program;
using testing::HasSubstr;
using testing::Not;

nlohmann::json info(const std::string& file, const std::filesystem::path& folder) {
    const ProgramRun run = run_program({"info", "--json", file}, folder);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out);
}

TEST(Info, DescribesASoundMesh) {
    const test::TemporaryFolder folder;
    save_surface(folder.path() / "cube.ply", make_box(3));
    const nlohmann::json json = info("cube.ply", folder.path());
    EXPECT_EQ(json["vertices"], 56);
    EXPECT_EQ(json["faces"], 108);
    EXPECT_EQ(json["components"], 1);
    EXPECT_EQ(json["closed"], true);
    EXPECT_NEAR(json["volume"].get<double>(), 1.0, 1e-12);
    EXPECT_NEAR(json["area"].get<double>(), 6.0, 1e-12);
    EXPECT_TRUE(json["defects"].empty());
    EXPECT_TRUE(json["usable_for_fem"].get<bool>());
}

TEST(Info, PredictsTheCostOfEveryMethodInEveryMode) {
    const test::TemporaryFolder folder;
    save_surface(folder.path() / "coarse.ply", make_box(3));
    save_surface(folder.path() / "fine.ply", make_box(12));
    const nlohmann::json coarse = info("coarse.ply", folder.path())["methods"];
    const nlohmann::json fine = info("fine.ply", folder.path())["methods"];
    std::size_t n_rows = 0;
    for (const MethodKind kind : all_methods()) n_rows += kind->modes.size();
    ASSERT_EQ(coarse.size(), n_rows);
    ASSERT_EQ(fine.size(), n_rows);
    for (std::size_t i = 0; i < n_rows; ++i) {
        const std::string row = coarse[i]["method"].get<std::string>() + " " + coarse[i]["mode"].get<std::string>();
        EXPECT_GT(coarse[i]["degrees_of_freedom"].get<int>(), 0) << row;
        EXPECT_GT(coarse[i]["memory_bytes"].get<double>(), 0.0) << row;
        EXPECT_GT(coarse[i]["seconds"].get<double>(), 0.0) << row;
        EXPECT_GT(fine[i]["degrees_of_freedom"].get<int>(), 10 * coarse[i]["degrees_of_freedom"].get<int>()) << row;
        EXPECT_GT(fine[i]["memory_bytes"].get<double>(), 3.0 * coarse[i]["memory_bytes"].get<double>()) << row;
        EXPECT_GT(fine[i]["seconds"].get<double>(), 3.0 * coarse[i]["seconds"].get<double>()) << row;
    }
}

TEST(Info, DescribesTheMeshOfAScene) {
    const test::TemporaryFolder folder;
    folder.write("scene.json", test::cube_scene("fem", 2));
    EXPECT_EQ(info("scene.json", folder.path())["vertices"], 26);
}

TEST(Info, PrintsATable) {
    const test::TemporaryFolder folder;
    folder.write("scene.json", test::cube_scene("fem", 2));
    const ProgramRun run = run_program({"info", "scene.json"}, folder.path());
    for (const char* text : {"vertices", "26", "closed", "yes", "volume", "none", "constant-bem", "full-volume"})
        EXPECT_THAT(run.out, HasSubstr(text));
}

TEST(Info, ListsTheDefectsOfAMeshThatNoMethodCanUse) {
    const test::TemporaryFolder folder;
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const nlohmann::json json = info("open.obj", folder.path());
    EXPECT_FALSE(json["closed"].get<bool>());
    EXPECT_FALSE(json["usable"].get<bool>());
    EXPECT_EQ(json["defects"][0]["kind"], "open-edges");
    EXPECT_EQ(json["defects"][0]["count"], 3);
    for (const auto& row : json["methods"]) {
        EXPECT_FALSE(row["usable"].get<bool>());
        EXPECT_EQ(row["simulates"], "proxy");
        EXPECT_GT(row["memory_bytes"].get<double>(), 0.0);
    }
    EXPECT_GT(json["proxy"]["vertices"].get<int>(), 100);
    const std::string table = run_program({"info", "open.obj"}, folder.path()).out;
    EXPECT_THAT(table, HasSubstr("on the proxy"));
    EXPECT_THAT(table, HasSubstr("  defect        3 open edges near (")) << "nothing has to be done about it";
    EXPECT_THAT(table, Not(HasSubstr("Fill the holes")));
}

TEST(Info, SimulatesAProxyAsTheOptionsSay) {
    const test::TemporaryFolder folder;
    save_surface(folder.path() / "cube.ply", make_box(8));
    const auto json_with = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments = {"info", "--json", "cube.ply"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return nlohmann::json::parse(run_program(arguments, folder.path()).out);
    };
    EXPECT_TRUE(json_with({})["proxy"].is_null());
    EXPECT_EQ(json_with({})["methods"][0]["simulates"], "surface");
    const nlohmann::json always = json_with({"--proxy", "always", "--proxy-vertices", "100"});
    EXPECT_EQ(always["methods"][0]["simulates"], "proxy");
    EXPECT_NEAR(always["proxy"]["vertices"].get<double>(), 100.0, 50.0);
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(run_program({"info", "--proxy", "sometimes", "open.obj"}, folder.path()).exit_code, 2);
    const ProgramRun never = run_program({"info", "--proxy", "never", "open.obj"}, folder.path());
    EXPECT_THAT(never.out, HasSubstr("not possible"));
    EXPECT_THAT(never.out, HasSubstr("Fill the holes and reload"));
}

TEST(Info, TellsWhyThereIsNoProxy) {
    const test::TemporaryFolder folder;
    folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    const nlohmann::json json = info("line.obj", folder.path());
    EXPECT_TRUE(json["proxy"].is_null());
    EXPECT_TRUE(json["methods"][0]["simulates"].is_null());
}

}  // namespace
}  // namespace elastolab
