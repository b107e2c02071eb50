#include "fem/nonlinear/element_kernels_impl.hpp"

namespace elastolab {

extern const ElementKernels kAvx512ElementKernels;
const ElementKernels kAvx512ElementKernels = make_element_kernels<xsimd::batch<double, xsimd::avx512dq>>("avx512");

}  // namespace elastolab
