#include <gtest/gtest.h>
#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>

#include "mesh/checks/check.hpp"
#include "mesh/input/export.hpp"
#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "support/helper_process.hpp"
#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

/// Stops the helper of this process, as if a library did not return; false when there is none that has begun.
bool stop_helper() {
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        pid_t child = 0;
        if (std::ifstream(task.path() / "children") >> child && test::helper_has_begun(child))
            return kill(child, SIGSTOP) == 0;
    }
    return false;
}

TEST(Import, CanBeCancelledWhileALibraryDoesNotReturn) {
    const test::TemporaryFolder folder;
    save_surface(folder.path() / "large.obj", make_box(120));  // some tenths of a second
    Control control;
    auto import = std::async(std::launch::async, [&] { import_surface(folder.path() / "large.obj", control); });
    ASSERT_TRUE(test::wait_until(stop_helper));
    EXPECT_EQ(import.wait_for(std::chrono::milliseconds(500)), std::future_status::timeout);
    control.cancel();
    EXPECT_THROW(import.get(), Cancelled);
}

TEST(Check, CanBeCancelled) {
    Control control;
    control.cancel();
    EXPECT_THROW(check_and_repair(make_box(2), control), Cancelled);
}

}  // namespace
}  // namespace elastolab
