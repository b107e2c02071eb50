#include "base/processor_use.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace elastolab {

std::optional<ProcessorUse> processor_use() {
    std::ifstream stat("/proc/stat");
    std::string name;
    double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0, waiting = 0.0, interrupts = 0.0, soft = 0.0, stolen = 0.0;
    stat >> name >> user >> nice >> system >> idle >> waiting >> interrupts >> soft >> stolen;
    rusage usage{};
    if (!stat || name != "cpu" || getrusage(RUSAGE_SELF, &usage) != 0) return {};
    const double tick = 1.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return ProcessorUse{.all = tick * (user + nice + system + idle + waiting + interrupts + soft + stolen),
                        .idle = tick * (idle + waiting),
                        .own = seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

double slowdown_by_others(const ProcessorUse& before, const ProcessorUse& after) {
    const double all = after.all - before.all;
    if (!(all > 0.0)) return 1.0;
    const double idle = (after.idle - before.idle) / all, own = (after.own - before.own) / all;
    const double others = std::clamp(1.0 - idle - own, 0.0, 1.0);
    constexpr double kHardlyAny = 0.1;
    // Others go on with what they do beside a program that wants all processors: each gets its share of the sum. With
    // nothing idle they may want more than can be seen, unless this program competes with them already.
    if (idle > kHardlyAny || own < kHardlyAny) return 1.0 + others;
    return std::min(1.0 / (1.0 - others), kMostSlowdown);
}

}  // namespace elastolab
