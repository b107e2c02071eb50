#include "base/machine.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

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

Machine this_machine() {
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    return {.cpu = cpu_model(), .cores = cores, .memory_bytes = installed_memory()};
}

}  // namespace elastolab
