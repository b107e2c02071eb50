#include "base/memory.hpp"

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

std::uint64_t read_number(const char* path) {
    std::ifstream file(path);
    std::uint64_t value = 0;
    return file >> value ? value : kNoLimit;
}

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

/// What the limit of the address space (ulimit -v) leaves.
std::uint64_t address_space_available() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
    const std::uint64_t pages = read_number("/proc/self/statm");
    if (pages == kNoLimit) return kNoLimit;
    const std::uint64_t used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return limit.rlim_cur > used ? limit.rlim_cur - used : 0;
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

}  // namespace elastolab
