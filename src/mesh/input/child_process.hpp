#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/control.hpp"

namespace elastolab {

/// Path of a helper program: beside the running program (installed), where the build has put it (tests, programs run
/// from the build tree), or on $PATH (the Python module, whose running program is the interpreter). Throws MeshError
/// when it is in neither place.
std::filesystem::path helper_program(const std::string& name);

/// A program of ours that runs in a process of its own, with a socket as its standard input (both ways) and its
/// standard output and error kept in memory. The destructor kills it if it still runs. Started by posix_spawn, not by a
/// bare fork: the program has threads that may hold locks at that moment.
class ChildProcess {
public:
    /// Throws MeshError when it cannot be started.
    explicit ChildProcess(const std::filesystem::path& program);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Sends these bytes, then receives until the process closes its end. Checks for cancellation every 20 ms. A
    /// process that dies early just answers less; one that answers more than `most` bytes is not listened to further.
    /// on_reply: shown what has come so far whenever something comes.
    std::vector<char> exchange(std::string_view request, Control& control,
                               std::size_t most = std::numeric_limits<std::size_t>::max(),
                               const std::function<void(const std::vector<char>&)>& on_reply = {});
    /// Waits for its end; the status as of waitpid. Checks for cancellation every few milliseconds.
    int wait(Control& control);
    /// What it has printed, at most the last 64 kB.
    std::string output() const;

private:
    /// A file descriptor, closed at the end.
    struct Descriptor {
        int fd = -1;
        Descriptor() = default;
        ~Descriptor();
        Descriptor(const Descriptor&) = delete;
        Descriptor& operator=(const Descriptor&) = delete;
    };
    void start(const std::filesystem::path& program, int socket);
    bool wait_for(short events, Control& control) const;

    Descriptor socket_, output_;
    pid_t process_ = -1;
};

}  // namespace elastolab
