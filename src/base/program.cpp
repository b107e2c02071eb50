#include "base/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>

#include "base/error.hpp"
#include "base/file_descriptor.hpp"

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestLog = 4096;
constexpr auto kLookEvery = std::chrono::milliseconds(10);

/// Reads what is there, and keeps the end of it.
void listen(const FileDescriptor& from, std::string& log) {
    std::array<char, 1024> part{};
    for (ssize_t n = 0; (n = read(from.get(), part.data(), part.size())) > 0;)
        log.append(part.data(), static_cast<std::size_t>(n));
    if (log.size() > kLongestLog) log.erase(0, log.size() - kLongestLog);
}

pid_t start_program(const fs::path& program, const std::vector<std::string>& arguments, int output) {
    std::vector<std::string> words = {program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    pid_t process = -1;
    const int failure = posix_spawn(&process, program.c_str(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
        throw Error(program.string() + ": cannot be started (" + std::strerror(failure) + "). Install it again.");
    return process;
}

}  // namespace

std::optional<fs::path> find_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path candidate = fs::path(folder.empty() ? "." : folder) / name;
        std::error_code error;
        if (fs::is_regular_file(candidate, error) && access(candidate.c_str(), X_OK) == 0) return candidate;
    }
    return std::nullopt;
}

int run_program(const fs::path& program, const std::vector<std::string>& arguments, std::string& log,
                Control& control) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Error(program.string() + ": cannot be started (" + std::strerror(errno) + "). Try again.");
    const FileDescriptor reading(ends[0]);
    FileDescriptor writing(ends[1]);
    fcntl(reading.get(), F_SETFL, O_NONBLOCK);
    const pid_t process = start_program(program, arguments, writing.get());
    writing.reset();
    int status = 0;
    while (waitpid(process, &status, WNOHANG) == 0) {
        if (control.cancelled()) {
            kill(process, SIGKILL);
            waitpid(process, &status, 0);
            throw Cancelled{};
        }
        listen(reading, log);
        std::this_thread::sleep_for(kLookEvery);
    }
    listen(reading, log);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace elastolab
