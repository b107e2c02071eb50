#pragma once

namespace elastolab {

/// Where a limit of the address space, or of data in it (ulimit -v, ulimit -d), may refuse memory: makes OpenBLAS start
/// without a pool of threads (OPENBLAS_NUM_THREADS, when it is not set), by running the program once more. Each thread
/// of the pool maps 128 MB at once and, when refused, tries for ever. Call it first thing in main, then
/// reserve_blas_buffers().
void start_blas_within_limits(char** argv);

/// Where such a limit may refuse memory, maps all buffers that OpenBLAS is going to use, for as many threads as leave
/// most of the addresses to data; that number limits the thread count from then on. Without this, OpenBLAS never
/// returns from a call that finds no room for its buffer. Throws Error when there is no room for one thread.
void reserve_blas_buffers();

}  // namespace elastolab
