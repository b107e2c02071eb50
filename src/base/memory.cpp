#include "base/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "base/control_group.hpp"

namespace elastolab {

namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

std::uint64_t system_available() {
    std::ifstream file("/proc/meminfo");
    std::string key;
    std::uint64_t kib = 0;
    std::string unit;
    while (file >> key >> kib && std::getline(file, unit))
        if (key == "MemAvailable:") return kib * 1024;
    return kNoLimit;
}

std::uint64_t own_groups_available() {
    std::ifstream unified("/proc/self/cgroup"), first_version("/proc/self/cgroup");
    return std::min(control_group_available("/sys/fs/cgroup", control_group_of(unified)),
                    control_group_available("/sys/fs/cgroup/memory", control_group_of(first_version, "memory")));
}

std::uint64_t left_of(rlim_t limit, std::uint64_t used_pages) {
    if (limit == RLIM_INFINITY) return kNoLimit;
    const std::uint64_t used = used_pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return limit > used ? limit - used : 0;
}

/// What the limits of the address space and of data in it (ulimit -v, ulimit -d) leave.
std::uint64_t address_space_available() {
    rlimit space{RLIM_INFINITY, RLIM_INFINITY}, data = space;
    getrlimit(RLIMIT_AS, &space);
    getrlimit(RLIMIT_DATA, &data);
    std::ifstream statm("/proc/self/statm");
    std::uint64_t all = 0, resident = 0, shared = 0, text = 0, libraries = 0, written = 0;
    if (!(statm >> all >> resident >> shared >> text >> libraries >> written)) return kNoLimit;
    return std::min(left_of(space.rlim_cur, all), left_of(data.rlim_cur, written));
}

}  // namespace

std::uint64_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t resident_memory_bytes() {
    std::ifstream statm("/proc/self/statm");
    std::uint64_t all = 0, resident = 0;
    if (!(statm >> all >> resident)) return 0;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t available_memory_bytes() {
    return std::min({system_available(), own_groups_available(), address_space_available()});
}

void return_freed_memory() { malloc_trim(0); }

}  // namespace elastolab
