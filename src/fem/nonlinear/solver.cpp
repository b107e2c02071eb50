#include "fem/nonlinear/solver.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>
#include <utility>

#include "elasticity/neo_hookean.hpp"

namespace elastolab {

namespace {

/// Angle of a step that the tangent predicts well [rad].
constexpr double kStepAngle = std::numbers::pi / 6.0;
/// Residual to which equilibria on the way are found.
constexpr double kPassing = 1e-3;
constexpr int kMostIterations = 40, kMostPassing = 30, kMostAltogether = 400;
/// Steps shorter than this part of the way are given up.
constexpr double kShortestPart = 1.0 / 512.0;
/// Residual at which a tangent was taken, up to which its factor serves the columns of the solution as a
/// preconditioner; their own tolerance over that of the solution: they tell its next change, which is a small one.
constexpr double kGoodTangent = 0.1, kColumnTolerance = 100.0;
constexpr int kFewIterations = 8, kMostColumnIterations = 60;
/// Smallest ratio of volumes that a predicted state may have: those below are far from any equilibrium.
constexpr double kCrushed = 0.05;
/// Part of the stiffness that keeps a free body from moving as a whole.
constexpr double kShift = 1e-8;
constexpr int kPushes = 3;
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
            throw NoEquilibriumError("these motions flatten a part of a handle.", rest_positions_.col(face[0]));
}

std::shared_ptr<const WarpedStart> NonlinearSolver::rest(ElementWork& work, Control& control) const {
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

NonlinearSolver::StatePtr NonlinearSolver::at_rest(ElementWork& work, Control& control) const {
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
    ElementWork work = elements().make_work();
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
            state = advance(*state, task.path.col(p), false, kPassing, work, control);
            iterations += state->facts().iterations;
        }
        const bool far = task.start == nullptr && task.path.cols() == 0;
        state = advance(*state, task.prescribed.col(c), far, tolerance, work, control);
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
                                             double tolerance, ElementWork& work, Control& control) const {
    const NewtonState at = state.with_factor();
    Eigen::MatrixXd all(at.u.size(), changes.cols());
    for (Eigen::Index c = 0; c < changes.cols(); ++c) all.col(c) = of_all_nodes(changes.col(c));
    Eigen::MatrixXd loads(all.rows(), all.cols());
    for (Eigen::Index c = 0; c < all.cols(); ++c)
        loads.col(c) = newton_.force_change(at.u, at.factors, all.col(c), factors_of(changes.col(c)), work, control);
    const FreeTangent& tangent = newton_.tangent();
    const Eigen::MatrixXd right = tangent.free_rows(loads);
    const auto by_iteration = [&](const SparseCholesky& its, int most) {
        return newton_.solve_tangent(at.u, at.factors, its, right, kColumnTolerance * tolerance, most, work, control);
    };
    // The factor of the last step is that of a state close by: a preconditioner that spares another factorisation.
    std::optional<Eigen::MatrixXd> solved;
    if (at.factor && at.stable && at.factor_residual <= kGoodTangent) solved = by_iteration(*at.factor, kFewIterations);
    if (!solved) {
        SparseMatrix K = newton_.tangent().make_matrix();
        bool stable = true;
        const auto factor = newton_.factor_at(at.u, at.factors, work, K, stable, control);
        if (!factor) throw SolveError("tangent stiffness: is not finite. Check the mesh for degenerate tetrahedra.");
        if (!stable || newton_.loads().follow()) solved = by_iteration(*factor, kMostColumnIterations);
        if (!solved) solved = factor->solve(right);
    }
    return all - tangent.all_rows(*solved);
}

/// The best that warping leads to; not converged where it does not.
NewtonState NonlinearSolver::warped(const MotionPath& path, const Eigen::VectorXd& factors, double tolerance,
                                    ElementWork& work, Control& control) const {
    const Eigen::VectorXd u =
        rest(work, control)->displace(of_all_nodes(path.logarithm()), of_all_nodes(path.at(1.0)), work, control);
    if (!(newton_.energy(u, work, control).least_J > kCrushed)) return {};
    keep(nullptr);
    return newton_.run(u, factors, tolerance, kMostIterations, work, control);
}

/// From one equilibrium to the next by predicted steps, which are halved where they fail.
NewtonState NonlinearSolver::followed(const NonlinearState& from, const MotionPath& path,
                                      const Eigen::VectorXd& factors, double tolerance, ElementWork& work,
                                      Control& control) const {
    NewtonState at = from.with_factor();
    at.iterations = 0;
    double part = 0.0, length = 1.0 / std::max(1.0, std::ceil(path.largest_angle() / kStepAngle - 1e-6));
    NewtonState failed;
    int iterations = 0;
    const Eigen::VectorXd before = at.factors;
    while (part < 1.0 && length >= kShortestPart && iterations < kMostAltogether) {
        control.checkpoint();
        const double next = part + length > 1.0 - 1e-9 ? 1.0 : part + length;
        const Eigen::VectorXd change = of_all_nodes(path.at(next)) - of_all_nodes(of_prescribed(at.u));
        const Eigen::VectorXd next_factors = next < 1.0 ? before + next * (factors - before) : factors;
        if (!at.factor) {
            SparseMatrix K = newton_.tangent().make_matrix();
            at.factor = newton_.factor_at(at.u, at.factors, work, K, at.stable, control);
            ++iterations;
        }
        const FreeTangent& tangent = newton_.tangent();
        const Eigen::VectorXd load =
            newton_.force_change(at.u, at.factors, change, next_factors - at.factors, work, control);
        const Eigen::VectorXd u = at.u + change - tangent.all_rows(at.factor->solve(tangent.free_rows(load)));
        const BodyEnergy energy = newton_.energy(u, work, control);
        if (!(energy.least_J > kCrushed * std::min(1.0, at.least_J))) {
            failed.crushed = energy.element;
            length *= 0.5;
            continue;
        }
        const double wanted = next < 1.0 ? std::max(kPassing, tolerance) : tolerance;
        const bool stable = at.stable;
        keep(nullptr);  // a factor less at the same time; where the step fails, it is made again
        NewtonState reached = newton_.run(u, next_factors, wanted, next < 1.0 ? kMostPassing : kMostIterations, work,
                                          control, std::exchange(at.factor, nullptr));
        if (reached.iterations == 0) reached.stable = stable;
        if (reached.converged) reached = stabilised(std::move(reached), wanted, work, control);
        iterations += reached.iterations;
        if (!reached.converged) {
            failed.crushed = reached.crushed;
            length *= 0.5;
            continue;
        }
        at = std::move(reached);
        keep(at.factor);
        part = next;
        length = std::min(2.0 * length, 1.0);
        if (part < 1.0 && path.largest_angle() > 0.0) length = std::min(length, kStepAngle / path.largest_angle());
    }
    at.iterations = iterations;
    if (part < 1.0) {
        failed.iterations = iterations;
        failed.u = at.u;
        return failed;
    }
    return at;
}

NonlinearSolver::StatePtr NonlinearSolver::advance(const NonlinearState& from, const Eigen::VectorXd& values, bool far,
                                                   double tolerance, ElementWork& work, Control& control) const {
    const Eigen::VectorXd present = of_prescribed(from.newton().u), prescribed = displacements_of(values),
                          factors = factors_of(values);
    if (present == prescribed && from.newton().factors == factors && from.newton().residual <= tolerance)
        return std::make_shared<const NonlinearState>(from.with_factor(), [&] {
            EquilibriumFacts facts = from.facts();
            facts.iterations = 0;
            return facts;
        }());
    require_faces(prescribed);
    const MotionPath path(rest_positions_, patches_, present, prescribed);
    NewtonState state;
    int iterations = 0;
    if (far && path.largest_angle() > 0.5 * kStepAngle) {
        state = warped(path, factors, tolerance, work, control);
        iterations = state.iterations;
    }
    if (!state.converged) {
        state = followed(from, path, factors, tolerance, work, control);
        state.iterations += iterations;
    }
    if (!state.converged) {
        const Eigen::Vector4i corners = elements().elements().col(std::max(state.crushed, 0)).head<4>();
        throw NoEquilibriumError(newton_.loads().size() > 0 ? "no equilibrium was found for these motions and loads."
                                                            : "no equilibrium was found for these motions.",
                                 elements().positions()(Eigen::all, corners).rowwise().mean());
    }
    return settled(std::move(state), tolerance, work, control);
}

NewtonState NonlinearSolver::stabilised(NewtonState state, double tolerance, ElementWork& work,
                                        Control& control) const {
    for (int push = 0; push < kPushes && !state.stable && state.factor; ++push) {
        const Eigen::VectorXd u = newton_.pushed(state, work, control);
        if (u == state.u) break;
        NewtonState left = newton_.run(u, state.factors, tolerance, 2 * kMostIterations, work, control);
        if (!left.converged || !(newton_.rise(state, left.u, left.energy) < 0.0)) break;
        left.iterations += state.iterations;
        state = std::move(left);
    }
    return state;
}

void NonlinearSolver::keep(std::shared_ptr<const SparseCholesky> factor) const {
    const std::scoped_lock lock(kept_mutex_);
    kept_ = std::move(factor);
}

NonlinearSolver::StatePtr NonlinearSolver::settled(NewtonState state, double tolerance, ElementWork& work,
                                                   Control& control) const {
    state = stabilised(std::move(state), tolerance, work, control);
    keep(state.factor);
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(state.u.size());
    EquilibriumFacts facts{.iterations = state.iterations,
                           .energy = state.energy,
                           .work_of_loads = newton_.loads().work(rest, state.u, state.factors),
                           .stable = state.stable};
    for (int e = 0; e < elements().n_elements(); ++e)
        for (int point = 0; point < elements().n_points(); ++point)
            facts.largest_stretch =
                std::max(facts.largest_stretch, largest_stretch(elements().gradient(state.u, e, point)));
    return std::make_shared<const NonlinearState>(std::move(state), facts);
}

}  // namespace elastolab
