#include "fem/nonlinear/element_kernels.hpp"

#include "base/instruction_set.hpp"
#include "fem/nonlinear/element_kernels_impl.hpp"

namespace elastolab {

#if defined(__x86_64__)
extern const ElementKernels kAvx2ElementKernels;
extern const ElementKernels kAvx512ElementKernels;
#endif

const ElementKernels& plain_element_kernels() {
    static constexpr ElementKernels kernels = make_element_kernels<double>("plain");
    return kernels;
}

const ElementKernels& best_element_kernels() {
#if defined(__x86_64__)
    const InstructionSet set = best_instruction_set();
    if (set == InstructionSet::avx512) return kAvx512ElementKernels;
    if (set == InstructionSet::avx2) return kAvx2ElementKernels;
#endif
    return plain_element_kernels();
}

}  // namespace elastolab
