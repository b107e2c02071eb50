#include "scene/live/drag_solver.hpp"

#include <limits>

#include "base/lapack.hpp"

namespace elastolab {

namespace {

/// Prescribed values are rounded when they are made: differences below this part of them mean nothing.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
/// Beyond this, columns times a motion might overflow: such motions are solved for, which fails when there is no
/// answer.
constexpr double kLargestMotion = 1e150;

/// Rows: 1 and, if `affine`, the rest positions about their mean, scaled to about 1.
Eigen::MatrixXd motion_shapes(const Positions& rest, bool affine) {
    Eigen::MatrixXd shapes = Eigen::MatrixXd::Ones(affine ? 4 : 1, rest.cols());
    if (!affine) return shapes;
    const Eigen::Matrix3Xd local = rest.colwise() - rest.rowwise().mean();
    const double radius = local.colwise().norm().maxCoeff();
    shapes.bottomRows(3) = local / (radius > 0.0 ? radius : 1.0);
    return shapes;
}

}  // namespace

DragSolver::DragSolver(std::shared_ptr<const Deformer> deformer, std::vector<int> handle_ends)
    : deformer_(std::move(deformer)), handle_ends_(std::move(handle_ends)) {}

void DragSolver::prepare(const Eigen::VectorXd& values, double tolerance, Control& control, const Approach& approach) {
    const bool turns = !deformer_->linear();  // about where it is by now
    int handle = kNone;
    bool affine = turns;  // until it is known that it is only shifted
    if (has_start(values)) {
        const Eigen::VectorXd change = values - start_values_;
        handle = changed_handle(change);
        if (handle >= 0 && handle != loads()) {
            const Eigen::Matrix3Xd moved = part_of(handle, change);
            affine = (moved.colwise() - moved.col(0)).cwiseAbs().maxCoeff() > tolerance_of(handle, moved);
        }
    }
    if (handle < 0) handle = turns && handle_ >= 0 ? handle_ : last_handle();
    if (handle < 0 && n_loads() > 0) handle = loads();
    if (handle < 0) return start(values, tolerance, control, approach);
    if (handle == loads()) return grab_loads(values, tolerance, control, approach);
    grab(values, handle, affine, tolerance, control, approach);
}

void DragSolver::converge(Control& control) {
    const Approach approach{response_.equilibrium, {}};
    if (handle_ == kNone) return start(start_values_, kSolveTolerance, control, approach);
    if (handle_ == loads()) return grab_loads(start_values_, kSolveTolerance, control, approach);
    grab(start_values_, handle_, shapes_.rows() > 1, kSolveTolerance, control, approach);
}

bool DragSolver::is_exact(const Eigen::VectorXd& values) const {
    return deformer_->linear() ? has(values) : has_start(values) && values == start_values_;
}

bool DragSolver::has(const Eigen::VectorXd& values) const {
    if (!has_start(values)) return false;
    const Eigen::VectorXd change = values - start_values_;
    const int handle = changed_handle(change);
    if (handle == loads()) return handle_ == handle;
    return handle == kNone || (handle >= 0 && parameters_of(handle, part_of(handle, change)));
}

void DragSolver::displace(const Eigen::VectorXd& values, Eigen::VectorXd& u) {
    Control control;
    deformer_->require_balance(values);  // columns of loads would answer to any values
    if (!has_start(values)) start(values, kSolveTolerance, control);
    const Eigen::VectorXd change = values - start_values_;
    const int handle = changed_handle(change);
    if (handle == loads()) {
        if (handle_ != handle) grab_loads(start_values_, kSolveTolerance, control);
        return response_.displace(values.tail(n_loads()) - start_values_.tail(n_loads()), u);
    }
    if (handle >= 0) {
        const Eigen::Matrix3Xd moved = part_of(handle, change);
        std::optional<Eigen::VectorXd> parameters = parameters_of(handle, moved);
        for (int affine = 0; affine <= 1 && !parameters; ++affine) {
            grab(start_values_, handle, affine == 1, kSolveTolerance, control);
            parameters = parameters_of(handle, moved);
        }
        if (parameters) return response_.displace(*parameters, u);
    }
    if (handle != kNone) start(values, kSolveTolerance, control);
    u = response_.rest;
}

bool DragSolver::has_start(const Eigen::VectorXd& values) const {
    return start_values_.size() == values.size() && response_.rest.size() > 0;
}

int DragSolver::last_handle() const {
    int handle = loads() - 1;
    while (handle >= 0 && size_of(handle) == 0) --handle;
    return handle;
}

/// The one handle whose values differ from those at the start.
int DragSolver::changed_handle(const Eigen::VectorXd& change) const {
    int changed = kNone;
    for (int h = 0; h < static_cast<int>(handle_ends_.size()); ++h) {
        if (change.segment(3 * begin_of(h), 3 * size_of(h)).isZero(0.0)) continue;
        if (changed != kNone) return kSeveral;
        changed = h;
    }
    if (change.tail(n_loads()).isZero(0.0)) return changed;
    return changed == kNone ? loads() : kSeveral;
}

Eigen::Matrix3Xd DragSolver::part_of(int handle, const Eigen::VectorXd& change) const {
    return Eigen::Map<const Eigen::Matrix3Xd>(change.data(), 3, (change.size() - n_loads()) / 3)
        .middleCols(begin_of(handle), size_of(handle));
}

void DragSolver::start(const Eigen::VectorXd& values, double tolerance, Control& control, const Approach& approach) {
    response_ = deformer_->drag_response(values, Eigen::MatrixXd(values.size(), 0), control, tolerance, approach);
    start_values_ = values;
    handle_ = kNone;
    tolerance_ = tolerance;
}

/// Columns of a handle about these values.
void DragSolver::grab(const Eigen::VectorXd& values, int handle, bool affine, double tolerance, Control& control,
                      const Approach& approach) {
    const Positions& all = deformer_->model().body().surface->vertices;
    Positions rest(3, size_of(handle));
    for (int i = 0; i < size_of(handle); ++i)
        rest.col(i) = all.col(deformer_->set().handles[static_cast<std::size_t>(begin_of(handle) + i)]);
    Eigen::MatrixXd shapes = motion_shapes(rest, affine);
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(values.size(), 3 * shapes.rows());
    for (Eigen::Index s = 0; s < shapes.rows(); ++s)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            for (int i = 0; i < size_of(handle); ++i)
                basis(3 * (begin_of(handle) + i) + axis, 3 * s + axis) = shapes(s, i);
    response_ = deformer_->drag_response(values, basis, control, tolerance, approach);
    start_values_ = values;
    fit_ = solve_minimum_norm(shapes, Eigen::MatrixXd::Identity(shapes.rows(), shapes.rows())).X;
    shapes_ = std::move(shapes);
    tolerance_ = tolerance;
    handle_ = handle;
}

/// Columns of all loads about these values.
void DragSolver::grab_loads(const Eigen::VectorXd& values, double tolerance, Control& control,
                            const Approach& approach) {
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(values.size(), n_loads());
    basis.bottomRows(n_loads()).setIdentity();
    response_ = deformer_->drag_response(values, basis, control, tolerance, approach);
    start_values_ = values;
    shapes_.resize(0, 0);
    tolerance_ = tolerance;
    handle_ = loads();
}

double DragSolver::tolerance_of(int handle, const Eigen::Matrix3Xd& change) const {
    const auto start = start_values_.segment(3 * begin_of(handle), 3 * size_of(handle));
    return kRounding * (change.cwiseAbs().maxCoeff() + start.cwiseAbs().maxCoeff());
}

/// The factors of the columns at hand that give this change of the handle; nothing when they do not span it.
std::optional<Eigen::VectorXd> DragSolver::parameters_of(int handle, const Eigen::Matrix3Xd& change) const {
    if (handle != handle_) return std::nullopt;
    const Eigen::MatrixXd parameters = change * fit_;  // 3 x shapes
    if (!(parameters.cwiseAbs().maxCoeff() < kLargestMotion)) return std::nullopt;
    if ((change - parameters * shapes_).cwiseAbs().maxCoeff() > tolerance_of(handle, change)) return std::nullopt;
    return Eigen::Map<const Eigen::VectorXd>(parameters.data(), parameters.size());
}

}  // namespace elastolab
