#include "cli/program.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

/// It sets variables that libraries read as they are loaded, and begins anew.
TEST(Program, KeepsItsNameWhenItBeginsAnew) {
    constexpr const char* kVariable = "OMP_WAIT_POLICY";
    const test::TemporaryFolder folder;
    folder.write("scene.json", test::cube_scene("galerkin-bem", 16));
    unsetenv(kVariable);  // this process has done so, too
    test::RunningProgram program({"solve", "scene.json"}, folder.path());
    setenv(kVariable, "passive", 1);
    const std::filesystem::path process = "/proc/" + std::to_string(program.id());
    const auto has_begun_anew = [&] {
        std::error_code error;
        return std::filesystem::read_symlink(process / "exe", error).filename() == "elastolab" &&
               test::read_text(process / "environ").find(kVariable) != std::string::npos;
    };
    test::wait_for([&] { return has_begun_anew() || program.ended(); });
    EXPECT_TRUE(has_begun_anew());
    EXPECT_EQ(test::read_text(process / "comm"), "elastolab\n");
}

TEST(Program, HelpsAndTellsItsVersion) {
    const std::vector<std::vector<std::string>> commands = {
        {"--help"}, {"view", "--help"}, {"solve", "--help"}, {"info", "--help"}};
    for (const auto& arguments : commands) {
        const test::ProgramRun run = test::run_program(arguments, ".");
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_THAT(run.out, testing::HasSubstr("Usage"));
        EXPECT_THAT(run.err, testing::IsEmpty());
    }
    EXPECT_THAT(test::run_program({"--version"}, ".").out, testing::StartsWith("elastolab "));
}

TEST(Program, TakesAFileWithoutACommandForTheViewer) {
    const test::TemporaryFolder folder;
    folder.write("scene.json", test::cube_scene("fem", 2));
    const test::ProgramRun viewer = test::run_program({"scene.json", "--hidden"}, folder.path());
    EXPECT_EQ(viewer.exit_code, 2);
    EXPECT_THAT(viewer.err, testing::HasSubstr("--hidden: nobody could close that window"));

    folder.write("info", "a file with the name of a command");
    EXPECT_EQ(test::run_program({"info", "scene.json"}, folder.path()).exit_code, 0);

    const test::ProgramRun typo = test::run_program({"solv", "scene.json"}, folder.path());
    EXPECT_EQ(typo.exit_code, 2);
    EXPECT_EQ(typo.err, "elastolab: solv: neither a command nor a file. See elastolab --help.\n");
}

}  // namespace
}  // namespace elastolab
