#include "fem/nonlinear/patch_motion.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <numeric>

#include "base/lapack.hpp"
#include "elasticity/rotation.hpp"

namespace elastolab {

namespace {

/// The rotation that fits best, target ~ R source, columns about their means; the identity for points on one line.
Eigen::Matrix3d best_rotation(const Eigen::Matrix3Xd& source, const Eigen::Matrix3Xd& target) {
    const Eigen::Matrix3d spread = source * source.transpose();
    const Eigen::Vector3d squares = symmetric_eigen(spread).values;
    if (!(squares[1] > 1e-8 * squares[2])) return Eigen::Matrix3d::Identity();
    return nearest_rotation(target * source.transpose());
}

/// V in exp([w, v]) = [exp(w), V v].
Eigen::Matrix3d screw_shift(const Eigen::Vector3d& turn) {
    const double angle = turn.norm();
    const Eigen::Matrix3d W = cross_matrix(turn);
    if (angle < 1e-4) return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
    const double square = angle * angle;
    return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / square * W +
           (angle - std::sin(angle)) / (square * angle) * W * W;
}

int root_of(std::vector<int>& parent, int i) {
    const auto at = [&](int k) -> int& { return parent[static_cast<std::size_t>(k)]; };
    while (at(i) != i) i = at(i) = at(at(i));  // halves the way for the next one
    return i;
}

}  // namespace

MotionPath::MotionPath(const Positions& rest, const std::vector<int>& patch, const Eigen::VectorXd& from,
                       const Eigen::VectorXd& to)
    : to_(to),
      rest_(rest),
      start_(rest + from.reshaped(3, rest.cols())),
      end_(rest + to.reshaped(3, rest.cols())),
      patch_(patch),
      growth_(Eigen::Matrix3Xd::Zero(3, rest.cols())) {
    const int n_patches = patch.empty() ? 0 : 1 + *std::max_element(patch.begin(), patch.end());
    std::vector<std::vector<int>> members(static_cast<std::size_t>(n_patches));
    for (std::size_t i = 0; i < patch.size(); ++i)
        if (patch[i] >= 0) members[static_cast<std::size_t>(patch[i])].push_back(static_cast<int>(i));
    for (const std::vector<int>& nodes : members) {
        screws_.push_back(fit(nodes));
        const Screw& screw = screws_.back();
        largest_angle_ = std::max(largest_angle_, screw.turn.norm());
        const Eigen::Matrix3d R = rotation_by(screw.turn);
        const Eigen::Vector3d t = screw_shift(screw.turn) * screw.shift;
        for (const int i : nodes) growth_.col(i) = R.transpose() * (end_.col(i) - t) - start_.col(i);
    }
}

MotionPath::Screw MotionPath::fit(const std::vector<int>& nodes) const {
    const Eigen::Matrix3Xd source = start_(Eigen::all, nodes), target = end_(Eigen::all, nodes);
    const Eigen::Vector3d from = source.rowwise().mean(), to = target.rowwise().mean();
    const Eigen::Matrix3d R = best_rotation(source.colwise() - from, target.colwise() - to);
    const Eigen::AngleAxisd rotation(R);
    Screw screw;
    screw.turn = rotation.angle() * rotation.axis();
    screw.shift = screw_shift(screw.turn).inverse() * (to - R * from);
    return screw;
}

Eigen::VectorXd MotionPath::at(double part) const {
    if (part == 1.0) return to_;
    Eigen::VectorXd u(3 * rest_.cols());
    for (Eigen::Index i = 0; i < rest_.cols(); ++i) {
        const int patch = patch_[static_cast<std::size_t>(i)];
        Eigen::Vector3d x;
        if (patch < 0) {
            x = (1.0 - part) * start_.col(i) + part * end_.col(i);
        } else {
            const Screw& screw = screws_[static_cast<std::size_t>(patch)];
            const Eigen::Vector3d turn = part * screw.turn;
            x = rotation_by(turn) * (start_.col(i) + part * growth_.col(i)) + screw_shift(turn) * (part * screw.shift);
        }
        u.segment<3>(3 * i) = x - rest_.col(i);
    }
    return u;
}

Eigen::VectorXd MotionPath::logarithm() const {
    Eigen::VectorXd v(3 * rest_.cols());
    for (Eigen::Index i = 0; i < rest_.cols(); ++i) {
        const int patch = patch_[static_cast<std::size_t>(i)];
        if (patch < 0) {
            v.segment<3>(3 * i) = end_.col(i) - start_.col(i);
            continue;
        }
        const Screw& screw = screws_[static_cast<std::size_t>(patch)];
        v.segment<3>(3 * i) = cross_matrix(screw.turn) * start_.col(i) + screw.shift + growth_.col(i);
    }
    return v;
}

std::vector<int> patches_of_nodes(const Eigen::MatrixXi& elements, int n_nodes, const std::vector<int>& constrained,
                                  int n_fixed) {
    std::vector<int> place(static_cast<std::size_t>(n_nodes), -1);
    const int n = static_cast<int>(constrained.size());
    for (int i = n_fixed; i < n; ++i) place[static_cast<std::size_t>(constrained[static_cast<std::size_t>(i)])] = i;
    std::vector<int> parent(constrained.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (const auto& element : elements.colwise()) {
        int first = -1;
        for (const int node : element) {
            const int i = place[static_cast<std::size_t>(node)];
            if (i < 0) continue;
            if (first < 0) first = i;
            const int a = root_of(parent, first), b = root_of(parent, i);
            parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        }
    }
    std::vector<int> patch(constrained.size(), -1), number(constrained.size(), -1);
    int next = 0;
    for (int i = n_fixed; i < n; ++i) {
        int& its = number[static_cast<std::size_t>(root_of(parent, i))];
        if (its < 0) its = next++;
        patch[static_cast<std::size_t>(i)] = its;
    }
    return patch;
}

}  // namespace elastolab
