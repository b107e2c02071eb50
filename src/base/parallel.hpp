#pragma once

#include <algorithm>
#include <atomic>
#include <exception>

#include "base/blas.hpp"
#include "base/control.hpp"

namespace elastolab {

/// Calls body(begin, end) for disjoint blocks of [0, n), `grain` indices each, on thread_count() threads. Blocks are
/// the same whatever the number of threads, so a body that writes only its own indices gives the same result.
/// Checks for cancellation and reports progress after every block. The first exception of a body, or Cancelled, is
/// rethrown to the caller once all threads have stopped.
template <class Body>
void parallel_blocks(int n, int grain, Control& control, Body&& body) {
    const int n_blocks = (n + grain - 1) / grain;
    std::exception_ptr failure;
    std::atomic<bool> stop{false};
    std::atomic<int> done{0};
#pragma omp parallel for schedule(dynamic) num_threads(thread_count())
    for (int block = 0; block < n_blocks; ++block) {
        if (stop || control.cancelled()) continue;
        try {
            body(block * grain, std::min(n, (block + 1) * grain));
        } catch (...) {
#pragma omp critical(elastolab_parallel_failure)
            if (!stop.exchange(true)) failure = std::current_exception();
        }
        control.set_progress(static_cast<double>(++done) / n_blocks);
    }
    if (failure) std::rethrow_exception(failure);
    control.checkpoint();
}

}  // namespace elastolab
