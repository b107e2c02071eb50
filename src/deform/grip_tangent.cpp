#include "deform/grip_tangent.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/lapack.hpp"
#include "deform/grip.hpp"
#include "elasticity/rotation.hpp"

namespace elastolab {

namespace {

/// Below this part of the largest, a stiffness counts as none: of rounding, and, where the body can move with the
/// grips, of columns that were iterated.
constexpr double kNoneIfHeld = 1e-12, kNoneIfFree = 1e-5;
constexpr double kLongestTurn = 0.5, kLongestShift = 0.3;

}  // namespace

GripPlace moved(const GripPlace& place, const Eigen::Matrix<double, 6, 1>& by) {
    const Eigen::Vector3d turn = by.tail<3>();
    return {place.shift + by.head<3>(),
            rotation_vector(rotation_by(turn) * rotation_by(place.turn), place.turn + turn)};
}

double longest_step(const std::vector<GripPlace>& places, double length, const Eigen::VectorXd& step) {
    double part = std::numeric_limits<double>::infinity();
    for (std::size_t g = 0; g < places.size(); ++g) {
        const auto own = step.segment<6>(6 * static_cast<Eigen::Index>(g));
        const double shift = own.head<3>().norm(), turn = own.tail<3>().norm();
        if (shift > 0.0) part = std::min(part, kLongestShift * (length + places[g].shift.norm()) / shift);
        if (turn > 0.0) part = std::min(part, kLongestTurn / turn);
    }
    return part;
}

GripTangent::GripTangent(const Eigen::MatrixXd& stiffness, double length, double young_modulus, bool held)
    : stiffness_(stiffness), length_(length), young_modulus_(young_modulus), held_(held) {
    scaled_ = units().asDiagonal() * stiffness * units().asDiagonal();
    if (stiffness.rows() == 0) return;
    SymmetricEigen modes = symmetric_eigen(0.5 * (scaled_ + scaled_.transpose()));
    values_ = std::move(modes.values);
    modes_ = std::move(modes.vectors);
    const double largest = values_.cwiseAbs().maxCoeff();
    const bool nothing = largest < kNothingHolds * young_modulus * length;
    none_ = nothing ? 2.0 * largest : (held ? kNoneIfHeld : kNoneIfFree) * largest;
}

GripTangent GripTangent::with_springs(const Eigen::VectorXd& springs) const {
    Eigen::MatrixXd stiffness = stiffness_;
    for (Eigen::Index g = 0; g < springs.size(); ++g) stiffness.diagonal().segment<3>(6 * g).array() += springs[g];
    return {stiffness, length_, young_modulus_, held_};
}

Eigen::VectorXd GripTangent::units() const {
    Eigen::VectorXd unit = Eigen::VectorXd::Ones(stiffness_.rows());
    for (Eigen::Index g = 0; 6 * g < unit.size(); ++g) unit.segment<3>(6 * g + 3).setConstant(1.0 / length_);
    return unit;
}

bool GripTangent::has_falling_motion() const { return (values_.array() < -none_).any(); }

/// Moments that keep their direction make the stiffness unsymmetric. Whether its complex eigenvalues are of motions
/// that grow depends on how the grips' mass resists turns beside shifts; nobody gives that, so that of some spread of
/// it suffices, from the body's size down to that of a small grip. What falls whatever the mass is not stable.
bool GripTangent::stable() const {
    if (!has_falling_motion()) return true;
    constexpr int kBody = 1, kSmallGrip = 64;  // parts of the body's size
    for (int parts = kBody; parts <= kSmallGrip; parts *= 2) {
        Eigen::VectorXd turns = Eigen::VectorXd::Ones(scaled_.rows());
        for (Eigen::Index g = 0; 6 * g < turns.size(); ++g) turns.segment<3>(6 * g + 3).setConstant(parts);
        if (real_parts_of_eigenvalues(turns.asDiagonal() * scaled_ * turns.asDiagonal())[0] >= -none_) return true;
    }
    return false;
}

Eigen::VectorXd GripTangent::newton_step(const Eigen::VectorXd& answered) const {
    const SingularValues all = singular_values(scaled_);
    const Eigen::VectorXd shares = all.U.transpose() * answered;
    return units().asDiagonal() * (all.V * (all.sigma.array() > none_).select(shares.cwiseQuotient(all.sigma), 0.0));
}

Eigen::VectorXd GripTangent::answered(const Eigen::VectorXd& forces) const {
    if (values_.size() == 0) return {};
    const Eigen::VectorXd shares = modes_.transpose() * (units().asDiagonal() * forces);
    return modes_ * (values_.cwiseAbs().array() > none_).select(shares, 0.0);
}

Eigen::VectorXd GripTangent::step(const Eigen::VectorXd& answered) const {
    if (values_.size() == 0) return {};
    if (values_[0] > none_) {
        const LuFactorization factored(Eigen::MatrixXd(scaled_), "stiffness of grips");
        return units().asDiagonal() * factored.solve(answered);
    }
    const Eigen::VectorXd shares = modes_.transpose() * answered, sizes = values_.cwiseAbs();
    return units().asDiagonal() * (modes_ * (sizes.array() > none_).select(shares.cwiseQuotient(sizes), 0.0));
}

Eigen::VectorXd GripTangent::softest() const { return units().asDiagonal() * modes_.col(0); }

}  // namespace elastolab
