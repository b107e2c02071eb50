#include "base/machine.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include "base/control_group.hpp"

namespace elastolab {

namespace {

std::string cpu_model() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

std::uint64_t installed_memory() {
    const long pages = sysconf(_SC_PHYS_PAGES), page_size = sysconf(_SC_PAGESIZE);
    return pages > 0 && page_size > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size) : 0;
}

}  // namespace

int available_cores() {
    cpu_set_t allowed;
    const bool known = sched_getaffinity(0, sizeof(allowed), &allowed) == 0;  // not on more than 1024 cores
    const int n = known ? CPU_COUNT(&allowed) : static_cast<int>(std::thread::hardware_concurrency());
    std::ifstream unified("/proc/self/cgroup"), first_version("/proc/self/cgroup");
    const double quota =
        std::min(control_group_processors("/sys/fs/cgroup", control_group_of(unified)),
                 control_group_processors("/sys/fs/cgroup/cpu", control_group_of(first_version, "cpu")));
    return std::max(1, static_cast<int>(std::min<double>(n, std::ceil(quota))));
}

Machine this_machine() { return {.cpu = cpu_model(), .cores = available_cores(), .memory_bytes = installed_memory()}; }

}  // namespace elastolab
