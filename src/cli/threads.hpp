#pragma once

namespace CLI {
class App;
}

namespace elastolab {

/// The option --threads, of several commands.
void add_threads_option(CLI::App& parser, int& threads);
/// Applies it: as many threads as it says, or as there are cores (available_cores()) if it says more (they would only
/// disturb each other) or nothing (0).
void apply_threads_option(int threads);

}  // namespace elastolab
