#include "study/peak_memory.hpp"

#include <fstream>
#include <limits>
#include <string>

#include "base/memory.hpp"

namespace elastolab {

namespace {

double status_bytes(const std::string& key) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(key + ":")) return 1024.0 * std::stod(line.substr(key.size() + 1));
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

PeakMemory::PeakMemory() {
    return_freed_memory();
    std::ofstream("/proc/self/clear_refs") << "5";  // resets VmHWM (proc(5))
    before_ = status_bytes("VmRSS");
}

double PeakMemory::bytes() const { return status_bytes("VmHWM") - before_; }

}  // namespace elastolab
