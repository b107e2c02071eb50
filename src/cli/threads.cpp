#include "cli/threads.hpp"

#include <algorithm>
#include <CLI/CLI.hpp>

#include "base/blas.hpp"

namespace elastolab {

void add_threads_option(CLI::App& parser, int& threads) {
    parser.add_option("--threads", threads, "at most this many, and at most one for each core (default: all cores)")
        ->check(CLI::Range(1, 1024));
}

void apply_threads_option(int threads) {
    if (threads > 0) set_thread_count(std::min(threads, thread_count()));  // until now there is one for each core
}

}  // namespace elastolab
