#include "deform/bem_solvers.hpp"

#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace elastolab {

namespace {

constexpr double kSingular = 1e-14;
constexpr int kSourcesAtOnce = 192;

void require_held(const LuFactorization& lu) {
    if (lu.size() > 0 && lu.reciprocal_condition() < kSingular)
        throw SolveError(
            "constraints: leave the body free to move as a whole. Constrain three vertices that are not on "
            "one line, or use the reduced update, which takes the smallest motion.");
}

/// Constrained nodes at which the integral equation is still asked to hold.
std::vector<int> collocated(const LoadPlan& plan, const std::vector<int>& nodes) {
    std::vector<int> kept;
    for (const int node : nodes)
        if (std::find(plan.dropped_collocation.begin(), plan.dropped_collocation.end(), node) ==
            plan.dropped_collocation.end())
            kept.push_back(node);
    return kept;
}

std::vector<int> free_nodes(const Partition& partition) {
    std::vector<int> nodes;
    for (std::size_t i = 0; i < partition.free.size(); i += 3) nodes.push_back(static_cast<int>(partition.free[i] / 3));
    return nodes;
}

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& matrix, const std::vector<int>& nodes) {
    return matrix(Partition(matrix.rows(), nodes).constrained, Eigen::all);
}

/// Where a strip of equations is off, and how large its terms are.
struct Balance {
    double off = 0.0, size = 0.0;

    void add(const BemSystem& system, const LoadPlan& plan, const NodeSolution& solution, const Sources& sources,
             Control& control) {
        for (int first = 0; first < sources.size(); first += kSourcesAtOnce) {
            std::vector<int> numbers(static_cast<std::size_t>(std::min(kSourcesAtOnce, sources.size() - first)));
            std::iota(numbers.begin(), numbers.end(), first);
            const Sources strip = sources.subset(numbers);
            const Eigen::MatrixXd H = system.double_layer(strip, control);
            const Eigen::MatrixXd G = system.single_layer(strip, plan.elements, control);
            const Eigen::VectorXd u = solution.displacements.col(0), q = solution.loads.col(0);
            off += (H * u - G * q).squaredNorm();
            size += (H.cwiseAbs() * u.cwiseAbs() + G.cwiseAbs() * q.cwiseAbs()).squaredNorm();
        }
    }
};

}  // namespace

MixedProblem::MixedProblem(const BemSystem& system, const LoadPlan& plan, const std::vector<int>& nodes,
                           Control& control)
    : partition(3 * system.n_nodes(), nodes) {
    const std::vector<int> at = collocated(plan, nodes), free = free_nodes(partition);
    const Sources points = interior_sources(system.boundary(), plan.interior_triangles);
    const Eigen::Index n_at = 3 * std::ssize(at), n_points = 3 * points.size();
    {
        const auto H = system.whole_double_layer(control);
        H0 = (*H)(partition.free, Eigen::all);
        A.resize(n_at + n_points, H->cols());
        A.topRows(n_at) = rows_of(*H, at);
    }
    A.bottomRows(n_points) = system.double_layer(points, control);
    G0 = system.single_layer(system.nodes().subset(free), plan.elements, control);
    Gp.resize(n_at + n_points, 3 * plan.n_slots());
    Gp.topRows(n_at) = system.single_layer(system.nodes().subset(at), plan.elements, control);
    Gp.bottomRows(n_points) = system.single_layer(points, plan.elements, control);
}

MixedSolver::MixedSolver(const BemSystem& system, const LoadPlan& plan, const std::vector<int>& nodes, Control& control)
    : partition_(3 * system.n_nodes(), nodes), n_nodes3_(3 * system.n_nodes()) {
    const MixedProblem problem(system, plan, nodes, control);
    const Eigen::Index n0 = problem.H0.rows(), n1 = problem.A.rows();
    Eigen::MatrixXd mixed(n0 + n1, n0 + n1);
    mixed << problem.H0(Eigen::all, partition_.free), -problem.G0, problem.A(Eigen::all, partition_.free), -problem.Gp;
    known_.resize(n0 + n1, std::ssize(partition_.constrained));
    known_ << problem.H0(Eigen::all, partition_.constrained), problem.A(Eigen::all, partition_.constrained);
    lu_ = LuFactorization(std::move(mixed), "mixed boundary system");
    require_held(lu_);
    condition_ = lu_.size() > 0 ? 1.0 / lu_.reciprocal_condition() : 1.0;
}

NodeSolution MixedSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    const Eigen::MatrixXd x = lu_.solve(-known_ * prescribed);
    NodeSolution solution;
    solution.displacements.resize(n_nodes3_, prescribed.cols());
    solution.displacements(partition_.free, Eigen::all) = x.topRows(std::ssize(partition_.free));
    solution.displacements(partition_.constrained, Eigen::all) = prescribed;
    if (want_loads) solution.loads = x.bottomRows(x.rows() - std::ssize(partition_.free));
    return solution;
}

BoundaryEqn9Solver::BoundaryEqn9Solver(const BemSystem& system, const LoadPlan& plan, const std::vector<int>& nodes,
                                       Control& control)
    : problem_(system, plan, nodes, control),
      H00_inverse_(inverse_by_eqn9(system.bordered_inverse(), problem_.partition)) {
    const Eigen::MatrixXd A0 = problem_.A(Eigen::all, problem_.partition.free);
    Eigen::MatrixXd small = problem_.Gp;
    small.noalias() -= A0 * (H00_inverse_ * problem_.G0);
    tractions_ = LuFactorization(std::move(small), "traction system of Eqn. 9");
    require_held(tractions_);
    condition_ = tractions_.size() > 0 ? 1.0 / tractions_.reciprocal_condition() : 1.0;
}

NodeSolution BoundaryEqn9Solver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    const auto& [free, constrained] = problem_.partition;
    const Eigen::MatrixXd H01 = problem_.H0(Eigen::all, constrained), A1 = problem_.A(Eigen::all, constrained);
    const Eigen::MatrixXd A0 = problem_.A(Eigen::all, free);
    const Eigen::MatrixXd h = H01 * prescribed;
    const Eigen::MatrixXd q = tractions_.solve(A1 * prescribed - A0 * (H00_inverse_ * h));
    NodeSolution solution;
    solution.displacements.resize(problem_.H0.cols(), prescribed.cols());
    solution.displacements(free, Eigen::all) = H00_inverse_ * (problem_.G0 * q - h);
    solution.displacements(constrained, Eigen::all) = prescribed;
    if (want_loads) solution.loads = q;
    return solution;
}

double boundary_residual(const BemSystem& system, const LoadPlan& plan, const NodeSolution& solution,
                         Control& control) {
    std::vector<int> rows = collocated(plan, [&] {
        std::vector<int> all(static_cast<std::size_t>(system.n_nodes()));
        std::iota(all.begin(), all.end(), 0);
        return all;
    }());
    Balance balance;
    balance.add(system, plan, solution, system.nodes().subset(rows), control);
    balance.add(system, plan, solution, interior_sources(system.boundary(), plan.interior_triangles), control);
    return balance.size > 0.0 ? std::sqrt(balance.off / balance.size) : 0.0;
}

}  // namespace elastolab
