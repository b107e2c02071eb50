#include "base/mixed_product_kernels.hpp"

namespace elastolab {

extern const MixedProductKernels kAvx512MixedProductKernels;
const MixedProductKernels kAvx512MixedProductKernels = kMixedProductKernels;

}  // namespace elastolab
