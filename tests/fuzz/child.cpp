#include "fuzz/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

namespace elastolab::fuzz {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

class Descriptor {
public:
    explicit Descriptor(int fd, const char* what) : fd_(fd) {
        if (fd_ < 0) fail(what);
    }
    ~Descriptor() { close(fd_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    operator int() const { return fd_; }

private:
    int fd_;
};

/// A file in memory that takes what a process prints.
class Output {
public:
    Output() : fd_(memfd_create("output", MFD_CLOEXEC), "memfd_create") {}
    int fd() const { return fd_; }
    std::string text() const {
        constexpr off_t kMost = 1 << 22;
        struct stat status {};
        fstat(fd_, &status);
        std::string text(static_cast<std::size_t>(std::min(status.st_size, kMost)), '\0');
        const ssize_t n = pread(fd_, text.data(), text.size(), 0);
        text.resize(n < 0 ? 0 : static_cast<std::size_t>(n));
        return text;
    }

private:
    Descriptor fd_;
};

std::vector<std::string> environment(const fs::path& folder) {
    std::vector<std::string> variables = {"HOME=" + folder.string(),
                                          "XDG_CONFIG_HOME=" + folder.string(),
                                          "XDG_STATE_HOME=" + folder.string(),
                                          "OMP_NUM_THREADS=1",
                                          "OPENBLAS_NUM_THREADS=1",
                                          "LP_NUM_THREADS=1",
                                          "LC_ALL=C.UTF-8"};
    for (const char* name : {"PATH", "DISPLAY", "XAUTHORITY", "TMPDIR", "ASAN_OPTIONS", "UBSAN_OPTIONS"})
        if (const char* value = std::getenv(name)) variables.push_back(std::string(name) + "=" + value);
    return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    for (std::string& text : texts) result.push_back(text.data());
    result.push_back(nullptr);
    return result;
}

void set_limit(__rlimit_resource resource, double value) {
    const rlimit limit{static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
    setrlimit(resource, &limit);
}

/// Only calls that are allowed between fork and exec of a program with threads.
[[noreturn]] void become(const Command& command, char* const* arguments, char* const* variables, int out, int err) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setpgid(0, 0);
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_CPU, std::ceil(command.cpu_seconds));
    set_limit(RLIMIT_DATA, static_cast<double>(command.memory));
    const int nothing = open("/dev/null", O_RDONLY);
    if (dup2(nothing, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 && dup2(err, STDERR_FILENO) >= 0 &&
        chdir(command.folder.c_str()) == 0)
        execve(arguments[0], arguments, variables);
    _exit(127);
}

pid_t start(const Command& command, const Output& out, const Output& err) {
    std::vector<std::string> words = command.arguments;
    words.insert(words.begin(), command.program.string());
    std::vector<std::string> variables = environment(command.folder);
    const std::vector<char*> argv = pointers(words), envp = pointers(variables);
    const pid_t child = fork();
    if (child < 0) fail("fork");
    if (child == 0) become(command, argv.data(), envp.data(), out.fd(), err.fd());
    return child;
}

/// What a process and those below it do.
struct Activity {
    double cpu_ticks = 0.0;
    bool runs = false;  ///< or waits for a disk or a processor
};

void look_at(pid_t process, Activity& activity) {
    std::error_code gone;
    for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(process) + "/task", gone)) {
        std::string stat;
        std::getline(std::ifstream(task.path() / "stat"), stat);
        std::istringstream rest(stat.substr(std::min(stat.rfind(')'), stat.size() - 1) + 1));
        const std::vector<std::string> fields{std::istream_iterator<std::string>(rest), {}};
        if (fields.size() < 13) continue;
        activity.runs |= fields[0] == "R" || fields[0] == "D";
        activity.cpu_ticks += std::stod(fields[11]) + std::stod(fields[12]);
        std::ifstream children(task.path() / "children");
        for (pid_t child = 0; children >> child;) look_at(child, activity);
    }
}

/// Whether a process does nothing at all, look after look.
class SleepWatch {
public:
    bool asleep_for(pid_t process, double seconds) {
        Activity now;
        look_at(process, now);
        if (now.runs || now.cpu_ticks != ticks_) since_ = Clock::now();
        ticks_ = now.cpu_ticks;
        return std::chrono::duration<double>(Clock::now() - since_).count() > seconds;
    }

private:
    double ticks_ = -1.0;
    Clock::time_point since_ = Clock::now();
};

/// Returns when the process has ended; true when that was by our hand.
bool wait_watching(pid_t child, const Command& command) {
    const Descriptor handle(static_cast<int>(syscall(SYS_pidfd_open, child, 0)), "pidfd_open");
    SleepWatch watch;
    int n_looks = 0;  // each a second
    for (pollfd ended{handle, POLLIN, 0}; poll(&ended, 1, 1000) == 0;) {
        if (!watch.asleep_for(child, command.stuck_seconds) && ++n_looks < command.longest_seconds) continue;
        kill(-child, SIGKILL);
        return true;
    }
    return false;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Run run(const Command& command) {
    const Output out, err;
    const pid_t child = start(command, out, err);
    Run result;
    result.stuck = wait_watching(child, command);
    int status = 0;
    rusage usage{};
    if (wait4(child, &status, 0, &usage) != child) fail("wait4");
    kill(-child, SIGKILL);  // helpers that it left behind
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    result.peak_memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
    result.out = out.text();
    result.err = err.text();
    return result;
}

}  // namespace elastolab::fuzz
