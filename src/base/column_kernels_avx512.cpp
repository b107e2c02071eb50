#include "base/column_kernels.hpp"

namespace elastolab {

extern const ColumnKernels kAvx512ColumnKernels;
const ColumnKernels kAvx512ColumnKernels = kPlainColumnKernels;

}  // namespace elastolab
