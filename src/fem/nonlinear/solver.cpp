#include "fem/nonlinear/solver.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>
#include <utility>

#include "elasticity/neo_hookean.hpp"

namespace elastolab {

namespace {

/// Residual of the linear systems for the columns of the solution: of a rough one, and over the tolerance of an exact
/// one. They tell its next change, which is a small one.
constexpr double kRoughColumns = 0.1, kExactColumns = 100.0;
constexpr int kMostColumnIterations = 60;
/// Part of the stiffness that keeps a free body from moving as a whole.
constexpr double kShift = 1e-8;
/// A prescribed triangle with less than this part of its area is flattened to a line.
constexpr double kFlattened = 1e-6;

double shift_of(const FiniteElements& elements, const Material& material, bool held) {
    return held ? 0.0 : kShift * material.young_modulus * elements.edge();
}

}  // namespace

NonlinearSolver::NonlinearSolver(std::shared_ptr<const FiniteElements> elements, const Material& material,
                                 PrescribedNodes nodes, Control& control, NonlinearLoads loads)
    : nodes_(std::move(nodes)),
      patches_(patches_of_nodes(elements->elements(), elements->n_nodes(), nodes_.nodes, nodes_.n_fixed)),
      rest_positions_(elements->positions()(Eigen::all, nodes_.nodes)),
      newton_(std::make_shared<const FreeTangent>(elements, nodes_.nodes, control), material,
              shift_of(*elements, material, nodes_.held), std::move(loads)) {
    held_ = nodes_.held;
    find_faces();
}

void NonlinearSolver::find_faces() {
    std::vector<int> place(static_cast<std::size_t>(elements().n_nodes()), -1);
    for (std::size_t i = 0; i < nodes_.nodes.size(); ++i)
        place[static_cast<std::size_t>(nodes_.nodes[i])] = static_cast<int>(i);
    for (int e = 0; e < elements().n_elements(); ++e)
        for (int opposite = 0; opposite < 4; ++opposite) {
            Eigen::Vector3i face;
            for (int c = 0; c < 3; ++c)
                face[c] = place[static_cast<std::size_t>(elements().elements()((opposite + 1 + c) % 4, e))];
            if (face.minCoeff() >= 0 && face.maxCoeff() >= nodes_.n_fixed) faces_.push_back(face);
        }
}

void NonlinearSolver::require_faces(const Eigen::VectorXd& prescribed) const {
    const Positions present = rest_positions_ + prescribed.reshaped(3, rest_positions_.cols());
    const auto area = [](const Positions& x, const Eigen::Vector3i& face) {
        const Eigen::Vector3d a = x.col(face[1]) - x.col(face[0]), b = x.col(face[2]) - x.col(face[0]);
        return a.cross(b).norm();
    };
    for (const Eigen::Vector3i& face : faces_)
        if (!(area(present, face) > kFlattened * area(rest_positions_, face)))
            throw NoEquilibriumError("these motions flatten a part of a handle. The body is crushed most near",
                                     rest_positions_.col(face[0]));
}

std::shared_ptr<const WarpedStart> NonlinearSolver::rest(NewtonWork& work, Control& control) const {
    const std::scoped_lock lock(rest_mutex_);
    if (!rest_) rest_ = std::make_shared<const WarpedStart>(newton_, work, control);
    return rest_;
}

Eigen::VectorXd NonlinearSolver::of_all_nodes(const Eigen::VectorXd& prescribed) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * elements().n_nodes());
    for (std::size_t i = 0; i < nodes_.nodes.size(); ++i)
        all.segment<3>(3 * nodes_.nodes[i]) = prescribed.segment<3>(3 * static_cast<Eigen::Index>(i));
    return all;
}

Eigen::VectorXd NonlinearSolver::of_prescribed(const Eigen::VectorXd& all) const {
    Eigen::VectorXd prescribed(3 * std::ssize(nodes_.nodes));
    for (std::size_t i = 0; i < nodes_.nodes.size(); ++i)
        prescribed.segment<3>(3 * static_cast<Eigen::Index>(i)) = all.segment<3>(3 * nodes_.nodes[i]);
    return prescribed;
}

NonlinearSolver::StatePtr NonlinearSolver::at_rest(NewtonWork& work, Control& control) const {
    NewtonState state;
    state.u = Eigen::VectorXd::Zero(3 * elements().n_nodes());
    state.factors = newton_.loads().none();
    state.converged = true;
    state.factor = rest(work, control)->rest();
    return std::make_shared<const NonlinearState>(std::move(state), EquilibriumFacts{});
}

NodeSolution NonlinearSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kSolveTolerance, control);
}

NodeSolution NonlinearSolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                                            Control& control) const {
    return solve_task({.prescribed = prescribed, .want_loads = want_loads}, tolerance, control);
}

NodeSolution NonlinearSolver::solve_task(const NodeTask& task, double tolerance, Control& control) const {
    const Loan lent(work_, [this] { return std::make_unique<NewtonWork>(newton_.make_work()); });
    NewtonWork& work = *lent;
    const Eigen::Index m = task.prescribed.cols(), k = task.changes.cols();
    NodeSolution solution;
    solution.displacements.resize(3 * elements().n_nodes(), m + k);
    if (task.want_loads) solution.loads.setZero(3 * std::ssize(nodes_.nodes), m + k);
    StatePtr first;
    for (Eigen::Index c = 0; c < m; ++c) {
        StatePtr state;
        if (const auto* start = dynamic_cast<const NonlinearState*>(task.start))
            state = std::make_shared<const NonlinearState>(*start);
        else
            state = at_rest(work, control);
        int iterations = 0;
        for (Eigen::Index p = 0; p < task.path.cols(); ++p) {
            state = advance(*state, task.path.col(p), false, kPassing, task.most_steps, work, control);
            iterations += state->facts().iterations;
        }
        const bool far = task.start == nullptr && task.path.cols() == 0;
        state = advance(*state, task.prescribed.col(c), far, tolerance, task.most_steps, work, control);
        EquilibriumFacts facts = state->facts();
        facts.iterations += iterations;
        state = std::make_shared<const NonlinearState>(state->with_factor(), facts);
        solution.displacements.col(c) = state->newton().u;
        if (task.want_loads)
            solution.loads.col(c) =
                of_prescribed(newton_.forces(state->newton().u, state->newton().factors, work, control));
        if (task.want_loads && c == 0)
            solution.resultants = newton_.loads().resultants(state->newton().u, state->newton().factors);
        if (c == 0) first = state;
        solution.state = state;
    }
    if (k > 0) solution.displacements.rightCols(k) = derivatives(*first, task.changes, tolerance, work, control);
    for (Eigen::Index c = m; c < m + k && task.want_loads; ++c)
        solution.loads.col(c) = of_prescribed(newton_.force_change(first->newton().u, first->newton().factors,
                                                                   solution.displacements.col(c),
                                                                   factors_of(task.changes.col(c - m)), work, control));
    return solution;
}

Eigen::MatrixXd NonlinearSolver::derivatives(const NonlinearState& state, const Eigen::MatrixXd& changes,
                                             double tolerance, NewtonWork& work, Control& control) const {
    const NewtonState at = state.with_factor();
    Eigen::MatrixXd all(at.u.size(), changes.cols());
    for (Eigen::Index c = 0; c < changes.cols(); ++c) all.col(c) = of_all_nodes(changes.col(c));
    Eigen::MatrixXd loads(all.rows(), all.cols());
    for (Eigen::Index c = 0; c < all.cols(); ++c)
        loads.col(c) = newton_.force_change(at.u, at.factors, all.col(c), factors_of(changes.col(c)), work, control);
    const FreeTangent& tangent = newton_.tangent();
    const Eigen::MatrixXd right = tangent.free_rows(loads);
    const double part = tolerance < kFirstTolerance ? kExactColumns * tolerance : kRoughColumns;
    // The factor of a state close by: a preconditioner that spares another factorisation.
    std::optional<Eigen::MatrixXd> solved;
    if (at.factor && at.stable)
        if (NearSolution near =
                newton_.solve_near(at.u, at.factors, *at.factor, right, part, kFewIterations, work, control);
            near.converged && !near.indefinite)
            solved = std::move(near.X);
    if (!solved) {
        bool stable = true;
        const auto factor = newton_.factor_at(at.u, at.factors, work, stable, control);
        if (!factor) throw SolveError(kNoTangent);
        if (!stable || newton_.loads().follow())
            solved =
                newton_.solve_tangent(at.u, at.factors, *factor, right, part, kMostColumnIterations, work, control);
        if (!solved) solved = factor->solve(right);
    }
    return all - tangent.all_rows(*solved);
}

}  // namespace elastolab
