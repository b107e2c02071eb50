#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace elastolab::test {

/// What a run of the program left behind.
struct ProgramRun {
    int exit_code = -1;  ///< minus the signal when one ended it
    std::string out, err;
};

/// The real program while it runs. It is killed at the end unless it ended before.
class RunningProgram {
public:
    /// Starts it with these arguments, in `folder`.
    RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    pid_t id() const { return id_; }
    bool ended();
    /// Waits for its end.
    ProgramRun wait();

private:
    TemporaryFolder outputs_;
    pid_t id_ = -1;
    std::optional<int> status_;
};

/// Runs the real program with these arguments, in `folder`.
ProgramRun run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// The same, sending it SIGINT as soon as it handles that signal.
ProgramRun interrupt_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// A CSV file: its header, and a number for every field but those of the first column.
struct Table {
    std::string header;
    std::vector<std::string> labels;
    std::vector<std::vector<double>> rows;
};
Table read_csv(const std::filesystem::path& file);

/// A .npy file of two dimensions, as written by solve.
struct NpyFile {
    int rows = 0, columns = 0;
    std::vector<double> values;  ///< column-major
    double operator()(int row, int column) const {
        return values[static_cast<std::size_t>(column) * static_cast<std::size_t>(rows) +
                      static_cast<std::size_t>(row)];
    }
};
NpyFile read_npy(const std::filesystem::path& file);

/// A unit cube of `cells` cells, its left face fixed and its right face moved by (0.1, 0, 0.05), as a scene file's
/// text.
std::string cube_scene(const std::string& method, int cells = 4);

}  // namespace elastolab::test
