#include "elasticity/triangle_kernels.hpp"

#include "elasticity/triangle_kernels_impl.hpp"

namespace elastolab {

#if defined(__x86_64__)
extern const TriangleKernels kAvx2Kernels;
extern const TriangleKernels kAvx512Kernels;
#endif

const TriangleKernels& plain_triangle_kernels() {
    static constexpr TriangleKernels kernels = make_kernels<double>("plain");
    return kernels;
}

const TriangleKernels& best_triangle_kernels() {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return kAvx512Kernels;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return kAvx2Kernels;
#endif
    return plain_triangle_kernels();
}

}  // namespace elastolab
