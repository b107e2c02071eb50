#include "scene/drag_solver.hpp"

#include <Eigen/QR>
#include <limits>

namespace elastolab {

namespace {

/// Prescribed values are rounded when they are made: differences below this part of them mean nothing.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

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

void DragSolver::prepare(const Eigen::VectorXd& values) {
    start(values);
    if (!handle_ends_.empty()) grab(static_cast<int>(handle_ends_.size()) - 1, false);
}

void DragSolver::displace(const Eigen::VectorXd& values, Eigen::VectorXd& u) {
    if (start_values_.size() != values.size() || response_.rest.size() == 0) start(values);
    const Eigen::VectorXd change = values - start_values_;
    const int handle = changed_handle(change);
    if (handle >= 0) {
        const Eigen::Matrix3Xd moved = Eigen::Map<const Eigen::Matrix3Xd>(change.data(), 3, change.size() / 3)
                                           .middleCols(begin_of(handle), size_of(handle));
        if (handle == handle_ && follow(handle, moved, u)) return;
        for (const bool affine : {false, true}) {
            grab(handle, affine);
            if (follow(handle, moved, u)) return;
        }
    }
    if (handle != kNone) start(values);
    u = response_.rest;
}

/// The one handle whose values differ from those at the start.
int DragSolver::changed_handle(const Eigen::VectorXd& change) const {
    int changed = kNone;
    for (int h = 0; h < static_cast<int>(handle_ends_.size()); ++h) {
        if (change.segment(3 * begin_of(h), 3 * size_of(h)).isZero(0.0)) continue;
        if (changed != kNone) return kSeveral;
        changed = h;
    }
    return changed;
}

void DragSolver::start(const Eigen::VectorXd& values) {
    start_values_ = values;
    handle_ = kNone;
    response_ = {deformer_->displace(values), {}};
}

void DragSolver::grab(int handle, bool affine) {
    const Positions& all = deformer_->model().body().surface->vertices;
    Positions rest(3, size_of(handle));
    for (int i = 0; i < size_of(handle); ++i)
        rest.col(i) = all.col(deformer_->set().handles[static_cast<std::size_t>(begin_of(handle) + i)]);
    shapes_ = motion_shapes(rest, affine);
    fit_ = shapes_.completeOrthogonalDecomposition().pseudoInverse();
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(start_values_.size(), 3 * shapes_.rows());
    for (Eigen::Index s = 0; s < shapes_.rows(); ++s)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
            for (int i = 0; i < size_of(handle); ++i)
                basis(3 * (begin_of(handle) + i) + axis, 3 * s + axis) = shapes_(s, i);
    response_ = deformer_->drag_response(start_values_, basis);
    handle_ = handle;
}

/// Whether the columns at hand span this change of the handle; then u is done.
bool DragSolver::follow(int handle, const Eigen::Matrix3Xd& change, Eigen::VectorXd& u) {
    const Eigen::Matrix3Xd parameters = change * fit_;  // 3 x shapes
    const auto start = start_values_.segment(3 * begin_of(handle), 3 * size_of(handle));
    const double tolerance = kRounding * (change.cwiseAbs().maxCoeff() + start.cwiseAbs().maxCoeff());
    if ((change - parameters * shapes_).cwiseAbs().maxCoeff() > tolerance) return false;
    response_.displace(Eigen::Map<const Eigen::VectorXd>(parameters.data(), parameters.size()), u);
    return true;
}

}  // namespace elastolab
