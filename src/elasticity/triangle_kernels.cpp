#include "elasticity/triangle_kernels.hpp"

#include "base/instruction_set.hpp"
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
    const InstructionSet set = best_instruction_set();
    if (set == InstructionSet::avx512) return kAvx512Kernels;
    if (set == InstructionSet::avx2) return kAvx2Kernels;
#endif
    return plain_triangle_kernels();
}

}  // namespace elastolab
