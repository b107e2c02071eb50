#include "deform/moved_grips.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "deform/loose_motions.hpp"
#include "elasticity/rotation.hpp"

namespace elastolab {

namespace {

/// Up to rounding.
constexpr double kSame = 1e-9;

Eigen::Vector3d moment_of(const Eigen::Matrix3Xd& arms, const Eigen::Matrix3Xd& forces) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < arms.cols(); ++i) sum += arms.col(i).cross(forces.col(i));
    return sum;
}

}  // namespace

MovedGrips::MovedGrips(const Deformer& deformer, const std::vector<Grip>& grips, const std::vector<GripForce>& forces)
    : deformer_(deformer),
      grips_(grips),
      wanted_(forces),
      n_fixed_(std::ssize(deformer.set().fixed)),
      rest_(deformer, grips) {
    const Eigen::MatrixXd loose = loose_motions(deformer, grips, rest_).motions;
    body_is_held_ = loose.cols() == 0;
    const Eigen::MatrixXd translations =
        Eigen::MatrixXd::Identity(6, 3).replicate(std::ssize(grips), 1) / std::sqrt(std::ssize(grips));
    free_translations_.resize(n(), 0);
    for (const auto& t : translations.colwise())
        if ((loose * (loose.transpose() * t)).isApprox(t, kSame)) {
            free_translations_.conservativeResize(Eigen::NoChange, free_translations_.cols() + 1);
            free_translations_.rightCols<1>() = t;
        }
}

void MovedGrips::put(const std::vector<GripPlace>& places, Eigen::VectorXd& values) const {
    for (std::size_t g = 0; g < grips_.size(); ++g) {
        const Eigen::Matrix3Xd arms = present(places, g);
        for (Eigen::Index i = 0; i < arms.cols(); ++i)
            values.segment<3>(3 * (grips_[g].begin + i)) = places[g].shift + arms.col(i) - rest_.arms[g].col(i);
    }
}

Eigen::MatrixXd MovedGrips::basis(const std::vector<GripPlace>& places, Eigen::Index n_values) const {
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n_values, n());
    for (std::size_t g = 0; g < grips_.size(); ++g) {
        const Eigen::Matrix3Xd arms = present(places, g);
        const Eigen::Index first = 6 * static_cast<Eigen::Index>(g);
        for (Eigen::Index i = 0; i < arms.cols(); ++i) {
            const Eigen::Index row = 3 * (grips_[g].begin + i);
            basis.block<3, 3>(row, first).setIdentity();
            basis.block<3, 3>(row, first + 3) = -cross_matrix(arms.col(i));
        }
    }
    return basis;
}

Eigen::VectorXd MovedGrips::resultants(const std::vector<GripPlace>& places, const Eigen::Matrix3Xd& forces) const {
    Eigen::VectorXd sums(n());
    for (std::size_t g = 0; g < grips_.size(); ++g) {
        const Eigen::Matrix3Xd arms = present(places, g);
        sums.segment<6>(6 * static_cast<Eigen::Index>(g)) << own(g, forces).rowwise().sum(),
            moment_of(arms, own(g, forces));
    }
    return sums;
}

Eigen::MatrixXd MovedGrips::stiffness(const std::vector<GripPlace>& places, const Deformer::Answer& answer) const {
    Eigen::MatrixXd matrix(n(), n());
    for (Eigen::Index k = 0; k < n(); ++k)
        matrix.col(k) = resultants(places, answer.force_changes[static_cast<std::size_t>(k)]);
    for (std::size_t g = 0; g < grips_.size(); ++g) {
        const Eigen::Matrix3Xd arms = present(places, g);
        const Eigen::Matrix3Xd forces = own(g, answer.reactions.forces);
        const Eigen::Index first = 6 * static_cast<Eigen::Index>(g);
        for (Eigen::Index i = 0; i < arms.cols(); ++i)
            matrix.block<3, 3>(first + 3, first + 3) += cross_matrix(forces.col(i)) * cross_matrix(arms.col(i));
    }
    matrix -= matrix * free_translations_ * free_translations_.transpose();
    matrix -= free_translations_ * (free_translations_.transpose() * matrix);
    for (std::size_t g = 0; g < grips_.size(); ++g)
        matrix.diagonal().segment<3>(6 * static_cast<Eigen::Index>(g)).array() += wanted_[g].spring;
    return matrix;
}

Eigen::VectorXd MovedGrips::wanted(const std::vector<GripPlace>& places) const {
    Eigen::VectorXd all(n());
    for (std::size_t g = 0; g < grips_.size(); ++g)
        all.segment<6>(6 * static_cast<Eigen::Index>(g)) << wanted_[g].force - wanted_[g].spring * places[g].shift,
            wanted_[g].moment;
    return all;
}

Eigen::Matrix3Xd MovedGrips::present(const std::vector<GripPlace>& places, std::size_t grip) const {
    return rotation_by(places[grip].turn) * rest_.arms[grip];
}

Eigen::Matrix3Xd MovedGrips::own(std::size_t grip, const Eigen::Matrix3Xd& all) const {
    return all.middleCols(n_fixed_ + grips_[grip].begin, grips_[grip].end - grips_[grip].begin);
}

}  // namespace elastolab
