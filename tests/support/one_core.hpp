#pragma once

#include <sched.h>

namespace elastolab::test {

/// While it lives, this thread and the programs that it starts may use one core, the first of those that it could.
class OneCore {
public:
    OneCore() {
        sched_getaffinity(0, sizeof(before_), &before_);
        int first = 0;
        while (first + 1 < CPU_SETSIZE && !CPU_ISSET(first, &before_)) ++first;
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(first, &one);
        sched_setaffinity(0, sizeof(one), &one);
    }
    ~OneCore() { sched_setaffinity(0, sizeof(before_), &before_); }
    OneCore(const OneCore&) = delete;
    OneCore& operator=(const OneCore&) = delete;

private:
    cpu_set_t before_{};
};

}  // namespace elastolab::test
