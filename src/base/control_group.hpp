#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>

namespace elastolab {

/// The control group of a process, from its /proc/PID/cgroup; "/" when there is none.
/// controller   "memory" or "cpu" for the hierarchy of version 1, empty for the unified one of version 2
std::string control_group_of(std::istream& proc_cgroup, const std::string& controller = "");

/// Bytes that a control group and all groups around it still let its processes take; the largest number when there is
/// no limit. File pages and kernel objects that the kernel gives up on demand do not count as used.
/// root    where the hierarchy is mounted (/sys/fs/cgroup; /sys/fs/cgroup/memory of version 1)
/// group   as control_group_of() gives it; inside a container it may lead out of what is mounted (/../..), and then the
///         mounted root counts
std::uint64_t control_group_available(const std::filesystem::path& root, const std::string& group);

/// Processor time that a control group and all groups around it let its processes take, in processors (cpu.max, or
/// cpu.cfs_quota_us of version 1); infinity when there is no quota. Arguments as above; /sys/fs/cgroup/cpu of
/// version 1.
double control_group_processors(const std::filesystem::path& root, const std::string& group);

}  // namespace elastolab
