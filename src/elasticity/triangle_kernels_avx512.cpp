#include "elasticity/triangle_kernels_impl.hpp"

namespace elastolab {

extern const TriangleKernels kAvx512Kernels;
const TriangleKernels kAvx512Kernels = make_kernels<xsimd::batch<double, xsimd::avx512dq>>("avx512");

}  // namespace elastolab
