#include "mesh/input/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <system_error>
#include <thread>

#include "base/error.hpp"
#include "base/program.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves its declaration to us

namespace elastolab {

namespace {

[[noreturn]] void fail_to_start(const std::filesystem::path& program, int error) {
    throw MeshError(program.string() + ": this helper program cannot be started (" +
                    std::generic_category().message(error) + "). Reinstall elastolab or free some memory.");
}

/// Descriptors and signals that the new process begins with.
class SpawnSettings {
public:
    SpawnSettings(int input, int output) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, output, STDERR_FILENO);
        posix_spawnattr_init(&attributes_);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    const posix_spawn_file_actions_t* actions() const { return &actions_; }
    const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

}  // namespace

std::filesystem::path helper_program(const std::string& name) {
    std::error_code ignored;
    const auto beside = std::filesystem::read_symlink("/proc/self/exe", ignored).replace_filename(name);
    for (const auto& candidate : {beside, std::filesystem::path(ELASTOLAB_HELPER_DIR) / name})
        if (std::filesystem::is_regular_file(candidate, ignored)) return candidate;
    if (const std::optional<std::filesystem::path> found = find_program(name)) return *found;
    throw MeshError(beside.string() + ": this helper program is missing. Reinstall elastolab.");
}

ChildProcess::Descriptor::~Descriptor() {
    if (fd >= 0) ::close(fd);
}

ChildProcess::ChildProcess(const std::filesystem::path& program) {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail_to_start(program, errno);
    socket_.fd = ends[0];
    Descriptor theirs;
    theirs.fd = ends[1];
    output_.fd = ::memfd_create("elastolab-helper-output", MFD_CLOEXEC);
    if (output_.fd < 0 || ::fcntl(socket_.fd, F_SETFL, O_NONBLOCK) != 0) fail_to_start(program, errno);
    ::fcntl(output_.fd, F_SETFL, O_APPEND);  // so that standard output and error do not overwrite each other
    start(program, theirs.fd);
}

void ChildProcess::start(const std::filesystem::path& program, int socket) {
    const SpawnSettings settings(socket, output_.fd);
    std::string path = program.string();
    std::array<char*, 2> arguments{path.data(), nullptr};
    const int error =
        ::posix_spawn(&process_, path.c_str(), settings.actions(), settings.attributes(), arguments.data(), environ);
    if (error != 0) {
        process_ = -1;
        fail_to_start(program, error);
    }
}

ChildProcess::~ChildProcess() {
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

/// Whether the socket is ready within 20 ms.
bool ChildProcess::wait_for(short events, Control& control) const {
    control.checkpoint();
    pollfd ready{socket_.fd, events, 0};
    return ::poll(&ready, 1, 20) > 0;
}

std::vector<char> ChildProcess::exchange(std::string_view request, Control& control, std::size_t most,
                                         const std::function<void(const std::vector<char>&)>& on_reply) {
    while (!request.empty()) {
        if (!wait_for(POLLOUT, control)) continue;
        const ssize_t n = ::send(socket_.fd, request.data(), request.size(), MSG_NOSIGNAL);
        if (n > 0) request.remove_prefix(static_cast<std::size_t>(n));
        if (n < 0 && errno != EAGAIN && errno != EINTR) break;  // it has died; what it said still counts
    }
    std::vector<char> reply, block(std::size_t{1} << 16);
    while (true) {
        if (!wait_for(POLLIN, control)) continue;
        const ssize_t n = ::recv(socket_.fd, block.data(), block.size(), 0);
        if (n > 0) reply.insert(reply.end(), block.begin(), block.begin() + n);
        if (n > 0 && on_reply) on_reply(reply);
        if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) return reply;
        if (reply.size() > most) {
            ::kill(process_, SIGKILL);
            return reply;
        }
    }
}

int ChildProcess::wait(Control& control) {
    using namespace std::chrono_literals;
    while (true) {
        int status = 0;
        const pid_t ended = ::waitpid(process_, &status, WNOHANG);
        if (ended == process_ || (ended < 0 && errno != EINTR)) {
            process_ = -1;
            return status;
        }
        control.checkpoint();
        std::this_thread::sleep_for(1ms);
    }
}

std::string ChildProcess::output() const {
    struct stat info {};
    if (::fstat(output_.fd, &info) != 0) return {};
    const off_t size = std::min<off_t>(info.st_size, 1 << 16);
    std::string text(static_cast<std::size_t>(size), '\0');
    const ssize_t n = ::pread(output_.fd, text.data(), text.size(), info.st_size - size);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    return text;
}

}  // namespace elastolab
