#pragma once

#include <string>

namespace elastolab {

/// Makes OpenBLAS use kernels that fit this CPU. OpenBLAS 0.3.21 does not know recent CPUs and falls back to SSE3
/// kernels, several times slower; the choice can only be made before the library loads, so this re-executes the
/// program once with OPENBLAS_CORETYPE set. Call it first thing in main. A value that the user has set is respected.
void select_blas_kernels(char** argv);

/// Name of the kernels that run, as OpenBLAS calls them (e.g. "Zen", "SkylakeX", "Haswell").
std::string blas_kernels();

/// Threads that every parallel loop and every BLAS call uses from now on; n >= 1.
void set_thread_count(int n);
int thread_count();

/// While an instance lives, every BLAS call runs on its caller's thread. For parallel loops whose bodies call the BLAS:
/// OpenBLAS has one pool, in which calls from several threads wait for each other (sparse solves of many right-hand
/// sides: three times slower). Affects all threads of the program; may nest.
class SerialBlas {
public:
    SerialBlas();
    ~SerialBlas();
    SerialBlas(const SerialBlas&) = delete;
    SerialBlas& operator=(const SerialBlas&) = delete;
};

}  // namespace elastolab
