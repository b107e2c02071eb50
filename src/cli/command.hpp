#pragma once

#include <functional>
#include <iosfwd>
#include <stdexcept>

#include "deform/method.hpp"

namespace CLI {
class App;
}

namespace elastolab {

struct Solution;

/// A command line that is not valid: exit code 2.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Thrown after Ctrl-C by a command that has already said what was kept; others let Cancelled through.
class Interrupted : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A subcommand: its place in the parser, and what it does once its options are parsed. `run` throws UsageError, Error,
/// Interrupted or Cancelled; main turns these into words and exit codes.
struct Command {
    CLI::App* parser = nullptr;
    std::function<void()> run;
};

/// What a program other than `elastolab` does differently in the command `solve`.
struct SolveVariant {
    /// The method that solves in place of the one chosen. Throws UsageError.
    std::function<MethodKind(MethodKind)> method = {};
    /// Adds lines to the summary.
    std::function<void(std::ostream&, const Solution&)> summary = {};
};

/// Each adds itself to the program's parser. A new subcommand is one source file, one line here and one in main.cpp.
Command add_solve_command(CLI::App& program, SolveVariant variant = {});
Command add_info_command(CLI::App& program);
Command add_view_command(CLI::App& program);
Command add_bench_command(CLI::App& program);
Command add_feel_command(CLI::App& program);
Command add_thumbnail_command(CLI::App& program);

}  // namespace elastolab
