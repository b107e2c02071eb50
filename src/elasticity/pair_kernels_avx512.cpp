#include "elasticity/pair_kernels_impl.hpp"

namespace elastolab {

extern const PairKernels kAvx512PairKernels;
const PairKernels kAvx512PairKernels = make_pair_kernels<xsimd::batch<double, xsimd::avx512dq>>();

}  // namespace elastolab
