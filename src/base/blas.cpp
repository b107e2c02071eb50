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

void set_thread_count(int n) {
    threads() = n;
    openblas_set_num_threads(n);
}

int thread_count() { return threads(); }

namespace {

std::mutex serial_mutex;
int serial_count = 0;

}  // namespace

SerialBlas::SerialBlas() {
    const std::lock_guard lock(serial_mutex);
    if (serial_count++ == 0) openblas_set_num_threads(1);
}

SerialBlas::~SerialBlas() {
    const std::lock_guard lock(serial_mutex);
    if (--serial_count == 0) openblas_set_num_threads(thread_count());
}

}  // namespace elastolab
