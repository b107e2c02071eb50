#pragma once

// For the helper programs only: their side of the socket to the caller (mesh/input/child_process.hpp), and how they
// begin.

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <vector>

namespace elastolab {

constexpr int kHelperMisused = 64;  ///< exit code

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

/// The helper ends with its caller, leaves Ctrl-C to it, dumps no core, is the first to go when memory runs out, and
/// loses nothing that a library printed before a crash.
inline void begin_helper() {
    std::signal(SIGINT, SIG_IGN);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    pollfd caller{STDIN_FILENO, 0, 0};
    if (::poll(&caller, 1, 0) > 0) std::_Exit(kHelperMisused);  // the caller had died before the request above
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    std::ofstream("/proc/self/oom_score_adj") << 1000;
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
}

/// Of the processor; then SIGXCPU ends the helper.
inline void limit_seconds(std::int32_t seconds) {
    const auto soft = static_cast<rlim_t>(seconds);
    const rlimit cpu{soft, soft + 1};
    ::setrlimit(RLIMIT_CPU, &cpu);
}

inline void read_bytes(void* data, std::size_t size) {
    for (auto* to = static_cast<std::byte*>(data); size > 0;) {
        const ssize_t n = ::read(STDIN_FILENO, to, size);
        if (n <= 0) std::_Exit(kHelperMisused);
        to += n;
        size -= static_cast<std::size_t>(n);
    }
}

inline void write_bytes(const void* data, std::size_t size) {
    for (const auto* from = static_cast<const std::byte*>(data); size > 0;) {
        const ssize_t n = ::write(STDIN_FILENO, from, size);
        if (n <= 0) std::_Exit(kHelperMisused);
        from += n;
        size -= static_cast<std::size_t>(n);
    }
}

template <class T>
std::vector<T> read_array(std::int32_t count) {
    if (count < 0 || count > std::numeric_limits<std::int32_t>::max() / 4) std::_Exit(kHelperMisused);
    std::vector<T> values(static_cast<std::size_t>(count));
    read_bytes(values.data(), values.size() * sizeof(T));
    return values;
}

}  // namespace elastolab
