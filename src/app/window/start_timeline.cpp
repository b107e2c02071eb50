#include "app/window/start_timeline.hpp"

#include <unistd.h>

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>

#include "base/error.hpp"

namespace elastolab {

StartTimeline::StartTimeline(const std::filesystem::path& file) : file_(file) {
    if (!file_) throw Error(file.string() + ": cannot be written. Check the path.");
    file_ << "event,seconds\n" << std::fixed << std::setprecision(2) << std::flush;
}

void StartTimeline::mark(Event event) {
    if (std::exchange(marked_[event], true)) return;
    file_ << kNames[event] << ',' << process_seconds() << std::endl;
}

/// Both are counted from the start of the system: field 22 of stat in ticks, the first of uptime in seconds.
double process_seconds() {
    std::ifstream stat("/proc/self/stat"), uptime("/proc/uptime");
    std::string text;
    std::getline(stat, text);
    std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
    double began = 0.0, now = 0.0;
    for (int field = 3; field <= 21; ++field) fields >> text;
    if (!(fields >> began && uptime >> now)) return 0.0;
    return now - began / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace elastolab
