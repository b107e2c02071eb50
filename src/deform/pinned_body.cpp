#include "deform/pinned_body.hpp"

#include <Eigen/Geometry>

#include "base/lapack.hpp"
#include "deform/holds.hpp"

namespace elastolab {

namespace {

using Eigen::Vector3d;

/// The vertex that is not taken and farthest by this measure.
template <class Distance>
int farthest(const Positions& positions, std::span<const int> taken, const Distance& distance) {
    std::vector<char> is_taken(static_cast<std::size_t>(positions.cols()), 0);
    for (const int v : taken) is_taken[static_cast<std::size_t>(v)] = 1;
    int best = -1;
    double largest = -1.0;
    for (int v = 0; v < static_cast<int>(positions.cols()); ++v) {
        const double d = is_taken[static_cast<std::size_t>(v)] ? -1.0 : distance(Vector3d(positions.col(v)));
        if (d > largest) {
            best = v;
            largest = d;
        }
    }
    return best;
}

/// Adds three vertices far from each other, or those that are left.
void add_pins(const Positions& positions, std::vector<int>& vertices) {
    Vector3d from = positions.rowwise().mean(), line = Vector3d::Zero();
    for (int pin = 0; pin < 3 && std::ssize(vertices) < positions.cols(); ++pin) {
        const int v = farthest(positions, vertices, [&](const Vector3d& x) {
            return pin < 2 ? (x - from).norm() : (x - from).cross(line).norm();
        });
        vertices.push_back(v);
        if (pin == 1) line = (positions.col(v) - from).normalized();
        if (pin == 0) from = positions.col(v);
    }
}

}  // namespace

PinnedBody::PinnedBody(const Positions& positions, std::span<const int> vertices, const Eigen::VectorXd& values,
                       const Eigen::VectorXd& first)
    : positions_(positions),
      first_(first.head(positions.size())),
      n_constrained_(std::ssize(vertices)),
      vertices_(vertices.begin(), vertices.end()),
      values_(values) {
    if (holds(positions, vertices)) return;
    add_pins(positions, vertices_);
    is_held_ = holds(positions, vertices_);
    if (!is_held_) {
        vertices_.resize(static_cast<std::size_t>(n_constrained_));
        return;
    }
    values_.resize(values.size() + 3 * (std::ssize(vertices_) - n_constrained_));
    values_.head(3 * n_constrained_) = values.head(3 * n_constrained_);
    for (Eigen::Index i = n_constrained_; i < std::ssize(vertices_); ++i)
        values_.segment<3>(3 * i) = first.segment<3>(3 * vertices_[static_cast<std::size_t>(i)]);
    const Eigen::Index n_factors = values.size() - 3 * n_constrained_;
    values_.tail(n_factors) = values.tail(n_factors);
}

ReferenceAnswer PinnedBody::released(ReferenceAnswer second) const {
    if (!is_pinned()) return second;
    second.reactions = {second.reactions.forces.leftCols(n_constrained_).eval(),
                        second.reactions.moments.leftCols(n_constrained_).eval()};
    const Vector3d centre = positions_.rowwise().mean();
    const double size = (positions_.colwise() - centre).colwise().norm().maxCoeff();
    const Eigen::MatrixXd motions = free_rigid_motions(
        positions_, std::span(vertices_).first(static_cast<std::size_t>(n_constrained_)), centre, size);
    Eigen::MatrixXd moved(positions_.size(), motions.cols());
    for (Eigen::Index m = 0; m < motions.cols(); ++m)
        for (Eigen::Index v = 0; v < positions_.cols(); ++v)
            moved.col(m).segment<3>(3 * v) =
                motions.col(m).head<3>() +
                Vector3d(motions.col(m).tail<3>()).cross(Vector3d(positions_.col(v) - centre)) / size;
    const Eigen::VectorXd difference = second.displacements - first_;
    second.displacements -= moved * solve_minimum_norm(moved, difference).X;
    return second;
}

}  // namespace elastolab
