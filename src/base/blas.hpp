#pragma once

#include <string>

namespace elastolab {

/// Makes choices that can only be made before libraries load, so this re-executes the program once with them in its
/// environment. Call it first thing in main. What the user has set is respected.
///   OPENBLAS_CORETYPE  kernels that fit this CPU: OpenBLAS 0.3.21 does not know recent ones and falls back to SSE3
///                      kernels, several times slower
///   OMP_WAIT_POLICY    passive: OpenMP's threads sleep when they have nothing to do. They spin otherwise, on cores
///                      that OpenBLAS's threads and other workers want: whole precomputations of small bodies took 2 to
///                      10 times as long, in steps of the scheduler's 4 ms
///   OPENBLAS_THREAD_TIMEOUT  12: OpenBLAS's threads sleep as well, after some microseconds instead of 27 ms. Alone the
///                      program is as fast; beside others it takes up to 40 % less of the processors
///   GLIBC_TUNABLES     huge pages for large matrices (glibc.malloc.hugetlb=1): a tenth less time at 1000 vertices;
///                      and no more heaps than cores (arena_max), where a viewer of a small body at rest held up to
///                      100 MB that had been freed
void prepare_parallel_libraries(char** argv);

/// Name of the kernels that run, as OpenBLAS calls them (e.g. "Zen", "SkylakeX", "Haswell").
std::string blas_kernels();

/// Threads that every parallel loop and every BLAS call uses from now on; n >= 1. At first available_cores().
void set_thread_count(int n);
int thread_count();

// OpenBLAS 0.3.21 has one number of threads for the whole program. The next two classes settle which it is while
// several workers compute. Both may nest, on any threads.

/// For a parallel loop whose bodies call the BLAS: while an instance lives, a BLAS call runs on its caller's thread.
/// OpenBLAS has one pool of threads, in which calls from several threads wait for each other (sparse solves of many
/// right-hand sides: three times slower).
class SerialBlas {
public:
    SerialBlas();
    ~SerialBlas();
    SerialBlas(const SerialBlas&) = delete;
    SerialBlas& operator=(const SerialBlas&) = delete;
};

/// For one large BLAS computation, such as a factorisation: while an instance lives, BLAS calls use thread_count()
/// threads, even if another worker has a SerialBlas: so a factorisation is not slowed down, and its rounding does not
/// depend on what runs beside it.
class ParallelBlas {
public:
    ParallelBlas();
    ~ParallelBlas();
    ParallelBlas(const ParallelBlas&) = delete;
    ParallelBlas& operator=(const ParallelBlas&) = delete;
};

}  // namespace elastolab
