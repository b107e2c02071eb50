#include "cli/interrupt.hpp"

#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "base/atomic_file.hpp"
#include "support/temporary_folder.hpp"

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
                      while (!control.cancelled()) usleep(1000);
                  }
                  usleep(1'500'000);
              }),
              kReturned);
}

/// A library that does not return must not keep the program: it ends, and leaves no half file and no helper behind.
TEST(InterruptGuard, EndsAComputationThatDoesNotReturn) {
    for (const int signal : {SIGINT, SIGTERM}) {
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
        for (int i = 0; i < 1000 && runs(helper); ++i) usleep(10'000);
        EXPECT_FALSE(runs(helper));
    }
}

}  // namespace
}  // namespace elastolab
