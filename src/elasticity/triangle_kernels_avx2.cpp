#include "elasticity/triangle_kernels_impl.hpp"

namespace elastolab {

extern const TriangleKernels kAvx2Kernels;
const TriangleKernels kAvx2Kernels = make_kernels<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>("avx2");

}  // namespace elastolab
