#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elastolab::fuzz {

/// A command, and how much it may take.
struct Command {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::filesystem::path folder;    ///< where it runs; also its home
    double cpu_seconds = 10.0;       ///< ended beyond this, by itself or by a process that it started
    double stuck_seconds = 15.0;     ///< ended when none of its threads has run for so long
    double longest_seconds = 600.0;  ///< ended in any case: on a machine under load nothing small takes so long
    std::size_t memory = 6UL << 30;  ///< bytes of data that one process may have
};

/// What a run left behind.
struct Run {
    int exit_code = -1;
    int signal = 0;            ///< that ended it; 0: none
    bool stuck = false;        ///< it was ended because it slept or woke for ever
    double cpu_seconds = 0.0;  ///< of all its processes
    double peak_memory = 0.0;  ///< bytes, of the largest of them
    std::string out, err;
};

/// Runs a command to its end with a thread for each parallel region, nothing to read, and nobody who watches. Time is
/// that of the processor, so that it does not matter how loaded the machine is. Throws std::system_error.
Run run(const Command& command);

}  // namespace elastolab::fuzz
