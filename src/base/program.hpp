#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/control.hpp"

namespace elastolab {

/// Where the shell would find a program of this name ($PATH); nothing where it is not installed.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a third-party program without a terminal and waits for its end; its output is kept in `log` (at most the last
/// 4 kB). Returns its exit code, or 128 + the signal that ended it. A cancel kills it. Throws Error where it cannot be
/// started, Cancelled.
int run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments, std::string& log,
                Control& control);

}  // namespace elastolab
