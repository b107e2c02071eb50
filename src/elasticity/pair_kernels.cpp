#include "elasticity/pair_kernels.hpp"

#include "elasticity/pair_kernels_impl.hpp"

namespace elastolab {

#if defined(__x86_64__)
extern const PairKernels kAvx2PairKernels;
extern const PairKernels kAvx512PairKernels;
#endif

const PairKernels& plain_pair_kernels() {
    static constexpr PairKernels kernels = make_pair_kernels<double>();
    return kernels;
}

const PairKernels& best_pair_kernels() {
#if defined(__x86_64__)
    if (best_triangle_kernels().lanes == kAvx512PairKernels.lanes) return kAvx512PairKernels;
    if (best_triangle_kernels().lanes == kAvx2PairKernels.lanes) return kAvx2PairKernels;
#endif
    return plain_pair_kernels();
}

}  // namespace elastolab
