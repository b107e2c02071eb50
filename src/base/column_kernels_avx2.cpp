#include "base/column_kernels.hpp"

namespace elastolab {

extern const ColumnKernels kAvx2ColumnKernels;
const ColumnKernels kAvx2ColumnKernels = kPlainColumnKernels;

}  // namespace elastolab
