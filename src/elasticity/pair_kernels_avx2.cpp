#include "elasticity/pair_kernels_impl.hpp"

namespace elastolab {

extern const PairKernels kAvx2PairKernels;
const PairKernels kAvx2PairKernels = make_pair_kernels<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>();

}  // namespace elastolab
