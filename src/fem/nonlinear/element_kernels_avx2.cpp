#include "fem/nonlinear/element_kernels_impl.hpp"

namespace elastolab {

extern const ElementKernels kAvx2ElementKernels;
const ElementKernels kAvx2ElementKernels = make_element_kernels<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>("avx2");

}  // namespace elastolab
