#include "fem/compliance.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/blas.hpp"
#include "base/parallel.hpp"
#include "deform/holds.hpp"
#include "deform/node_rows.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/forward_elimination.hpp"

namespace elastolab {

namespace {

/// Columns solved at once: enough for BLAS-3 kernels, few enough for frequent checkpoints, and two blocks where there
/// are few. The number of threads plays no part: results must not depend on it.
int block_of(Eigen::Index n_columns) { return std::clamp(static_cast<int>(n_columns + 1) / 2, 12, 48); }

SparseMatrix held(const SparseMatrix& K, const Positions& positions, int n_surface, std::span<const int> fixed) {
    assert(fixed.empty() || holds(positions, fixed));
    return fixed.empty() ? grounded(K, positions, choose_support(positions, n_surface)) : eliminated(K, fixed);
}

}  // namespace

SurfaceCompliance::SurfaceCompliance(int n_surface, std::span<const int> fixed, const Positions& positions,
                                     SparseCholesky factor)
    : n_surface_(n_surface),
      fixed_(fixed.begin(), fixed.end()),
      rigid_(fixed.empty() ? rigid_modes(positions.leftCols(n_surface)) : Eigen::MatrixXd(3 * n_surface, 0)),
      factor_(std::move(factor)) {
    if (rigid_.cols() == 0) return;
    Eigen::MatrixXd load = Eigen::MatrixXd::Zero(factor_.size(), rigid_.cols());
    load.topRows(rigid_.rows()) = rigid_;
    rigid_columns_ = factor_.solve(load).topRows(rigid_.rows());
}

SurfaceCompliance::SurfaceCompliance(const SparseMatrix& K, const CholeskyAnalysis& analysis,
                                     const Positions& positions, int n_surface, std::span<const int> fixed,
                                     Control& control)
    : SurfaceCompliance(n_surface, fixed, positions,
                        SparseCholesky(analysis, held(K, positions, n_surface, fixed), "stiffness matrix", &control)) {
    control.checkpoint();
}

SurfaceCompliance SurfaceCompliance::supported_at(const StaticSupport& support, const SparseMatrix& K,
                                                  const CholeskyAnalysis& analysis, const Positions& positions,
                                                  int n_surface, Control& control) {
    SparseCholesky factor(analysis, grounded(K, positions, support), "stiffness matrix", &control);
    control.checkpoint();
    return {n_surface, {}, positions, std::move(factor)};
}

Eigen::MatrixXd SurfaceCompliance::volume_columns(const Eigen::MatrixXd& loads) const {
    const Eigen::Index n = 3 * n_surface_;
    Eigen::MatrixXd load = Eigen::MatrixXd::Zero(factor_.size(), loads.cols());
    load.topRows(loads.rows()) = loads;
    if (rigid_.cols() > 0 && loads.rows() == n) load.topRows(n).noalias() -= rigid_ * (rigid_.transpose() * loads);
    clear_rows(fixed_, load);
    return factor_.solve(load);
}

void SurfaceCompliance::apply_block(Eigen::Ref<Eigen::MatrixXd> block) const {
    block = volume_columns(block).topRows(3 * n_surface_);
    if (rigid_.cols() > 0) block -= rigid_ * (rigid_.transpose() * block).eval();
}

Eigen::MatrixXd SurfaceCompliance::apply(const Eigen::MatrixXd& loads, Control& control) const {
    assert(loads.rows() == 3 * n_surface_);
    Eigen::MatrixXd u = loads;
    const SerialBlas serial;
    parallel_blocks(static_cast<int>(u.cols()), block_of(u.cols()), control,
                    [&](int begin, int end) { apply_block(u.middleCols(begin, end - begin)); });
    return u;
}

Eigen::MatrixXd SurfaceCompliance::columns(std::span<const int> vertices, Control& control) const {
    Eigen::MatrixXd unit_loads = unit_forces(vertices, n_surface_);
    const SerialBlas serial;
    parallel_blocks(static_cast<int>(unit_loads.cols()), block_of(unit_loads.cols()), control,
                    [&](int begin, int end) { apply_block(unit_loads.middleCols(begin, end - begin)); });
    return unit_loads;
}

Eigen::MatrixXd SurfaceCompliance::block(std::span<const int> vertices, Control& control) const {
    const Eigen::Index n = 3 * std::ssize(vertices);
    SparseMatrix unit_loads(factor_.size(), n);
    unit_loads.reserve(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        unit_loads.startVec(k);
        unit_loads.insertBack(3 * vertices[static_cast<std::size_t>(k / 3)] + k % 3, k) = 1.0;
    }
    unit_loads.finalize();
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n, n);
    subtract_compressed_inverse(factor_, unit_loads, D, control);
    D = -D;
    if (rigid_.cols() > 0) {
        // So far D holds K_g^-1 alone; what is wanted is P K_g^-1 P with P = I - R R^T.
        const Eigen::MatrixXd R = rows_of(rigid_, vertices), G_R = rows_of(rigid_columns_, vertices);
        const Eigen::MatrixXd cross = G_R * R.transpose();
        D += R * (rigid_.transpose() * rigid_columns_) * R.transpose() - cross - cross.transpose();
    }
    D.triangularView<Eigen::StrictlyUpper>() = D.transpose();
    return D;
}

std::uint64_t SurfaceCompliance::memory_bytes() const {
    return factor_.memory_bytes() + 8 * static_cast<std::uint64_t>(rigid_.size() + rigid_columns_.size());
}

}  // namespace elastolab
