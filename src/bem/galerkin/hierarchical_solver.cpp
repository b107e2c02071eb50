#include "bem/galerkin/hierarchical_system.hpp"
#include "bem/hierarchical/free_modes.hpp"
#include "bem/hierarchical/item_rows.hpp"
#include "deform/conjugate_gradients.hpp"

namespace elastolab {

namespace {

/// Relative residual of the solves for tractions inside an iteration, some dozens of which add up to less than its
/// tolerance: over that, at first; and at most.
constexpr double kInnerOverTolerance = 0.01, kMostInnerResidual = 1e-3;

/// Rigid motions of closed surfaces, each by itself, that vanish at these positions: the hypersingular operator knows
/// nothing of them.
Eigen::MatrixXd loose_modes(const Eigen::MatrixXd& surface_modes, const std::vector<int>& positions) {
    Eigen::MatrixXd loose(surface_modes.rows(), 0);
    for (Eigen::Index first = 0; first < surface_modes.cols(); first += 6) {
        const Eigen::MatrixXd unseen = unseen_modes(surface_modes.middleCols<6>(first), positions);
        loose.conservativeResize(Eigen::NoChange, loose.cols() + unseen.cols());
        loose.rightCols(unseen.cols()) = unseen;
    }
    return loose;
}

/// A preconditioner that stays orthogonal to the free motions.
class Projected : public LinearOperator {
public:
    Projected(const LinearOperator& inner, const Eigen::MatrixXd& modes) : inner_(inner), modes_(modes) {}
    Eigen::Index size() const override { return inner_.size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        Eigen::MatrixXd own = X;
        orthogonalise(own, modes_);
        own = inner_.product(own);
        orthogonalise(own, modes_);
        return own;
    }

private:
    const LinearOperator& inner_;
    const Eigen::MatrixXd& modes_;
};

}  // namespace

class HierarchicalSolver::FreeBlock : public LinearOperator {
public:
    /// inner: residual of the first solves for tractions; progress: of the iteration that this is the matrix for.
    FreeBlock(const HierarchicalSolver& solver, double inner, const IterationReport& progress, Control& control)
        : solver_(solver), inner_(inner), progress_(progress), control_(control) {}
    Eigen::Index size() const override { return solver_.system_->size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        const double inner = inner_ / std::clamp(progress_.residual, inner_ / kMostInnerResidual, 1.0);
        Eigen::MatrixXd Y = solver_.operate(X, inner, control_);
        solver_.zero_constrained(Y);
        return Y;
    }

private:
    const HierarchicalSolver& solver_;
    const double inner_;
    const IterationReport& progress_;
    Control& control_;
};

HierarchicalSolver::HierarchicalSolver(std::shared_ptr<const HierarchicalSystem> system, std::vector<int> vertices,
                                       const GalerkinTractions& tractions, std::span<const UnitLoad> loads,
                                       bool must_hold, Control& control, std::int64_t most_factorised)
    : system_(std::move(system)), vertices_(std::move(vertices)) {
    std::vector<char> is_free(static_cast<std::size_t>(system_->tree()->size()), 1);
    for (const int v : vertices_) {
        positions_.push_back(system_->tree()->positions()[static_cast<std::size_t>(v)]);
        is_free[static_cast<std::size_t>(positions_.back())] = 0;
    }
    free_modes_ = unseen_modes(system_->body_modes(), positions_);
    held_ = free_modes_.cols() == 0;
    if (!held_ && must_hold) throw NotHeldError();
    control.begin_stage("integrate tractions");
    layers_ = std::make_unique<const TractionLayers>(*system_, tractions, most_factorised, control);
    if (!loads.empty()) {
        control.begin_stage("integrate loads");
        given_forces_ = to_tree_order(*system_->tree(), system_->given_nodal_forces(loads, control));
        given_layer_ = system_->given_single_layer(tractions, loads, control);
    }
    control.begin_stage("precondition");
    const Eigen::MatrixXd loose = loose_modes(system_->surface_modes(), positions_);
    Eigen::MatrixXd energies(loose.cols(), loose.cols());
    if (loose.cols() > 0) energies = loose.transpose() * operate(loose, kMostInnerResidual, control);
    preconditioner_ = std::make_unique<const SchwarzPreconditioner>(
        system_->matrix(), system_->boundary(), std::move(is_free), system_->surface_modes(), loose, energies, control);
}

void HierarchicalSolver::zero_constrained(Eigen::MatrixXd& rows) const { clear_rows(positions_, rows); }

/// K freed of the rigid motions of the body.
Eigen::MatrixXd HierarchicalSolver::double_layer(Eigen::MatrixXd u) const {
    orthogonalise(u, system_->body_modes());
    return layers_->double_layer(u);
}

Eigen::MatrixXd HierarchicalSolver::transposed_double_layer(const Eigen::MatrixXd& t) const {
    Eigen::MatrixXd f = layers_->transposed_double_layer(t);
    orthogonalise(f, system_->body_modes());
    return f;
}

/// V^-1 (K u - V g)
Eigen::MatrixXd HierarchicalSolver::tractions_of(const Eigen::MatrixXd& u, const Eigen::MatrixXd& factors,
                                                 double tolerance, Control& control) const {
    Eigen::MatrixXd right = double_layer(u);
    if (factors.rows() > 0) right.noalias() -= given_layer_ * factors;
    return layers_->solve_single_layer(right, tolerance, control);
}

/// (P D P + K^T V^-1 K) u
Eigen::MatrixXd HierarchicalSolver::operate(const Eigen::MatrixXd& u, double inner, Control& control) const {
    Eigen::MatrixXd f = system_->hypersingular(u);
    if (layers_->size() > 0) f += transposed_double_layer(tractions_of(u, {}, inner, control));
    return f;
}

Eigen::MatrixXd HierarchicalSolver::iterate(const Eigen::MatrixXd& prescribed, Eigen::MatrixXd start, double tolerance,
                                            Control& control) const {
    const double inner = kInnerOverTolerance * tolerance;
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(system_->size(), prescribed.cols());
    put_rows(prescribed, positions_, u);
    const Eigen::MatrixXd factors = factors_of(prescribed);
    Eigen::MatrixXd right = -system_->hypersingular(u);
    if (layers_->size() > 0) right -= transposed_double_layer(tractions_of(u, factors, inner, control));
    if (factors.rows() > 0) right.noalias() += given_forces_ * factors;
    zero_constrained(right);
    zero_constrained(start);
    orthogonalise(right, free_modes_);
    IterationReport progress;
    const FreeBlock free_block(*this, inner, progress, control);
    const Projected preconditioner(*preconditioner_, free_modes_);
    u += conjugate_gradients(free_block, preconditioner, right, {.tolerance = tolerance, .start = std::move(start)},
                             "Galerkin matrix of the free vertices", control, &progress);
    orthogonalise(u, free_modes_);
    return u;
}

Eigen::MatrixXd HierarchicalSolver::displacements(const Eigen::MatrixXd& prescribed, double tolerance,
                                                  Control& control) const {
    return recycled_.get(prescribed, system_->size(), tolerance,
                         [&](const Eigen::MatrixXd& new_ones, const Eigen::MatrixXd& start) {
                             return iterate(new_ones, start, tolerance, control);
                         });
}

NodeSolution HierarchicalSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, kSolveTolerance, control);
}

NodeSolution HierarchicalSolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double tolerance,
                                               Control& control) const {
    const Eigen::MatrixXd u = displacements(prescribed, tolerance, control);
    NodeSolution solution;
    solution.displacements = to_item_order(*system_->tree(), u);
    put_rows(prescribed, vertices_, solution.displacements);
    if (!want_loads) return solution;
    Eigen::MatrixXd f = system_->hypersingular(u), t(layers_->size(), u.cols());
    if (layers_->size() > 0) {
        t = tractions_of(u, factors_of(prescribed), kInnerOverTolerance * tolerance, control);
        f += transposed_double_layer(t);
    }
    if (given_forces_.cols() > 0) f.noalias() -= given_forces_ * factors_of(prescribed);
    const Eigen::MatrixXd reactions = rows_of(f, positions_);
    solution.loads.resize(reactions.rows() + t.rows(), u.cols());
    solution.loads << reactions, t;
    return solution;
}

}  // namespace elastolab
