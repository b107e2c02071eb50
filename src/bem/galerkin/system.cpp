#include "bem/galerkin/system.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/blas.hpp"
#include "base/cancellable_lock.hpp"
#include "base/parallel.hpp"
#include "base/strips.hpp"
#include "bem/galerkin/given_loads.hpp"
#include "bem/galerkin/refined_hypersingular.hpp"
#include "bem/galerkin/traction_rows.hpp"
#include "deform/load_columns.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

/// First numbers of cache keys: a unit load at a vertex, a traction on a triangle, the rigid tractions on a surface.
enum GalerkinKey { kVertexLoad, kTriangleTraction, kSurfaceTraction };
/// Triangles whose rows are integrated and solved for at once.
constexpr std::size_t kTrianglesAtOnce = 256;

int components_of(const ColumnKey& key) { return key.front() == kSurfaceTraction ? 6 : 3; }

std::uint64_t half_column_budget(Eigen::Index n, Mode mode) {
    const auto matrix = static_cast<std::uint64_t>(n * n) * 8;
    return (64ull << 20) + (mode == Mode::on_demand ? matrix / 4 : matrix);
}

/// use(first, count) for parts of D's columns, in parallel.
template <class Use>
void for_columns(const Eigen::MatrixXd& D, Control& control, Use&& use) {
    const SerialBlas serial;
    parallel_blocks(static_cast<int>(D.cols()), 64, control,
                    [&](int begin, int end) { use(begin, Eigen::Index{end - begin}); });
}

/// D <- D + shift C C^T.
void add_rigid_stiffness(const Eigen::MatrixXd& C, double shift, Eigen::MatrixXd& D, Control& control) {
    for_columns(D, control, [&](Eigen::Index begin, Eigen::Index count) {
        D.middleCols(begin, count).noalias() += shift * C * C.middleRows(begin, count).transpose();
    });
}

/// What D's integrals leave where D C should vanish, C the rigid motions of closed surfaces: D - left C^T - C left^T =
/// P D P with P = I - C C^T.
class RigidPart {
public:
    RigidPart(const Eigen::MatrixXd& D, const Eigen::MatrixXd& C, Control& control) : C_(C), left_(C.rows(), C.cols()) {
        for_columns(D, control, [&](Eigen::Index begin, Eigen::Index count) {  // D is symmetric
            left_.middleRows(begin, count).noalias() = D.middleCols(begin, count).transpose() * C_;
        });
        left_ -= 0.5 * C_ * (C_.transpose() * left_);
    }
    /// The mean of the diagonal of P D P.
    double mean_diagonal(const Eigen::MatrixXd& D) const {
        return (D.trace() - 2.0 * left_.cwiseProduct(C_).sum()) / static_cast<double>(D.rows());
    }
    /// D <- P D P + shift C C^T.
    void replace(Eigen::MatrixXd& D, double shift, Control& control) const {
        const Eigen::Index n = C_.cols();
        Eigen::MatrixXd A(C_.rows(), 2 * n), B(C_.rows(), 2 * n);
        A << left_, C_;
        B << C_, left_ - shift * C_;
        for_columns(D, control, [&](Eigen::Index begin, Eigen::Index count) {
            D.middleCols(begin, count).noalias() -= A * B.middleRows(begin, count).transpose();
        });
    }

private:
    const Eigen::MatrixXd& C_;
    Eigen::MatrixXd left_;
};

/// Rows (or rows and columns) of the triangles of a space, taken to its unknowns: rigid fields for whole surfaces.
class Reduction {
public:
    Reduction(const Boundary& boundary, const ClosedSurfaces& surfaces, const GalerkinTractions& tractions)
        : n_single_(3 * std::ssize(tractions.triangles)), triangles_(tractions.triangles) {
        for (const int s : tractions.free_surfaces) {
            const std::vector<int>& all = surfaces.triangles[static_cast<std::size_t>(s)];
            rigid_.push_back(rigid_tractions(boundary, all));
            triangles_.insert(triangles_.end(), all.begin(), all.end());
        }
    }
    const std::vector<int>& triangles() const { return triangles_; }

    /// Of a symmetric matrix.
    Eigen::MatrixXd rows_and_columns(Eigen::MatrixXd all) const {
        if (rigid_.empty()) return all;
        return rows(rows(std::move(all)).transpose());
    }
    Eigen::MatrixXd rows(Eigen::MatrixXd all) const {
        if (rigid_.empty()) return all;
        Eigen::MatrixXd reduced(n_single_ + 6 * std::ssize(rigid_), all.cols());
        reduced.topRows(n_single_) = all.topRows(n_single_);
        Eigen::Index from = n_single_, to = n_single_;
        for (const Eigen::MatrixXd& fields : rigid_) {
            reduced.middleRows(to, 6) = fields.transpose() * all.middleRows(from, fields.rows());
            from += fields.rows();
            to += 6;
        }
        return reduced;
    }

private:
    Eigen::Index n_single_;
    std::vector<int> triangles_;
    std::vector<Eigen::MatrixXd> rigid_;
};

/// T <- -K^T, in parts that fit the caches of several threads.
void write_negative_transpose(const Eigen::MatrixXd& K, Eigen::Ref<Eigen::MatrixXd> T) {
    for_strips(K.cols(), 64, [&](Eigen::Index first, Eigen::Index count) {
        T.middleRows(first, count) = -K.middleCols(first, count).transpose();
    });
}

/// Copies of these columns, a block for each key.
void append_blocks(const Eigen::MatrixXd& columns, std::span<const ColumnKey> keys,
                   std::vector<Columns::Block>& blocks) {
    std::vector<std::shared_ptr<Eigen::MatrixXd>> copies;
    std::vector<Eigen::Index> first_columns;
    Eigen::Index next = 0;
    for (const ColumnKey& key : keys) {
        const int count = components_of(key);
        copies.push_back(std::make_shared<Eigen::MatrixXd>(columns.rows(), count));
        first_columns.push_back(next);
        next += count;
    }
    for_strips(std::ssize(copies), 16, [&](Eigen::Index first, Eigen::Index count) {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(first + count); ++i)
            *copies[i] = columns.middleCols(first_columns[i], copies[i]->cols());
    });
    blocks.insert(blocks.end(), copies.begin(), copies.end());
}

}  // namespace

GalerkinSystem::GalerkinSystem(std::shared_ptr<const Boundary> boundary, double poisson_ratio, const Method& method,
                               std::shared_ptr<const HypersingularParts> parts, StageTimes& stages, Control& control)
    : boundary_(std::move(boundary)),
      material_{1.0, poisson_ratio},
      tolerance_(integral_tolerance(method)),
      surfaces_(boundary_->mesh()),
      body_modes_(rigid_modes(boundary_->mesh().vertices)),
      parts_(std::move(parts)),
      keeps_matrix_(factorises_ahead(method)),
      cache_(std::make_unique<ColumnCache>(method.column_memory.value_or(half_column_budget(size(), method.mode)))) {
    if (method.rims > 0) {
        const Stage stage(parts_ ? "combine" : "integrate", control, stages);
        integrals_ = integrals(control);
    }
    if (!keeps_matrix_) return;
    Eigen::MatrixXd D, kept;
    {
        const Stage stage(parts_ ? "combine" : "integrate", control, stages);
        D = integrals(control);
        const RigidPart rigid(D, surfaces_.rigid, control);
        shift_ = rigid.mean_diagonal(D);
        if (method.mode != Mode::on_demand) {
            kept = D;
            rigid.replace(kept, 0.0, control);
        }
        const bool is_put_off = method.first_set_alone && method.mode == Mode::on_demand;
        rigid.replace(D, is_put_off ? 0.0 : shift_, control);
        if (is_put_off) {
            unfactorised_ = std::move(D);
            return;
        }
    }
    {
        const Stage stage("factorise", control, stages);
        take_factor(std::move(D), control);
    }
    if (method.mode != Mode::on_demand) complete(std::move(kept), stages, control);
}

void GalerkinSystem::take_factor(Eigen::MatrixXd&& D, Control& control) const {
    factor_ = CholeskyFactorization(std::move(D), "hypersingular matrix", &control);
    is_factorised_ = true;
}

void GalerkinSystem::factorise(Control& control) const {
    if (is_factorised()) return;
    const auto lock = lock_unless_cancelled(factor_mutex_, control);
    if (is_factorised()) return;
    // An attempt that was cancelled has taken D with it.
    Eigen::MatrixXd D = std::exchange(unfactorised_, {});
    if (D.size() == 0) D = hypersingular(control);
    add_rigid_stiffness(surfaces_.rigid, shift_, D, control);
    take_factor(std::move(D), control);
}

bool GalerkinSystem::solve_first_set(const std::function<void(const Eigen::MatrixXd& D)>& solve,
                                     const Control& control) const {
    if (is_factorised()) return false;
    const auto lock = lock_unless_cancelled(factor_mutex_, control);
    if (is_factorised() || solved_first_set_ || unfactorised_.size() == 0) return false;
    solve(unfactorised_);
    solved_first_set_ = true;
    return true;
}

Eigen::MatrixXd GalerkinSystem::hypersingular(Control& control) const {
    Eigen::MatrixXd D = integrals(control);
    RigidPart(D, surfaces_.rigid, control).replace(D, 0.0, control);
    return D;
}

Eigen::MatrixXd GalerkinSystem::hypersingular(const GalerkinSystem& coarse, const RefinedSurface& fine,
                                              Control& control) const {
    const auto pairs = std::make_shared<const BoundaryPairs>(boundary_, tolerance_);
    Eigen::MatrixXd D = refined_hypersingular(coarse.integrals_, fine, pairs, material_, control);
    RigidPart(D, surfaces_.rigid, control).replace(D, 0.0, control);
    return D;
}

Eigen::MatrixXd GalerkinSystem::integrals(Control& control) const {
    if (integrals_.size() > 0) return integrals_;
    Eigen::MatrixXd D(size(), size());
    if (parts_)
        parts_->evaluate(material_, D);
    else
        assemble_hypersingular(*boundary_, material_, tolerance_, D, control);
    return D;
}

void GalerkinSystem::free_of_rigid_motions(Eigen::MatrixXd& K) const {
    const Eigen::MatrixXd rest = K * body_modes_;
    K.noalias() -= rest * body_modes_.transpose();
}

GalerkinOperators GalerkinSystem::operators(const GalerkinTractions& tractions, Control& control) const {
    const Reduction reduction(*boundary_, surfaces_, tractions);
    TractionRows rows = assemble_traction_rows(*boundary_, reduction.triangles(), material_, tolerance_, control);
    GalerkinOperators operators;
    operators.double_layer = reduction.rows(std::move(rows.double_layer));
    free_of_rigid_motions(operators.double_layer);
    operators.single_layer = reduction.rows_and_columns(std::move(rows.single_layer));
    return operators;
}

Eigen::MatrixXd GalerkinSystem::single_layer(const GalerkinTractions& tractions, Control& control) const {
    const Reduction reduction(*boundary_, surfaces_, tractions);
    return reduction.rows_and_columns(
        assemble_single_layer(*boundary_, reduction.triangles(), material_, tolerance_, control));
}

Columns GalerkinSystem::half_columns(std::span<const int> vertices, const GalerkinTractions& tractions,
                                     Control& control) const {
    std::vector<ColumnKey> keys;
    for (const int v : vertices) keys.push_back({kVertexLoad, v});
    for (const int t : tractions.triangles) keys.push_back({kTriangleTraction, t});
    for (const int s : tractions.free_surfaces) keys.push_back({kSurfaceTraction, s});
    const auto row_bytes = 8 * static_cast<std::uint64_t>(size() + surfaces_.rigid.cols());
    return cache_->get(
        keys, [&](const ColumnKey& key) { return row_bytes * static_cast<std::uint64_t>(components_of(key)); },
        [&](const std::vector<ColumnKey>& missing) { return compute(missing, control); }, control);
}

Columns GalerkinSystem::half_load_columns(std::span<const UnitLoad> loads, Control& control) const {
    const Eigen::Index n = size(), n_border = surfaces_.rigid.cols();
    const auto compute = [&](std::span<const UnitLoad> missing) {
        Eigen::MatrixXd columns(n + n_border, std::ssize(missing));
        columns.topRows(n) = given_nodal_forces(missing, control);
        columns.bottomRows(n_border) = surfaces_.rigid.transpose() * columns.topRows(n);
        factor_.solve_lower_in_place(columns.topRows(n));
        return columns;
    };
    return load_columns(*cache_, loads, n + n_border, compute, control);
}

Eigen::MatrixXd GalerkinSystem::given_layers(std::span<const UnitLoad> loads, Control& control) const {
    const auto compute = [&](std::span<const UnitLoad> missing) {
        const BoundaryPairs pairs(boundary_, tolerance_);
        return elastolab::given_layers(pairs, material_, missing, {pairs.integrals(), tolerance_}, control);
    };
    return load_columns(given_, loads, size() + 3 * boundary_->n_triangles(), compute, control)
        .middle(0, std::ssize(loads));
}

Eigen::MatrixXd GalerkinSystem::given_nodal_forces(std::span<const UnitLoad> loads, Control& control) const {
    return given_layers(loads, control).topRows(size());
}

Eigen::MatrixXd GalerkinSystem::given_single_layer(const GalerkinTractions& tractions, std::span<const UnitLoad> loads,
                                                   Control& control) const {
    return elastolab::given_single_layer(given_layers(loads, control), *boundary_, surfaces_, tractions);
}

std::vector<Columns::Block> GalerkinSystem::compute(const std::vector<ColumnKey>& missing, Control& control) const {
    const Eigen::Index n = size(), n_border = surfaces_.rigid.cols();
    std::vector<Columns::Block> blocks;
    for (std::size_t begin = 0; begin < missing.size();) {
        GalerkinTractions tractions = {};
        Eigen::Index n_columns = 0;
        std::size_t end = begin;
        for (; end < missing.size() && end - begin < kTrianglesAtOnce; ++end) {
            const ColumnKey& key = missing[end];
            if (key.front() == kTriangleTraction) tractions.triangles.push_back(key.back());
            if (key.front() == kSurfaceTraction) tractions.free_surfaces.push_back(key.back());
            n_columns += components_of(key);
        }
        Eigen::MatrixXd columns(n + n_border, n_columns);
        const Eigen::Index n_loads = n_columns - tractions.size();  // vertices come first
        columns.leftCols(n_loads).setZero();
        for (Eigen::Index i = 0; 3 * i < n_loads; ++i)
            columns.block<3, 3>(3 * missing[begin + static_cast<std::size_t>(i)].back(), 3 * i).setIdentity();
        if (tractions.size() > 0)
            write_negative_transpose(operators(tractions, control).double_layer,
                                     columns.topRightCorner(n, tractions.size()));
        columns.bottomRows(n_border) = surfaces_.rigid.transpose() * columns.topRows(n);
        factor_.solve_lower_in_place(columns.topRows(n));
        control.checkpoint();
        append_blocks(columns, std::span(missing).subspan(begin, end - begin), blocks);
        begin = end;
    }
    return blocks;
}

void GalerkinSystem::finish(Eigen::MatrixXd& y, const Eigen::MatrixXd& f) const {
    factor_.solve_upper_in_place(y);
    y.noalias() -= surfaces_.rigid * (f / shift_);
}

void GalerkinSystem::complete(Eigen::MatrixXd D, StageTimes& stages, Control& control) {
    const Stage stage("D^+", control, stages);
    const Eigen::Index n = size();
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(n, n);
    constexpr Eigen::Index kAtOnce = 384;
    for (Eigen::Index first = 0; first < n; first += kAtOnce) {
        factor_.solve_in_place(inverse.middleCols(first, std::min(kAtOnce, n - first)));
        control.set_progress(static_cast<double>(first) / static_cast<double>(n));
        control.checkpoint();
    }
    inverse.noalias() -= surfaces_.rigid * surfaces_.rigid.transpose() / shift_;
    dense_ = std::make_shared<const DenseHypersingular>(DenseHypersingular{std::move(D), std::move(inverse)});
}

std::uint64_t GalerkinSystem::memory_bytes() const {
    const auto n = static_cast<std::uint64_t>(keeps_matrix_ ? size() : 0);
    return 8 * (n * n * ((dense_ ? 3u : 1u) + (parts_ ? 2u : 0u)) + static_cast<std::uint64_t>(integrals_.size()));
}

std::uint64_t half_column_memory(const GalerkinSystem& system, Eigen::Index n_degrees_of_freedom) {
    const auto n = static_cast<std::uint64_t>(system.size()), m = static_cast<std::uint64_t>(n_degrees_of_freedom);
    return 8 * (2 * n * m + 3 * m * m);
}

}  // namespace elastolab
