#include "base/mixed_product_kernels.hpp"

namespace elastolab {

extern const MixedProductKernels kAvx2MixedProductKernels;
const MixedProductKernels kAvx2MixedProductKernels = kMixedProductKernels;

}  // namespace elastolab
