#include "base/lapack.hpp"
#include "bem/hierarchical/system.hpp"
#include "deform/conjugate_gradients.hpp"

namespace elastolab {

namespace {

/// Of the residual, relative: prescribed displacements end at the rims in a jump, beside which a bend is small. And of
/// that of the tractions inside, of which some dozens add up to less, at first and at most.
constexpr double kIterationResidual = 1e-8, kInnerResidual = 1e-10, kMostInnerResidual = 1e-3;
/// A rigid motion counts as free when the constrained vertices see less than this part of what they see of another.
constexpr double kUnseen = 1e-9;
/// Columns of answers that are kept, and what a combination of them may miss.
constexpr Eigen::Index kMostKept = 16;
constexpr double kCombined = 1e-12;

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& all, const std::vector<int>& positions) {
    Eigen::MatrixXd rows(3 * std::ssize(positions), all.cols());
    for (std::size_t i = 0; i < positions.size(); ++i)
        rows.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = all.middleRows<3>(3 * positions[i]);
    return rows;
}

/// What these positions do not see of some orthonormal motions, orthonormal.
Eigen::MatrixXd unseen_motions(const Eigen::MatrixXd& motions, const std::vector<int>& positions) {
    const Eigen::MatrixXd seen = rows_of(motions, positions);
    Eigen::MatrixXd rows =
        Eigen::MatrixXd::Zero(std::max(seen.rows(), seen.cols()), seen.cols());  // so that V is square
    rows.topRows(seen.rows()) = seen;
    const SingularValues svd = singular_values(std::move(rows));
    const auto n_seen = (svd.sigma.array() > kUnseen * svd.sigma[0]).count();
    return motions * svd.V.rightCols(motions.cols() - n_seen);
}

void orthogonalise(Eigen::MatrixXd& X, const Eigen::MatrixXd& N) {
    if (N.cols() > 0) X.noalias() -= N * (N.transpose() * X).eval();
}

/// A preconditioner that stays orthogonal to the free motions.
class Projected : public LinearOperator {
public:
    Projected(const LinearOperator& inner, const Eigen::MatrixXd& motions) : inner_(inner), motions_(motions) {}
    Eigen::Index size() const override { return inner_.size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        Eigen::MatrixXd own = X;
        orthogonalise(own, motions_);
        own = inner_.product(own);
        orthogonalise(own, motions_);
        return own;
    }

private:
    const LinearOperator& inner_;
    const Eigen::MatrixXd& motions_;
};

}  // namespace

class HierarchicalSolver::FreeBlock : public LinearOperator {
public:
    /// progress: of the iteration that this is the matrix of.
    FreeBlock(const HierarchicalSolver& solver, const IterationReport& progress, Control& control)
        : solver_(solver), progress_(progress), control_(control) {}
    Eigen::Index size() const override { return solver_.system_->size(); }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        const double inner = kInnerResidual / std::clamp(progress_.residual, kInnerResidual / kMostInnerResidual, 1.0);
        Eigen::MatrixXd Y = solver_.operate(X, inner, control_);
        solver_.zero_constrained(Y);
        return Y;
    }

private:
    const HierarchicalSolver& solver_;
    const IterationReport& progress_;
    Control& control_;
};

HierarchicalSolver::HierarchicalSolver(std::shared_ptr<const HierarchicalSystem> system, std::vector<int> vertices,
                                       const GalerkinTractions& tractions, bool must_hold, Control& control)
    : system_(std::move(system)), vertices_(std::move(vertices)) {
    std::vector<char> is_free(static_cast<std::size_t>(system_->tree()->size()), 1);
    for (const int v : vertices_) {
        positions_.push_back(system_->tree()->positions()[static_cast<std::size_t>(v)]);
        is_free[static_cast<std::size_t>(positions_.back())] = 0;
    }
    free_motions_ = unseen_motions(system_->body_motions(), positions_);
    held_ = free_motions_.cols() == 0;
    if (!held_ && must_hold) throw NotHeldError();
    control.begin_stage("integrate tractions");
    layers_ = std::make_unique<const TractionLayers>(system_->pairs(), system_->surfaces(), tractions, system_->tree(),
                                                     system_->material(), system_->options(), control);
    control.begin_stage("precondition");
    preconditioner_ = std::make_unique<const SchwarzPreconditioner>(system_->matrix(), system_->boundary(),
                                                                    std::move(is_free), control);
}

void HierarchicalSolver::zero_constrained(Eigen::MatrixXd& rows) const {
    for (const int position : positions_) rows.middleRows<3>(3 * position).setZero();
}

/// K freed of the rigid motions of the body.
Eigen::MatrixXd HierarchicalSolver::double_layer(Eigen::MatrixXd u) const {
    orthogonalise(u, system_->body_motions());
    return layers_->double_layer(u);
}

Eigen::MatrixXd HierarchicalSolver::transposed_double_layer(const Eigen::MatrixXd& t) const {
    Eigen::MatrixXd f = layers_->transposed_double_layer(t);
    orthogonalise(f, system_->body_motions());
    return f;
}

Eigen::MatrixXd HierarchicalSolver::tractions_of(const Eigen::MatrixXd& u, double tolerance, Control& control) const {
    return layers_->solve_single_layer(double_layer(u), tolerance, control);
}

/// (P D P + K^T V^-1 K) u
Eigen::MatrixXd HierarchicalSolver::operate(const Eigen::MatrixXd& u, double inner, Control& control) const {
    Eigen::MatrixXd f = system_->hypersingular(u);
    if (layers_->size() > 0) f += transposed_double_layer(tractions_of(u, inner, control));
    return f;
}

Eigen::MatrixXd HierarchicalSolver::iterate(const Eigen::MatrixXd& prescribed, Control& control) const {
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(system_->size(), prescribed.cols());
    for (std::size_t i = 0; i < positions_.size(); ++i)
        u.middleRows<3>(3 * positions_[i]) = prescribed.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    Eigen::MatrixXd right = -operate(u, kInnerResidual, control);
    zero_constrained(right);
    orthogonalise(right, free_motions_);
    IterationReport progress;
    const FreeBlock free_block(*this, progress, control);
    const Projected preconditioner(*preconditioner_, free_motions_);
    u += conjugate_gradients(free_block, preconditioner, right, {.tolerance = kIterationResidual},
                             "Galerkin matrix of the free vertices", control, &progress);
    orthogonalise(u, free_motions_);
    return u;
}

/// Columns that are combinations of kept answers are taken from them; returns the numbers of the others.
std::vector<Eigen::Index> HierarchicalSolver::combine(const Eigen::MatrixXd& prescribed, Eigen::MatrixXd& u) const {
    const std::scoped_lock lock(mutex_);
    std::vector<Eigen::Index> others;
    Eigen::MatrixXd shares(answers_.prescribed.cols(), prescribed.cols()), missed = -prescribed;
    if (shares.rows() > 0) {
        shares = solve_minimum_norm(answers_.prescribed, prescribed, kCombined).X;
        missed.noalias() += answers_.prescribed * shares;
    }
    for (Eigen::Index c = 0; c < prescribed.cols(); ++c)
        if (missed.col(c).stableNorm() <= kCombined * prescribed.col(c).stableNorm())
            u.col(c) = shares.rows() > 0 ? Eigen::VectorXd(answers_.displacements * shares.col(c))
                                         : Eigen::VectorXd::Zero(u.rows());
        else
            others.push_back(c);
    return others;
}

Eigen::MatrixXd HierarchicalSolver::displacements(const Eigen::MatrixXd& prescribed, Control& control) const {
    Eigen::MatrixXd u(system_->size(), prescribed.cols());
    const std::vector<Eigen::Index> others = combine(prescribed, u);
    if (others.empty()) return u;
    const Eigen::MatrixXd new_prescribed = prescribed(Eigen::all, others), answers = iterate(new_prescribed, control);
    u(Eigen::all, others) = answers;
    const std::scoped_lock lock(mutex_);
    const Eigen::Index n_old = answers_.prescribed.cols();
    if (n_old + answers.cols() <= kMostKept) {
        Answers all{Eigen::MatrixXd(prescribed.rows(), n_old + answers.cols()),
                    Eigen::MatrixXd(u.rows(), n_old + answers.cols())};
        if (n_old > 0) all.prescribed.leftCols(n_old) = answers_.prescribed;
        if (n_old > 0) all.displacements.leftCols(n_old) = answers_.displacements;
        all.prescribed.rightCols(answers.cols()) = new_prescribed;
        all.displacements.rightCols(answers.cols()) = answers;
        answers_ = std::move(all);
    } else if (answers.cols() <= kMostKept) {
        answers_ = {new_prescribed, answers};
    }
    return u;
}

NodeSolution HierarchicalSolver::solve(const Eigen::MatrixXd& prescribed, bool want_loads) const {
    Control control;
    return solve_watched(prescribed, want_loads, control);
}

NodeSolution HierarchicalSolver::solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads,
                                               Control& control) const {
    const Eigen::MatrixXd u = displacements(prescribed, control);
    NodeSolution solution{to_item_order(*system_->tree(), u), {}};
    for (std::size_t i = 0; i < vertices_.size(); ++i)
        solution.displacements.middleRows<3>(3 * vertices_[i]) =
            prescribed.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    if (!want_loads) return solution;
    Eigen::MatrixXd f = system_->hypersingular(u), t(layers_->size(), u.cols());
    if (layers_->size() > 0) {
        t = tractions_of(u, kInnerResidual, control);
        f += transposed_double_layer(t);
    }
    const Eigen::MatrixXd reactions = rows_of(f, positions_);
    solution.loads.resize(reactions.rows() + t.rows(), u.cols());
    solution.loads << reactions, t;
    return solution;
}

}  // namespace elastolab
