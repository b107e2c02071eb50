#include "base/control_group.hpp"

#include <algorithm>
#include <fstream>
#include <limits>

namespace elastolab {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();
constexpr double kNoQuota = std::numeric_limits<double>::infinity();

/// kUnlimited for "max" and for a file that is not there.
std::uint64_t read_number(const fs::path& path) {
    std::ifstream file(path);
    std::uint64_t value = 0;
    return file >> value ? value : kUnlimited;
}

/// What the kernel takes back before it refuses anything: file pages that were not used of late, and its own caches.
/// Version 1 counts those of the groups inside under another name.
std::uint64_t reclaimable(const fs::path& group, bool first_version) {
    std::ifstream file(group / "memory.stat");
    std::string key;
    std::uint64_t value = 0, sum = 0;
    while (file >> key >> value)
        if (key == (first_version ? "total_inactive_file" : "inactive_file") || key == "slab_reclaimable") sum += value;
    return sum;
}

/// One group alone. Above memory.high the kernel slows a process down until nothing moves, so it counts as a limit.
std::uint64_t available_in(const fs::path& group) {
    std::uint64_t limit = std::min(read_number(group / "memory.max"), read_number(group / "memory.high"));
    std::uint64_t current = read_number(group / "memory.current");
    const bool first_version = current == kUnlimited;
    if (first_version) {
        limit = read_number(group / "memory.limit_in_bytes");
        current = read_number(group / "memory.usage_in_bytes");
    }
    if (limit == kUnlimited || current == kUnlimited) return kUnlimited;
    const std::uint64_t used = current - std::min(current, reclaimable(group, first_version));
    return limit - std::min(limit, used);
}

/// The quota of one group alone, in processors.
double processors_in(const fs::path& group) {
    std::ifstream both(group / "cpu.max");
    double quota = 0.0, period = 0.0;
    if (!(both >> quota >> period)) {  // "max", or version 1, where -1 is no quota
        std::ifstream quota_file(group / "cpu.cfs_quota_us"), period_file(group / "cpu.cfs_period_us");
        if (!(quota_file >> quota && period_file >> period)) return kNoQuota;
    }
    return quota > 0.0 && period > 0.0 ? quota / period : kNoQuota;
}

/// The least of `of` the groups from the root down to this one.
template <class Of>
auto least_on_the_way(const fs::path& root, const std::string& group, const Of& of) {
    auto least = of(root);
    fs::path inside = root;
    for (const fs::path& part : fs::path(group).relative_path()) {
        if (part == "..") break;
        least = std::min(least, of(inside /= part));
    }
    return least;
}

}  // namespace

std::string control_group_of(std::istream& proc_cgroup, const std::string& controller) {
    const std::string key = ":" + controller + ":/";
    for (std::string line; std::getline(proc_cgroup, line);) {
        const std::size_t colon = line.find(':');  // behind the number of the hierarchy
        if (colon != std::string::npos && line.compare(colon, key.size(), key) == 0)
            return line.substr(colon + key.size() - 1);
    }
    return "/";
}

std::uint64_t control_group_available(const fs::path& root, const std::string& group) {
    return least_on_the_way(root, group, available_in);
}

double control_group_processors(const fs::path& root, const std::string& group) {
    return least_on_the_way(root, group, processors_in);
}

}  // namespace elastolab
