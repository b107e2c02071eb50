#include "cli/interrupt.hpp"

#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "base/atomic_file.hpp"
#include "cli/program.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "support/helper_process.hpp"
#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves its declaration to us

namespace elastolab {
namespace {

constexpr int kReturned = 3;

/// A helper program that would go on for long.
pid_t start_helper() {
    std::array<char*, 3> arguments{const_cast<char*>("sleep"), const_cast<char*>("600"), nullptr};
    pid_t helper = -1;
    posix_spawnp(&helper, "sleep", nullptr, nullptr, arguments.data(), environ);
    return helper;
}

bool runs(pid_t process) {
    std::ostringstream text;
    text << std::ifstream("/proc/" + std::to_string(process) + "/stat").rdbuf();
    return !text.str().empty() && text.str().find(") Z ") == std::string::npos;
}

/// The exit code of a process that does this; minus the signal when one ended it.
template <class Action>
int exit_code_of(const Action& action) {
    const pid_t child = fork();
    if (child == 0) {
        action();
        _exit(kReturned);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(InterruptGuard, CancelsAndLetsTheComputationReturn) {
    EXPECT_EQ(exit_code_of([] {
                  Control control;
                  {
                      const InterruptGuard guard(control);
                      raise(SIGINT);
                      test::wait_until([&] { return control.cancelled(); });
                  }
                  usleep(1'500'000);
              }),
              kReturned);
}

/// A library that does not return must not keep the program: it ends, and leaves no half file and no helper behind.
TEST(InterruptGuard, EndsAComputationThatDoesNotReturn) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const test::TemporaryFolder folder;
        folder.write("out.csv", "before");
        const int code = exit_code_of([&] {
            Control control;
            AtomicFile out(folder.path() / "out.csv");
            out.stream() << "half" << std::flush;
            std::ofstream(folder.path() / "helper") << start_helper() << std::flush;
            const InterruptGuard guard(control, "Interrupted by force.");
            raise(signal);
            std::this_thread::sleep_for(std::chrono::seconds(100));
        });
        EXPECT_EQ(code, 128 + signal);
        EXPECT_EQ(test::read_text(folder.path() / "out.csv"), "before");
        EXPECT_THAT(folder.listing(), testing::ElementsAre("helper", "out.csv"));
        const pid_t helper = std::stoi(test::read_text(folder.path() / "helper"));
        EXPECT_TRUE(test::wait_until([&] { return !runs(helper); }));
    }
}

std::vector<pid_t> children_of(pid_t process) {
    std::vector<pid_t> all;
    std::error_code gone;
    for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task", gone)) {
        std::ifstream children(task.path() / "children");
        for (pid_t child = 0; children >> child;) all.push_back(child);
    }
    return all;
}

/// The program while its helper does not return: it is stopped.
class DuringImport : public testing::Test {
protected:
    DuringImport() { save_surface(folder_.path() / "large.obj", make_box(120)); }  // read in some tenths of a second
    void start(const std::vector<std::string>& arguments) {
        program_.emplace(arguments, folder_.path());
        ASSERT_TRUE(test::wait_until([&] { return program_->ended() || !children_of(program_->id()).empty(); }));
        ASSERT_FALSE(program_->ended()) << program_->wait().err;
        helper_ = children_of(program_->id()).at(0);
        ASSERT_TRUE(test::wait_until([&] { return test::helper_has_begun(helper_); }));
        kill(helper_, SIGSTOP);
    }
    void expect_helper_to_end() const {
        EXPECT_TRUE(test::wait_until([&] { return !runs(helper_); }, std::chrono::seconds(3)));
    }

    test::TemporaryFolder folder_;
    std::optional<test::RunningProgram> program_;
    pid_t helper_ = -1;
};

TEST_F(DuringImport, AnInterruptIsHeard) {
    folder_.write("scene.json", R"({"elastolab": 1, "mesh": {"file": "large.obj"}})");
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"info", "large.obj"}, {"info", "scene.json"}, {"solve", "scene.json"}})
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            start(arguments);
            kill(program_->id(), signal);
            const test::ProgramRun run = program_->wait();
            EXPECT_EQ(run.exit_code, 128 + signal) << arguments[0];
            EXPECT_EQ(run.err, "elastolab: Interrupted; no output was written.\n");
            EXPECT_EQ(run.out, "");
            expect_helper_to_end();
        }
}

TEST_F(DuringImport, TheHelperDiesWithTheProgram) {
    start({"info", "large.obj"});
    kill(program_->id(), SIGKILL);
    program_->wait();
    expect_helper_to_end();
}

}  // namespace
}  // namespace elastolab
