#include "base/blas_memory.hpp"

#include <sys/mman.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <vector>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/restart.hpp"
#include "base/text.hpp"

// Exported by OpenBLAS but declared in none of its headers; null in a library without them.
extern "C" [[gnu::weak]] void* blas_memory_alloc(int);
extern "C" [[gnu::weak]] void blas_memory_free(void*);

namespace elastolab {

namespace {

constexpr const char* kThreadsVariable = "OPENBLAS_NUM_THREADS";
/// What OpenBLAS maps for each thread of its pool and for each thread that calls it [bytes].
constexpr std::size_t kBuffer = (std::size_t{128} << 20) + (std::size_t{1} << 16);

/// Where addresses are scarce, buffers get one of this many parts, data the others.
constexpr std::size_t kShareOfBuffers = 4;

/// Whether a request for addresses may be refused long before the memory is used up.
bool are_addresses_limited() {
    for (const auto kind : {RLIMIT_AS, RLIMIT_DATA})
        if (rlimit limit{}; getrlimit(kind, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) return true;
    int overcommit = 0;
    std::ifstream file("/proc/sys/vm/overcommit_memory");
    return file >> overcommit && overcommit == 2;
}

bool can_map(std::size_t bytes) {
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return false;
    munmap(memory, bytes);
    return true;
}

/// Buffers for n threads that call, and for the n - 1 that the pool has then.
std::size_t buffers_for(int n) { return (2 * static_cast<std::size_t>(n) - 1) * kBuffer; }

/// OpenBLAS keeps buffers that were taken once, and reuses them.
void take_buffers_once(int n) {
    if (blas_memory_alloc == nullptr || blas_memory_free == nullptr) return;
    std::vector<void*> buffers;
    for (int i = 0; i < n; ++i) buffers.push_back(blas_memory_alloc(0));
    for (void* buffer : buffers) blas_memory_free(buffer);
}

}  // namespace

void start_blas_within_limits(char** argv) {
    if (!are_addresses_limited() || std::getenv(kThreadsVariable) != nullptr) return;
    if (setenv(kThreadsVariable, "1", 0) == 0) restart(argv);  // on failure: as without limits
}

void reserve_blas_buffers() {
    if (!are_addresses_limited()) return;
    int n = thread_count();
    while (n > 1 && !can_map(kShareOfBuffers * buffers_for(n))) --n;
    if (!can_map(buffers_for(n)))
        throw Error("Out of memory: linear algebra takes " + readable_bytes(static_cast<double>(buffers_for(n))) +
                    " of addresses, and this process cannot have them. Raise its limit (ulimit -v, ulimit -d).");
    set_thread_count(n);
    take_buffers_once(n);
}

}  // namespace elastolab
