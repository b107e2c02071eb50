#include "base/blas.hpp"

#include <cblas.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <string>

#include "base/instruction_set.hpp"
#include "base/machine.hpp"
#include "base/restart.hpp"

namespace elastolab {

namespace {

std::atomic<int>& threads() {
    static std::atomic<int> n{available_cores()};
    return n;
}

/// Kernels of OpenBLAS that predate AVX2; a CPU with AVX2 that got one of these was not recognised.
bool is_outdated(const std::string& kernels) {
    static constexpr std::array kOld = {"Prescott", "Core2",   "Penryn",    "Dunnington", "Nehalem",   "Sandybridge",
                                        "Atom",     "Opteron", "Barcelona", "Bobcat",     "Bulldozer", "Katmai"};
    return std::any_of(kOld.begin(), kOld.end(), [&](const char* old) { return kernels.rfind(old, 0) == 0; });
}

/// glibc's heaps: huge pages, and no more heaps than cores (its choice is eight for each), as none gives its memory to
/// another.
std::string heaps() { return "glibc.malloc.hugetlb=1:glibc.malloc.arena_max=" + std::to_string(available_cores()); }

/// The best kernels that this CPU can run; null where the library's own choice is to stay.
const char* fitting_kernels() {
    const InstructionSet set = best_instruction_set();
    if (set == InstructionSet::avx512) return "SkylakeX";
    if (set == InstructionSet::avx2) return "Haswell";
    return nullptr;
}

}  // namespace

void prepare_parallel_libraries(char** argv) {
    bool changed = false;
    const auto set_where_unset = [&](const char* variable, const char* value) {
        if (value != nullptr && std::getenv(variable) == nullptr) changed |= setenv(variable, value, 0) == 0;
    };
    if (is_outdated(blas_kernels())) set_where_unset("OPENBLAS_CORETYPE", fitting_kernels());
    set_where_unset("OMP_WAIT_POLICY", "passive");
    set_where_unset("OPENBLAS_THREAD_TIMEOUT", "12");  // its threads look for more work for 2^12 cycles, not for 2^26
    set_where_unset("GLIBC_TUNABLES", heaps().c_str());
    if (changed) restart(argv);  // on failure all is slower, and reports say which kernels run
    if (openblas_get_num_threads() > thread_count()) set_thread_count(thread_count());  // it knows of no quota
}

std::string blas_kernels() { return openblas_get_corename(); }

int thread_count() { return threads(); }

namespace {

/// Settles OpenBLAS's number of threads between those who want one and those who want all.
class BlasThreads {
public:
    void set_all(int n) {
        const std::lock_guard lock(mutex_);
        threads() = n;
        apply();
    }
    void count_serial(int more) {
        const std::lock_guard lock(mutex_);
        n_serial_ += more;
        apply();
    }
    void count_parallel(int more) {
        const std::lock_guard lock(mutex_);
        n_parallel_ += more;
        apply();
    }

private:
    void apply() const {
        const int n = n_serial_ > 0 && n_parallel_ == 0 ? 1 : thread_count();
        if (openblas_get_num_threads() != n) openblas_set_num_threads(n);
    }

    std::mutex mutex_;
    int n_serial_ = 0, n_parallel_ = 0;
};

BlasThreads blas_threads;

}  // namespace

void set_thread_count(int n) { blas_threads.set_all(n); }

SerialBlas::SerialBlas() { blas_threads.count_serial(1); }
SerialBlas::~SerialBlas() { blas_threads.count_serial(-1); }

ParallelBlas::ParallelBlas() { blas_threads.count_parallel(1); }
ParallelBlas::~ParallelBlas() { blas_threads.count_parallel(-1); }

}  // namespace elastolab
