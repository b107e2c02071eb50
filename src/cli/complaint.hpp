#pragma once

#include <functional>
#include <string>

namespace elastolab {

inline constexpr int kSuccess = 0, kFailure = 1, kBadUsage = 2;

/// What lines on standard error begin with: "elastolab", until another program says its own name at its start.
const std::string& program_name();
void set_program_name(std::string name);

/// Prints the program's name and the text as one line on standard error. Returns the exit code.
int complain(const std::string& text, int exit_code);

/// Runs a command line and returns its exit code. What it throws becomes a complaint, or is kept silent: where other
/// processes of the program say it.
int exit_code_of(const std::function<int()>& run, bool silent = false);

}  // namespace elastolab
