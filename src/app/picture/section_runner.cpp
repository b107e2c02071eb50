#include "app/picture/section_runner.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <random>
#include <utility>

#include "base/lapack.hpp"
#include "base/timer.hpp"

namespace elastolab {

namespace {

/// Points at a time, and seconds that the worker goes on before it shows what it has.
constexpr Eigen::Index kPointsAtOnce = 64;
constexpr double kShowAfter = 0.2;
/// Above so many unknowns a further column costs too much, and only the present motion is evaluated.
constexpr int kManyUnknowns = 60000;
/// Part of a motion that columns need not span.
constexpr double kNegligible = 1e-6;
/// Singular value over the largest, up to which a direction is there by rounding only.
constexpr double kRounding = 1e-12;

/// Points in an order in which any first few are spread over all.
std::vector<Eigen::Index> scattered(Eigen::Index n) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    return order;
}

}  // namespace

SectionRunner::Cost SectionRunner::cost() const {
    if (!latest_) return {};
    return {latest_->shape->n_inside(), latest_->n_known, latest_->seconds};
}

Eigen::Matrix3Xd SectionRunner::displacements() const {
    Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, latest_->displacements.cols());
    for (Eigen::Index c = 0; c < coefficients_.size(); ++c)
        sum += coefficients_[c] * latest_->displacements.middleRows<3>(3 * c);
    return sum;
}

Eigen::Matrix<double, 6, -1> SectionRunner::stresses() const {
    Eigen::Matrix<double, 6, -1> sum = Eigen::Matrix<double, 6, -1>::Zero(6, latest_->stresses.cols());
    for (Eigen::Index c = 0; c < coefficients_.size(); ++c)
        sum += coefficients_[c] * latest_->stresses.middleRows<6>(6 * c);
    return sum;
}

/// The last group whose motion differs from what was asked for last; "fixed" never moves.
std::size_t SectionRunner::pulled_group(const EmbeddedRunner& answer) const {
    const std::vector<ConstraintGroup>& groups = answer.constraints().groups;
    const Eigen::VectorXd& values = answer.runner().values();
    const ConstrainedSet& set = answer.runner().deformer()->set();
    const Eigen::Index n_fixed = std::ssize(set.fixed), n_moved = 3 * std::ssize(set.handles);
    std::size_t pulled = groups.empty() ? 0 : groups.size() - 1;
    if (asked_.size() != values.size()) return pulled;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const Eigen::Index begin = 3 * (groups[g].begin - n_fixed), size = 3 * (groups[g].end - groups[g].begin);
        if (begin < 0 || begin + size > n_moved) continue;  // a group that the set does not have yet
        if (values.segment(begin, size) != asked_.segment(begin, size)) pulled = g;
    }
    return pulled;
}

std::shared_ptr<const SectionRunner::Basis> SectionRunner::make_basis(const EmbeddedRunner& answer, std::size_t group) {
    const Deformer& deformer = *answer.runner().deformer();
    const Eigen::VectorXd& values = answer.runner().values();
    const Positions& rest = deformer.model().body().surface->vertices;
    const std::vector<ConstraintGroup>& groups = answer.constraints().groups;
    const Eigen::Index n_fixed = std::ssize(deformer.set().fixed);
    Eigen::MatrixXd motions(values.size(), 0);
    const bool linear = deformer.linear();
    const bool fits = linear && group < groups.size() && groups[group].begin >= n_fixed &&
                      groups[group].end > groups[group].begin &&
                      groups[group].end - n_fixed <= std::ssize(deformer.set().handles) &&
                      deformer.model().facts().n_degrees_of_freedom <= kManyUnknowns;
    if (fits) {
        const Eigen::Index first = groups[group].begin - n_fixed, n = groups[group].end - groups[group].begin;
        Eigen::MatrixXd shapes = Eigen::MatrixXd::Ones(n, 4);  // 1, x, y, z
        for (Eigen::Index i = 0; i < n; ++i)
            shapes.block<1, 3>(i, 1) =
                rest.col(deformer.set().handles[static_cast<std::size_t>(first + i)]).transpose();
        const Eigen::RowVector3d middle = shapes.rightCols<3>().colwise().mean();
        shapes.rightCols<3>().rowwise() -= middle;
        const double size = shapes.rightCols<3>().cwiseAbs().maxCoeff();
        // A few vertices, or vertices on one line, have fewer independent motions.
        const Eigen::MatrixXd all =
            size > 0.0 ? Eigen::MatrixXd(shapes.array().rowwise() / Eigen::RowVector4d(1, size, size, size).array())
                       : Eigen::MatrixXd(shapes.col(0));
        const SingularValues span = singular_values(all);
        const Eigen::MatrixXd independent = span.U.leftCols((span.sigma.array() > kRounding * span.sigma[0]).count());
        motions = Eigen::MatrixXd::Zero(values.size(), 3 * independent.cols());
        for (Eigen::Index s = 0; s < independent.cols(); ++s)
            for (Eigen::Index axis = 0; axis < 3; ++axis)
                for (Eigen::Index i = 0; i < n; ++i) motions(3 * (first + i) + axis, 3 * s + axis) = independent(i, s);
    }
    // The part of the present motion that these do not span.
    const Eigen::VectorXd left = values - motions * (motions.transpose() * values);
    const bool has_more = left.norm() > kNegligible * values.norm() || motions.cols() == 0;
    auto basis = std::make_shared<Basis>();
    basis->linear = linear;
    basis->columns.resize(values.size(), motions.cols() + (has_more ? 1 : 0));
    basis->columns.leftCols(motions.cols()) = motions;
    if (has_more) basis->columns.rightCols(1) = left;
    basis->inverse = basis->columns.transpose();  // orthonormal, but for the length of the last
    if (const double square = left.squaredNorm(); has_more && square > 0.0) basis->inverse.bottomRows(1) /= square;
    return basis;
}

std::shared_ptr<const SectionRunner::Columns> SectionRunner::evaluate(Columns columns, Control& control) {
    control.begin_stage("inside");
    const Stopwatch watch;
    const Eigen::Index n = columns.shape->n_inside(), m = columns.basis->columns.cols();
    if (!columns.field) columns.field = columns.deformer->interior_field(columns.basis->columns, control);
    if (columns.known.empty()) {
        columns.known.assign(static_cast<std::size_t>(n), 0);
        columns.displacements = Eigen::MatrixXd::Zero(3 * m, n);
        columns.stresses = Eigen::MatrixXd::Zero(6 * m, n);
    }
    const std::vector<Eigen::Index> order = scattered(n);
    while (columns.n_known < n && (columns.n_known == 0 || watch.seconds() < kShowAfter)) {
        const Eigen::Index count = std::min(kPointsAtOnce, n - columns.n_known);
        Positions points(3, count);
        for (Eigen::Index i = 0; i < count; ++i)
            points.col(i) = columns.shape->inside().col(order[static_cast<std::size_t>(columns.n_known + i)]);
        const InteriorValues values = columns.field->at(points, control);
        for (Eigen::Index i = 0; i < count; ++i) {
            const Eigen::Index point = order[static_cast<std::size_t>(columns.n_known + i)];
            columns.known[static_cast<std::size_t>(point)] = 1;
            for (Eigen::Index c = 0; c < m; ++c) {
                columns.displacements.col(point).segment<3>(3 * c) = values.displacements.col(c).segment<3>(3 * i);
                columns.stresses.col(point).segment<6>(6 * c) = values.stresses.col(c).segment<6>(6 * i);
            }
        }
        columns.n_known += count;
    }
    if (columns.n_known < n) {
        columns.shape->fill(columns.known, columns.displacements);
        columns.shape->fill(columns.known, columns.stresses);
    }
    columns.seconds += watch.seconds();
    return std::make_shared<const Columns>(std::move(columns));
}

bool SectionRunner::spans(const Basis& basis, const Eigen::VectorXd& values) {
    if (!basis.linear) return values.size() == basis.columns.rows() && values == basis.columns.col(0);
    return (values - basis.columns * (basis.inverse * values)).norm() <= kNegligible * values.norm();
}

void SectionRunner::poll() {
    switch (job_.poll()) {
        case JobEvent::finished:
            latest_ = job_.take();
            kept_field_ = latest_->field;
            kept_basis_ = latest_->basis;
            kept_deformer_ = latest_->deformer;
            shown_.resize(0);
            failure_.clear();
            ++revision_;
            break;
        case JobEvent::failed:
            failure_ = job_.failure();
            break;
        case JobEvent::cancelled:
        case JobEvent::none:
            break;
    }
}

void SectionRunner::rest() {
    job_.cancel();
    job_.poll();
    if (latest_) ++revision_;
    latest_.reset();
    kept_field_.reset();
    deformer_.reset();
    shape_.reset();
    asked_.resize(0);
    failure_.clear();
}

void SectionRunner::update(const EmbeddedRunner& answer, const std::shared_ptr<const SectionShape>& shape) {
    poll();
    const MethodRunner& runner = answer.runner();
    const std::shared_ptr<const Deformer>& deformer = runner.deformer();
    const Eigen::VectorXd& values = runner.values();
    if (latest_ && (latest_->shape != shape || latest_->deformer != deformer)) {
        latest_.reset();
        ++revision_;
    }
    if (!deformer || values.size() != deformer->set().n_values() || values.size() == 0) return;
    if (!deformer->linear()) return update_at_equilibrium(answer, shape);
    is_current_ = true;
    if (latest_ && (shown_.size() != values.size() || shown_ != values)) {
        shown_ = values;
        coefficients_ =
            latest_->basis->linear ? Eigen::VectorXd(latest_->basis->inverse * values) : Eigen::VectorXd::Ones(1);
        ++revision_;
    }
    const bool same = deformer_.lock() == deformer && shape_.lock() == shape;
    // What runs for another cut or set is of no use; for another motion of this one it is, as far as it goes.
    if (same && (job_.running() || (!failure_.empty() && asked_ == values))) return;
    const bool spanned = latest_ && spans(*latest_->basis, values);
    if (same && spanned && latest_->n_known == shape->n_inside()) return;
    if (runner.converging()) return;  // by the iteration that these need too, which keeps its solutions
    Columns next;
    if (spanned) {
        next = *latest_;
    } else {
        next.shape = shape;
        next.deformer = deformer;
        // Another cut of the same solutions.
        const bool kept = kept_field_ && kept_deformer_.lock() == deformer && spans(*kept_basis_, values);
        next.basis = kept ? kept_basis_ : make_basis(answer, pulled_group(answer));
        if (kept) next.field = kept_field_;
    }
    start(std::move(next), values);
}

void SectionRunner::start(Columns next, const Eigen::VectorXd& values) {
    // What failed for another motion is said until it is known whether this one fails, too.
    if (deformer_.lock() != next.deformer || shape_.lock() != next.shape) failure_.clear();
    deformer_ = next.deformer;
    shape_ = next.shape;
    asked_ = values;
    job_.start([next = std::move(next)](Control& control) { return evaluate(next, control); });
}

/// One column: the values of the equilibrium itself.
void SectionRunner::update_at_equilibrium(const EmbeddedRunner& answer,
                                          const std::shared_ptr<const SectionShape>& shape) {
    const MethodRunner& runner = answer.runner();
    const std::shared_ptr<const Equilibrium> equilibrium = runner.equilibrium();
    const bool same = latest_ && equilibrium && latest_->equilibrium == equilibrium;
    if (same != is_current_ || coefficients_.size() != 1) ++revision_;
    is_current_ = same;
    coefficients_ = Eigen::VectorXd::Ones(1);
    if (!equilibrium || !runner.converged() || job_.running()) return;
    const bool failed = !failure_.empty() && deformer_.lock() == runner.deformer() && shape_.lock() == shape &&
                        asked_ == runner.values();
    if (failed || (same && latest_->n_known == shape->n_inside())) return;
    if (same) return start(*latest_, runner.values());
    Columns next;
    next.shape = shape;
    next.deformer = runner.deformer();
    next.equilibrium = equilibrium;
    next.basis = std::make_shared<const Basis>(Basis{runner.values(), {}});
    start(std::move(next), runner.values());
}

}  // namespace elastolab
