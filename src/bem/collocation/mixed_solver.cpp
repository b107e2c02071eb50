#include "bem/collocation/mixed_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "bem/collocation/point_strips.hpp"

namespace elastolab {

namespace {

/// Constrained nodes at which the integral equation is still asked to hold.
std::vector<int> collocated(const TractionSpace& space, const std::vector<int>& nodes) {
    std::vector<int> kept;
    for (const int node : nodes)
        if (std::find(space.dropped_collocation.begin(), space.dropped_collocation.end(), node) ==
            space.dropped_collocation.end())
            kept.push_back(node);
    return kept;
}

/// Columns of the mixed matrix that a thread copies at a time.
constexpr int kColumnsAtOnce = 64;
/// Collocation points of each kind at which the residual is evaluated, and how many of them at once: few, as H may not
/// be dense.
constexpr int kSampledSources = 128, kSampledAtOnce = 16;

std::vector<int> free_nodes(const Partition& partition) {
    std::vector<int> nodes;
    for (std::size_t i = 0; i < partition.free.size(); i += 3) nodes.push_back(static_cast<int>(partition.free[i] / 3));
    return nodes;
}

/// Calls use(first, count) for strips of [0, n).
void for_strips(int n, const std::function<void(int first, int count)>& use) {
    for (int first = 0; first < n; first += kPointsAtOnce) use(first, std::min(kPointsAtOnce, n - first));
}

std::vector<int> range(int first, int count) {
    std::vector<int> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), first);
    return numbers;
}

/// At most this many of some collocation points, evenly spread over their order.
CollocationPoints some_of(const CollocationPoints& points, int most) {
    std::vector<int> numbers;
    const int step = std::max(1, points.size() / most);
    for (int i = step / 2; i < points.size(); i += step) numbers.push_back(i);
    return points.subset(numbers);
}

/// Where a strip of equations is off, and how large its terms are.
struct Balance {
    double off = 0.0, size = 0.0;

    void add(const BemSystem& system, const TractionSpace& space, std::span<const UnitLoad> loads,
             const NodeSolution& solution, const CollocationPoints& points, Control& control) {
        for_point_strips(
            points,
            [&](int, const CollocationPoints& strip) {
                const Eigen::MatrixXd H = system.double_layer(strip, control);
                const Eigen::MatrixXd G = system.single_layer(strip, space.elements, control);
                const Eigen::VectorXd u = solution.displacements.col(0), q = solution.loads.col(0);
                Eigen::VectorXd given = Eigen::VectorXd::Zero(H.rows());
                if (!loads.empty()) given = system.given_single_layer(strip, loads, control) * solution.factors.col(0);
                off += (H * u - G * q - given).squaredNorm();
                size += (H.cwiseAbs() * u.cwiseAbs() + G.cwiseAbs() * q.cwiseAbs() + given.cwiseAbs()).squaredNorm();
            },
            kSampledAtOnce);
    }
};

}  // namespace

MixedProblem::MixedProblem(const BemSystem& system, const TractionSpace& space, const std::vector<int>& nodes,
                           int n_fixed, std::span<const UnitLoad> loads, Control& control)
    : partition(3 * system.n_nodes(), nodes) {
    at = free_nodes(partition);
    const Eigen::Index n_free = 3 * std::ssize(at), n = n_free + 3 * space.n_slots();
    for (const int node : collocated(space, nodes)) at.push_back(node);
    const CollocationPoints points = inner_collocation_points(system.boundary(), space.interior_triangles);
    assert(3 * (std::ssize(at) + points.size()) == n);
    unknown.resize(n, n);
    const std::vector<Eigen::Index> moving(partition.constrained.begin() + 3 * n_fixed, partition.constrained.end());
    known.resize(n, std::ssize(moving));
    given.resize(n, std::ssize(loads));
    Eigen::Index row = 0;
    const auto add = [&](const Eigen::MatrixXd& H, const CollocationPoints& from) {
        const Eigen::MatrixXd G = system.single_layer(from, space.elements, control);
        parallel_blocks(static_cast<int>(n), kColumnsAtOnce, control, [&](int begin, int end) {
            for (Eigen::Index column = begin; column < end; ++column) {
                auto target = unknown.col(column).segment(row, H.rows());
                if (column < n_free)
                    target = H.col(partition.free[static_cast<std::size_t>(column)]);
                else
                    target = -G.col(column - n_free);
            }
        });
        known.middleRows(row, H.rows()) = H(Eigen::all, moving);
        if (!loads.empty()) given.middleRows(row, H.rows()) = system.given_single_layer(from, loads, control);
        row += H.rows();
    };
    for_strips(static_cast<int>(at.size()), [&](int first, int count) {
        const std::span<const int> strip =
            std::span(at).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
        add(system.double_layer_at(strip, control), system.nodes().subset(strip));
    });
    for_point_strips(points,
                     [&](int, const CollocationPoints& strip) { add(system.double_layer(strip, control), strip); });
}

std::uint64_t mixed_memory(const BemSystem& system, const TractionSpace& space, int n_constrained, int n_fixed) {
    const Eigen::Index nodes = system.n_nodes(), n = 3 * (nodes - n_constrained + space.n_slots());
    const Eigen::Index strip = 9 * kPointsAtOnce * (nodes + space.n_slots());
    return 8 * static_cast<std::uint64_t>(n * 3 * (n_constrained - n_fixed) + strip) + RefinedLu::memory_bytes(n);
}

MixedSolver::MixedSolver(const BemSystem& system, const TractionSpace& space, const std::vector<int>& nodes,
                         int n_fixed, std::span<const UnitLoad> loads, Control& control)
    : problem_(system, space, nodes, n_fixed, loads, control) {
    // Tractions and displacements have different units; without a common scale the condition would depend on these.
    auto tractions = problem_.unknown.rightCols(3 * space.n_slots());
    if (tractions.size() > 0) traction_scale_ = 1.0 / tractions.cwiseAbs().maxCoeff();
    tractions *= traction_scale_;
    control.begin_stage("factorise");
    lu_ = factorise_held<RefinedLu>(std::move(problem_.unknown), "mixed boundary system", &control);
    condition_ = lu_.size() > 0 ? 1.0 / lu_.reciprocal_condition() : 1.0;
}

NodeSolution MixedSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    const auto& [free, constrained] = problem_.partition;
    const Eigen::MatrixXd x = lu_.solve(problem_.right_side(prescribed));
    NodeSolution solution;
    solution.displacements.resize(std::ssize(free) + std::ssize(constrained), prescribed.cols());
    solution.displacements(free, Eigen::all) = x.topRows(std::ssize(free));
    solution.displacements(constrained, Eigen::all) = prescribed.topRows(std::ssize(constrained));
    if (want_loads) solution.loads = traction_scale_ * x.bottomRows(x.rows() - std::ssize(free));
    return solution;
}

BoundaryEqn9Solver::BoundaryEqn9Solver(const BemSystem& system, const TractionSpace& space,
                                       const std::vector<int>& nodes, int n_fixed, std::span<const UnitLoad> loads,
                                       Control& control)
    : problem_(system, space, nodes, n_fixed, loads, control),
      H00_inverse_(inverse_by_eqn9(system.bordered_inverse(), problem_.partition)) {
    const Eigen::Index q = 3 * space.n_slots(), n_free = H00_inverse_.rows();
    Eigen::MatrixXd small = -problem_.unknown.bottomRightCorner(q, q);
    small.noalias() +=
        problem_.unknown.bottomLeftCorner(q, n_free) * (H00_inverse_ * problem_.unknown.topRightCorner(n_free, q));
    tractions_ = factorise_held<LuFactorization>(std::move(small), "traction system of Eqn. 9", &control);
    condition_ = tractions_.size() > 0 ? 1.0 / tractions_.reciprocal_condition() : 1.0;
}

NodeSolution BoundaryEqn9Solver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    const auto& [free, constrained] = problem_.partition;
    const Eigen::Index n_free = H00_inverse_.rows(), q = tractions_.size();
    const Eigen::MatrixXd right = -problem_.right_side(prescribed);
    const Eigen::MatrixXd A0 = problem_.unknown.bottomLeftCorner(q, n_free),
                          minus_G0 = problem_.unknown.topRightCorner(n_free, q);
    const Eigen::MatrixXd loads = tractions_.solve(right.bottomRows(q) - A0 * (H00_inverse_ * right.topRows(n_free)));
    NodeSolution solution;
    solution.displacements.resize(std::ssize(free) + std::ssize(constrained), prescribed.cols());
    solution.displacements(free, Eigen::all) = -(H00_inverse_ * (minus_G0 * loads + right.topRows(n_free)));
    solution.displacements(constrained, Eigen::all) = prescribed.topRows(std::ssize(constrained));
    if (want_loads) solution.loads = loads;
    return solution;
}

double boundary_residual(const BemSystem& system, const TractionSpace& space, std::span<const UnitLoad> loads,
                         const NodeSolution& solution, Control& control) {
    Balance balance;
    const CollocationPoints nodes = system.nodes().subset(collocated(space, range(0, system.n_nodes())));
    const CollocationPoints points = inner_collocation_points(system.boundary(), space.interior_triangles);
    balance.add(system, space, loads, solution, some_of(nodes, kSampledSources), control);
    balance.add(system, space, loads, solution, some_of(points, kSampledSources), control);
    return balance.size > 0.0 ? std::sqrt(balance.off / balance.size) : 0.0;
}

}  // namespace elastolab
