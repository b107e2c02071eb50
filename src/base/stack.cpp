#include "base/stack.hpp"

#include <sys/resource.h>
#include <algorithm>

#include "base/error.hpp"
#include "base/restart.hpp"
#include "base/text.hpp"

namespace elastolab {

void ensure_stack(char** argv) {
    constexpr rlim_t kNeeded = rlim_t{8} << 20;
    rlimit limit{};
    if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= kNeeded) return;
    const rlim_t before = limit.rlim_cur;
    limit.rlim_cur = kNeeded;
    if (limit.rlim_max != RLIM_INFINITY) limit.rlim_max = std::max(limit.rlim_max, kNeeded);
    if (setrlimit(RLIMIT_STACK, &limit) != 0)
        throw Error("stack: limited to " + readable_bytes(static_cast<double>(before)) +
                    ", linear algebra on several threads needs 8 MiB. Raise it, as by 'ulimit -s 8192'.");
    restart(argv);  // returns only where it fails; the main thread has its larger stack all the same
}

}  // namespace elastolab
