#pragma once

#include "cli/command.hpp"

namespace elastolab {

/// The command `grow`: solves a cube of a structured grid, which every process makes its own part of, and prints what
/// that took as a line of CSV. For measuring alone. Unlike solve it runs on all processes.
Command add_growth_command(CLI::App& program);

}  // namespace elastolab
