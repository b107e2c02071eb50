#include "base/column_kernels.hpp"

#include "base/instruction_set.hpp"

namespace elastolab {

#if defined(__x86_64__)
extern const ColumnKernels kAvx2ColumnKernels;
extern const ColumnKernels kAvx512ColumnKernels;
#endif

const ColumnKernels& column_kernels() {
#if defined(__x86_64__)
    static const InstructionSet set = best_instruction_set();
    if (set == InstructionSet::avx512) return kAvx512ColumnKernels;
    if (set == InstructionSet::avx2) return kAvx2ColumnKernels;
#endif
    return kPlainColumnKernels;
}

}  // namespace elastolab
