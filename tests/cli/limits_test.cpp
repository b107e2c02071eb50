#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/machine.hpp"
#include "cli/program.hpp"
#include "support/one_core.hpp"

namespace elastolab::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kTimedOut = 124;

class LimitsTest : public testing::Test {
protected:
    /// Runs the program in the folder after a shell command, such as ulimit; kTimedOut when it does not end.
    ProgramRun run(const std::string& before, const std::string& arguments) const {
        const std::string command = "cd '" + folder_.path().string() + "' && " + before +
                                    " && timeout -s KILL 100 '" ELASTOLAB_PROGRAM "' " + arguments + " > '" +
                                    outputs_.path().string() + "/out' 2> '" + outputs_.path().string() + "/err'";
        const int status = std::system(command.c_str());
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
        return {code == 128 + SIGKILL ? kTimedOut : code, read_text(outputs_.path() / "out"),
                read_text(outputs_.path() / "err")};
    }

    TemporaryFolder folder_, outputs_;
};

/// OpenBLAS tries for ever when it cannot have its buffer.
TEST_F(LimitsTest, SaysOutOfMemoryWhereAddressesAreFew) {
    folder_.write("scene.json", cube_scene("linear-bem", 11));
    int n_refused = 0;
    for (const int mib : {200, 250, 350, 500, 800, 8000}) {
        const ProgramRun result = run("ulimit -v " + std::to_string(mib * 1024), "solve --quiet scene.json");
        ASSERT_NE(result.exit_code, kTimedOut) << mib;
        if (result.exit_code == 0) continue;
        ++n_refused;
        EXPECT_LT(mib, 8000);
        EXPECT_THAT(result.err, AnyOf(HasSubstr("emory"), HasSubstr("cannot allocate"), HasSubstr("failed to map")));
    }
    EXPECT_GT(n_refused, 0);
}

TEST_F(LimitsTest, SaysThatAFileCannotGrow) {
    folder_.write("scene.json", cube_scene("linear-bem", 4));
    folder_.write("u.csv", "before");
    const ProgramRun result = run("ulimit -f 2", "solve --quiet scene.json --displacements u.csv --threads 1");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("u.csv: could not be written completely"));
    EXPECT_EQ(read_text(folder_.path() / "u.csv"), "before");
    EXPECT_THAT(folder_.listing(), ElementsAre("scene.json", "u.csv"));
}

TEST_F(LimitsTest, WorksWithAStackOf4MB) {
    for (const char* method : {"fem", "constant-bem", "linear-bem"}) {
        folder_.write("scene.json", cube_scene(method, 6));
        for (const char* mode : {"on-demand", "full"}) {
            const ProgramRun result = run(
                "ulimit -s 4096", std::string("solve --quiet scene.json --mode ") + mode + " --displacements u.csv");
            if (result.exit_code == 1)  // who may not raise the hard limit is told
                EXPECT_NE(result.err.find("ulimit -s"), std::string::npos) << result.err;
            else
                EXPECT_EQ(result.exit_code, 0) << method << " " << mode << " " << result.err;
        }
    }
}

/// A limit of data, which does not count what is only read.
TEST_F(LimitsTest, SaysOutOfMemoryWhereDataIsLimited) {
    folder_.write("scene.json", cube_scene("linear-bem", 11));
    const int mib = 100;
    for (const char* arguments : {"solve --quiet scene.json", "info scene.json"}) {
        const ProgramRun result = run("ulimit -d " + std::to_string(mib * 1024), arguments);
        ASSERT_NE(result.exit_code, kTimedOut) << arguments;
        // What fits is computed, what does not is refused or ends with a word; nothing hangs.
        if (result.exit_code == 0) continue;
        EXPECT_EQ(result.exit_code, 1) << arguments;
        EXPECT_THAT(result.err, HasSubstr("emory")) << arguments;
    }
    EXPECT_EQ(run("ulimit -d 8000000", "solve --quiet scene.json").exit_code, 0);
}

/// Lists in lists take some twenty times the memory of their text; what there is of them is taken apart again.
TEST_F(LimitsTest, SaysOutOfMemoryInTheMiddleOfALargeScene) {
    std::string text = "{\"elastolab\": 1, \"fixed\": [";
    for (int i = 0; i < 1'500'000; ++i) text += "[[1]],";
    folder_.write("scene.json", text + "[1]]}");
    int n_refused = 0;
    for (const int mib : {300, 400, 500}) {
        const ProgramRun result = run("ulimit -v " + std::to_string(mib * 1024), "info scene.json");
        EXPECT_EQ(result.exit_code, 1) << mib << " " << result.err;
        n_refused += result.err.find("emory") != std::string::npos;
    }
    EXPECT_GT(n_refused, 0);
}

TEST_F(LimitsTest, TakesNoMoreThreadsThanThereAreCores) {
    folder_.write("scene.json", cube_scene("linear-bem", 2));
    const auto threads = [&] {
        const ProgramRun result = run("true", "solve --quiet scene.json --threads 900 --report r.json");
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return nlohmann::json::parse(read_text(folder_.path() / "r.json")).at("threads").get<int>();
    };
    EXPECT_EQ(threads(), available_cores());
    const OneCore one_core;
    EXPECT_EQ(threads(), 1);
}

TEST_F(LimitsTest, RefusesTwoOutputsInOneFile) {
    folder_.write("scene.json", cube_scene("linear-bem", 2));
    create_directory(folder_.path() / "m");
    const std::string solve = "solve --quiet scene.json --mode full --matrices m --displacements ";
    EXPECT_EQ(run("true", solve + "m/u.csv").exit_code, 0);
    const std::vector<std::string> before = folder_.listing();
    for (const std::string& name : before) {
        if (!name.ends_with(".npy")) continue;
        const ProgramRun result = run("true", solve + name);
        EXPECT_EQ(result.exit_code, 1) << name;
        EXPECT_THAT(result.err, HasSubstr("two outputs"));
    }
    EXPECT_EQ(folder_.listing(), before);
    const ProgramRun view = run("true", "view --hidden --frames 1 --scene-out x.obj --mesh-out ./x.obj");
    EXPECT_EQ(view.exit_code, 2);
    EXPECT_THAT(view.err, HasSubstr("twice"));
    std::filesystem::create_symlink("u.csv", folder_.path() / "link.csv");
    const ProgramRun link = run("true", "solve --quiet scene.json --displacements u.csv --fields link.csv");
    EXPECT_EQ(link.exit_code, 2) << "neither is there yet";
    EXPECT_THAT(link.err, HasSubstr("twice"));
}

TEST_F(LimitsTest, TheViewerWritesOverNothingThatItReadsOrWrites) {
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    const std::string scene = R"({"elastolab": 1, "mesh": {"file": "body.obj"}})";
    folder_.write("body.obj", mesh);
    folder_.write("scene.json", scene);
    folder_.write("log", "");
    const std::vector<std::pair<std::string, std::string>> all = {
        {"body.obj --scene-out body.obj", "input"},
        {"scene.json --scene-out body.obj", "input"},
        {"scene.json --timings body.obj", "input"},
        {"scene.json --mesh-out ./body.obj", "input"},
        {"scene.json --mesh-out a.obj --timings a.obj", "twice"},
        {"scene.json --picture a.png --turntable 2 --screenshot a-0001.png", "twice"},
        {"scene.json --picture a.png --pull-film 3 --timings a-0003.png", "twice"},
        {"scene.json --replay log --series s.pvd --mesh-out s-0007.vtp", "part of --series"},
        {"scene.json --picture a.jpg", ".png"},
        {"scene.json --screenshot a", ".png"},
        {"scene.json --mesh-out a.glb", "no handle"},
        {"body.obj --mesh-out a.glb", "no handle"},
        {"scene.json --method nonlinear-fem --mesh-out a.glb", "linear method"},
        {"scene.json --method galerkin-bem --mesh-out a.vtu", "tetrahedra"}};
    for (const auto& [arguments, why] : all) {
        const ProgramRun result = run("true", "view --hidden --frames 1 " + arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        EXPECT_THAT(result.err, HasSubstr(why)) << arguments;
    }
    EXPECT_EQ(read_text(folder_.path() / "body.obj"), mesh);
    EXPECT_EQ(read_text(folder_.path() / "scene.json"), scene);
    EXPECT_THAT(folder_.listing(), ElementsAre("body.obj", "log", "scene.json"));
    const ProgramRun deformed = run("true", "solve --quiet scene.json --mesh-out b.obj --deformed");
    EXPECT_EQ(deformed.exit_code, 2);
    EXPECT_THAT(deformed.err, HasSubstr("--deformed"));
}

}  // namespace
}  // namespace elastolab::test
