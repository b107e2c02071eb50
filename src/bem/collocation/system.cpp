#include "bem/collocation/system.hpp"

#include <algorithm>
#include <numeric>

#include "bem/collocation/given_loads.hpp"
#include "deform/load_columns.hpp"
#include "deform/node_rows.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

/// Columns solved or multiplied at once: large enough for BLAS-3, small beside the matrix, often enough to cancel.
constexpr Eigen::Index kRightSidesAtOnce = 384;
/// Condition of G above which K = G^-1 H has fewer than six digits.
constexpr double kPoorCondition = 4.5e9;

/// X <- A^-1 X, with a checkpoint after every strip of columns.
void solve_in_strips(const LuFactorization& A, Eigen::MatrixXd& X, Control& control) {
    for (Eigen::Index first = 0; first < X.cols(); first += kRightSidesAtOnce) {
        A.solve_in_place(X.middleCols(first, std::min(kRightSidesAtOnce, X.cols() - first)));
        control.set_progress(static_cast<double>(first) / static_cast<double>(X.cols()));
        control.checkpoint();
    }
}

/// Kept columns may take 40 MiB and, on demand, an eighth of the matrix; else as much as the matrix, as there are five
/// such matrices anyway.
std::uint64_t budget_for(Eigen::Index n_rows, Mode mode) {
    const auto matrix = static_cast<std::uint64_t>(n_rows * n_rows) * 8;
    return (40ull << 20) + (mode == Mode::on_demand ? matrix / 8 : matrix);
}

}  // namespace

BemSystem::BemSystem(const BoundaryElement& element, std::shared_ptr<const Boundary> boundary, double poisson_ratio,
                     const Method& method, Storage storage, StageTimes& stages, Control& control)
    : element_(element),
      boundary_(std::move(boundary)),
      material_{1.0, poisson_ratio},
      tolerance_(integral_tolerance(method)),
      triangles_of_vertex_(boundary_->mesh()),
      nodes_(element.nodes(*boundary_)),
      elements_(element.shape_functions(*boundary_)),
      modes_(rigid_modes(nodes_.positions)) {
    const Eigen::Index n = 3 * n_nodes();
    cache_budget_ = method.column_memory.value_or(budget_for(n, method.mode));
    cache_ = std::make_unique<ColumnCache>(cache_budget_);
    if (storage == Storage::hierarchical) {
        const Stage stage("integrate", control, stages);
        hierarchical_ = std::make_shared<const HierarchicalCollocation>(boundary_, material_, tolerance_, control);
        return;
    }
    if (!factorises_ahead(method)) return;
    Eigen::MatrixXd bordered(n + 6, n + 6);
    {
        const Stage stage("integrate", control, stages);
        assemble(Layer::double_layer, *boundary_, nodes_, elements_, material_, tolerance_,
                 bordered.topLeftCorner(n, n), control);
    }
    Eigen::MatrixXd H;
    if (method.mode != Mode::on_demand) H = bordered.topLeftCorner(n, n);
    {
        const Stage stage("factorise", control, stages);
        factorise(std::move(bordered), control);
    }
    if (method.mode != Mode::on_demand) complete(std::move(H), stages, control);
}

void BemSystem::factorise(Eigen::MatrixXd&& bordered, Control& control) {
    const Eigen::Index n = 3 * n_nodes();
    bordered.topRightCorner(n, 6) = modes_;
    bordered.bottomLeftCorner(6, n) = modes_.transpose();
    bordered.bottomRightCorner(6, 6).setZero();
    lu_ = LuFactorization(std::move(bordered), "boundary-element matrix", &control);
    rigid_ = Eigen::MatrixXd::Zero(n + 6, 6);
    rigid_.bottomRows(6).setIdentity();
    lu_.solve_in_place(rigid_);
}

void BemSystem::complete(Eigen::MatrixXd H, StageTimes& stages, Control& control) {
    const Eigen::Index n = 3 * n_nodes();
    auto operators = std::make_shared<DenseOperators>();
    full_ = std::make_unique<Full>();
    full_->G.resize(n, n);
    {
        const Stage stage("integrate G", control, stages);
        assemble(Layer::single_layer, *boundary_, nodes_, elements_, material_, tolerance_, full_->G, control);
    }
    {
        const Stage stage("K = G^-1 H", control, stages);
        const LuFactorization G(Eigen::MatrixXd(full_->G), "single-layer matrix", &control);
        if (1.0 / G.reciprocal_condition() > kPoorCondition)
            findings_.push_back({.kind = FindingKind::singular_stiffness});
        operators->K = H;
        solve_in_strips(G, operators->K, control);
    }
    {
        const Stage stage("K^-1", control, stages);
        Eigen::MatrixXd& inverse = operators->Khatinv;
        inverse = Eigen::MatrixXd::Zero(n + 6, n + 6);
        inverse.topLeftCorner(n, n) = full_->G;
        inverse.bottomRightCorner(6, 6).setIdentity();
        solve_in_strips(lu_, inverse, control);
    }
    full_->H = std::move(H);
    full_->operators = std::move(operators);
}

std::uint64_t BemSystem::memory_bytes() const {
    if (hierarchical_) return hierarchical_->memory_bytes();
    const auto n = static_cast<std::uint64_t>(lu_.size());
    return 8 * n * n * (full_ ? 5u : 1u);
}

Eigen::MatrixXd BemSystem::double_layer(const CollocationPoints& points, Control& control, double tolerance) const {
    Eigen::MatrixXd rows(3 * points.size(), 3 * n_nodes());
    assemble(Layer::double_layer, *boundary_, points, elements_, material_, std::max(tolerance, tolerance_), rows,
             control);
    return rows;
}

Eigen::MatrixXd BemSystem::single_layer(const CollocationPoints& points, const Elements& loads, Control& control,
                                        double tolerance) const {
    Eigen::MatrixXd rows(3 * points.size(), 3 * loads.n_slots);
    assemble(Layer::single_layer, *boundary_, points, loads, material_, std::max(tolerance, tolerance_), rows, control);
    return rows;
}

Eigen::MatrixXd BemSystem::given_single_layer(const CollocationPoints& points, std::span<const UnitLoad> loads,
                                              Control& control) const {
    return elastolab::given_single_layer(*boundary_, points, material_, tolerance_, loads, control);
}

Columns BemSystem::columns_of_loads(std::span<const UnitLoad> loads, Control& control) const {
    const Eigen::Index n = 3 * n_nodes();
    const auto compute = [&](std::span<const UnitLoad> missing) {
        Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n + 6, std::ssize(missing));
        columns.topRows(n) = given_single_layer(nodes_, missing, control);
        lu_.solve_in_place(columns);
        return columns;
    };
    return load_columns(*cache_, loads, n + 6, compute, control);
}

Eigen::MatrixXd BemSystem::given_tractions(std::span<const UnitLoad> loads, Control& control) const {
    if (loads.empty()) return {};
    const LuFactorization G(Eigen::MatrixXd(full_->G), "single-layer matrix", &control);
    return G.solve(given_single_layer(nodes_, loads, control));
}

Eigen::MatrixXd BemSystem::double_layer_at(std::span<const int> nodes, Control& control) const {
    if (!full_) return double_layer(nodes_.subset(nodes), control);
    return rows_of(full_->H, nodes);
}

const Eigen::MatrixXd& BemSystem::bordered_inverse() const {
    const std::scoped_lock lock(inverse_mutex_);
    if (inverse_.size() == 0) inverse_ = LuFactorization(lu_).inverse();
    return inverse_;
}

bool BemSystem::keeps(const TractionSpace& space) const {
    const auto rows = 3 * static_cast<std::uint64_t>(n_nodes()) + 6;
    return 8 * rows * static_cast<std::uint64_t>(space.n_degrees_of_freedom()) <= cache_budget_;
}

void BemSystem::visit_columns(const TractionSpace& space, const std::function<void(const Columns&)>& visit,
                              Control& control) const {
    const auto row_bytes = 24 * (3 * static_cast<std::uint64_t>(n_nodes()) + 6);  // of a load, which has three columns
    const auto loads_at_once = std::max<std::uint64_t>(cache_budget_ / 2 / row_bytes, 64);
    cache_->drop_unused(control);
    std::vector<const TractionSpace::Block*> group;
    std::uint64_t n_loads = 0;
    for (const TractionSpace::Block& block : space.blocks) {
        group.push_back(&block);
        n_loads += static_cast<std::uint64_t>(std::max(block.n_slots, 1));
        if (n_loads < loads_at_once && &block != &space.blocks.back()) continue;
        visit(Columns(compute(group, space.elements.order, control)));
        group.clear();
        n_loads = 0;
    }
}

Columns BemSystem::compliance_columns(const TractionSpace& space, Control& control) const {
    std::vector<ColumnKey> keys;
    std::map<ColumnKey, const TractionSpace::Block*> blocks;
    for (const TractionSpace::Block& block : space.blocks) {
        keys.push_back(block.key);
        blocks[block.key] = &block;
    }
    const auto row_bytes = 24 * (3 * static_cast<std::uint64_t>(n_nodes()) + 6);
    const auto bytes = [&](const ColumnKey& key) {
        return row_bytes * static_cast<std::uint64_t>(std::max(blocks.at(key)->n_slots, 1));
    };
    const auto compute_missing = [&](const std::vector<ColumnKey>& missing) {
        std::vector<Columns::Block> result;
        std::vector<const TractionSpace::Block*> wanted;
        for (const ColumnKey& key : missing) {
            result.push_back(from_inverse(*blocks.at(key)));
            if (!result.back()) wanted.push_back(blocks.at(key));
        }
        const std::vector<Columns::Block> computed = compute(wanted, space.elements.order, control);
        auto next = computed.begin();
        for (Columns::Block& block : result)
            if (!block) block = *next++;
        return result;
    };
    return cache_->get(keys, bytes, compute_missing, control);
}

Columns::Block BemSystem::from_inverse(const TractionSpace::Block& block) const {
    if (!full_ || block.whole_node < 0) return nullptr;
    return std::make_shared<const Eigen::MatrixXd>(full_->operators->Khatinv.middleCols<3>(3 * block.whole_node));
}

std::vector<Columns::Block> BemSystem::compute(const std::vector<const TractionSpace::Block*>& missing,
                                               Elements::Order order, Control& control) const {
    const Eigen::Index n = 3 * n_nodes();
    std::vector<Columns::Block> result;
    for (std::size_t begin = 0; begin < missing.size();) {
        Elements loads{order, 0, {}};
        std::vector<int> residuals;
        std::size_t end = begin;
        for (; end < missing.size() && 3 * (loads.n_slots + std::ssize(residuals)) < kRightSidesAtOnce; ++end) {
            append(loads, missing[end]->elements, missing[end]->n_slots);
            if (missing[end]->n_slots == 0) residuals.push_back(missing[end]->key.back());
        }
        Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n + 6, 3 * (loads.n_slots + std::ssize(residuals)));
        if (loads.n_slots > 0)
            assemble(Layer::single_layer, *boundary_, nodes_, merged(loads), material_, tolerance_,
                     columns.topLeftCorner(n, 3 * loads.n_slots), control);
        for (std::size_t i = 0; i < residuals.size(); ++i)
            columns.block<3, 3>(3 * residuals[i], 3 * (loads.n_slots + static_cast<Eigen::Index>(i))).setIdentity();
        lu_.solve_in_place(columns);
        control.checkpoint();
        Eigen::Index next_load = 0, next_residual = 3 * loads.n_slots;
        for (; begin < end; ++begin) {
            Eigen::Index& next = missing[begin]->n_slots > 0 ? next_load : next_residual;
            const Eigen::Index count = 3 * std::max(missing[begin]->n_slots, 1);
            result.push_back(std::make_shared<const Eigen::MatrixXd>(columns.middleCols(next, count)));
            next += count;
        }
    }
    return result;
}

}  // namespace elastolab
