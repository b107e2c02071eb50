#include "base/column_sum.hpp"

#include <algorithm>
#include <cassert>

#include "base/column_kernels.hpp"
#include "base/instruction_set.hpp"

namespace elastolab {

#if defined(__x86_64__)
extern const ColumnKernels kAvx2ColumnKernels;
extern const ColumnKernels kAvx512ColumnKernels;
#endif

const ColumnKernels& column_kernels() {
#if defined(__x86_64__)
    static const InstructionSet set = best_instruction_set();
    if (set == InstructionSet::avx512) return kAvx512ColumnKernels;
    if (set == InstructionSet::avx2) return kAvx2ColumnKernels;
#endif
    return kPlainColumnKernels;
}

void column_sum(const Eigen::VectorXd& rest, const Eigen::MatrixXd& A, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    assert(A.rows() == rest.size() && A.cols() == x.size() && &rest != &y);
    constexpr Eigen::Index kRowsInCache = 1024;  // of y, which is read again where x is long
    y.resize(rest.size());
    for (Eigen::Index first = 0; first < y.size(); first += kRowsInCache)
        column_kernels().sum(rest.data() + first, A.data() + first, A.outerStride(),
                             std::min(kRowsInCache, y.size() - first), A.cols(), x.data(), y.data() + first);
}

}  // namespace elastolab
