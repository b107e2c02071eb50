#include "base/blas.hpp"

#include <cblas.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace elastolab {

namespace {

constexpr const char* kCoreTypeVariable = "OPENBLAS_CORETYPE";

std::atomic<int>& threads() {
    static std::atomic<int> n{std::max(1, static_cast<int>(std::thread::hardware_concurrency()))};
    return n;
}

/// Kernels of OpenBLAS that predate AVX2; a CPU with AVX2 that got one of these was not recognised.
bool is_outdated(const std::string& kernels) {
    static constexpr std::array kOld = {"Prescott", "Core2",   "Penryn",    "Dunnington", "Nehalem",   "Sandybridge",
                                        "Atom",     "Opteron", "Barcelona", "Bobcat",     "Bulldozer", "Katmai"};
    return std::any_of(kOld.begin(), kOld.end(), [&](const char* old) { return kernels.rfind(old, 0) == 0; });
}

/// The best kernels that this CPU can run; null where the library's own choice is to stay.
const char* fitting_kernels() {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl"))
        return "SkylakeX";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
    return nullptr;
}

}  // namespace

void select_blas_kernels(char** argv) {
    if (std::getenv(kCoreTypeVariable) != nullptr || !is_outdated(blas_kernels())) return;
    const char* kernels = fitting_kernels();
    if (kernels == nullptr || setenv(kCoreTypeVariable, kernels, 0) != 0) return;
    execv("/proc/self/exe", argv);  // on failure the program goes on with the slow kernels, and its report says so
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
