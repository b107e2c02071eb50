#include "deform/grip.hpp"

#include <cassert>
#include <Eigen/Geometry>

#include "base/error.hpp"
#include "base/lapack.hpp"
#include "deform/loose_motions.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

namespace {

/// Below this part of the largest, a stiffness counts as none.
constexpr double kNoStiffness = 1e-10;
/// Forces that no motion answers, over the forces.
constexpr double kUnanswered = 1e-6;

/// Of the loads of a set, of size one.
Eigen::VectorXd gross_forces(const Deformer& deformer) {
    const std::vector<UnitLoad>& loads = deformer.set().loads;
    Eigen::VectorXd sizes(std::ssize(loads));
    for (Eigen::Index i = 0; i < sizes.size(); ++i)
        sizes[i] = gross_force(*deformer.model().body().surface, loads[static_cast<std::size_t>(i)]);
    return sizes;
}

}  // namespace

GripArms::GripArms(const Deformer& deformer, const std::vector<Grip>& grips) {
    const Positions& vertices = deformer.model().body().surface->vertices;
    length = (vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff()).norm();
    const std::vector<int>& handles = deformer.set().handles;
    for (const Grip& grip : grips) {
        const std::vector<int> patch(handles.begin() + grip.begin, handles.begin() + grip.end);
        arms.emplace_back(vertices(Eigen::all, patch));
        middles.emplace_back(arms.back().rowwise().mean());
        arms.back().colwise() -= middles.back();
    }
    std::vector<Eigen::MatrixXd> of_grips;
    Eigen::Index n_inert = 0;
    for (std::size_t g = 0; g < grips.size(); ++g) {
        const std::span<const int> patch(handles.begin() + grips[g].begin, handles.begin() + grips[g].end);
        of_grips.push_back(free_rigid_motions(vertices, patch, middles[g], length));
        n_inert += of_grips.back().cols();
    }
    inert = Eigen::MatrixXd::Zero(6 * std::ssize(grips), n_inert);
    Eigen::Index column = 0;
    for (Eigen::Index g = 0; g < std::ssize(grips); ++g) {
        const Eigen::MatrixXd& own = of_grips[static_cast<std::size_t>(g)];
        inert.block(6 * g, column, 6, own.cols()) = own;
        column += own.cols();
    }
}

Eigen::MatrixXd GripArms::working(const Eigen::MatrixXd& forces) const {
    const Eigen::VectorXd unit = units();
    return forces - unit.cwiseInverse().asDiagonal() * (inert * (inert.transpose() * (unit.asDiagonal() * forces)));
}

Eigen::VectorXd GripArms::units() const {
    Eigen::VectorXd unit = Eigen::VectorXd::Ones(6 * std::ssize(arms));
    for (Eigen::Index g = 0; g < std::ssize(arms); ++g) unit.segment<3>(6 * g + 3).setConstant(1.0 / length);
    return unit;
}

GripStiffness::GripStiffness(const Deformer& deformer, const Eigen::VectorXd& values, std::vector<Grip> grips,
                             Control& control)
    : grips_(std::move(grips)), arms_(deformer, grips_), load_size_(gross_forces(deformer)) {
    if (deformer.model().method().kind->shows_averages) unbalanced_ = kUnbalancedTriangles;
    assert(deformer.model().method().kind->linear);
    LooseMotions loose = loose_motions(deformer, grips_, arms_);
    loose_ = std::move(loose.motions);
    load_work_ = std::move(loose.work);
    const Eigen::Index n = 6 * std::ssize(grips_);
    set_others(deformer, values, control);
    matrix_.resize(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
        // Loads stay out of the columns, so that they need not balance there.
        Eigen::VectorXd unit = Eigen::VectorXd::Zero(values.size());
        Eigen::VectorXd motion = Eigen::VectorXd::Unit(n, k);
        move(motion, unit);
        matrix_.col(k) = resultants(deformer, unit, control);
    }
    const Eigen::VectorXd unit = arms_.units();
    const double largest = n == 0 ? 0.0 : (unit.asDiagonal() * matrix_ * unit.asDiagonal()).cwiseAbs().maxCoeff();
    if (largest < kNothingHolds * deformer.model().body().material.young_modulus * arms_.length) matrix_.setZero();
}

/// Force over moment about its middle of each grip, for these values.
Eigen::VectorXd GripStiffness::resultants(const Deformer& deformer, const Eigen::VectorXd& values,
                                          Control& control) const {
    const Reactions reactions = deformer.answer(values, {}, control).reactions;
    const Eigen::Index n_fixed = std::ssize(deformer.set().fixed);
    Eigen::VectorXd sums(6 * std::ssize(grips_));
    for (std::size_t g = 0; g < grips_.size(); ++g) {
        const Eigen::Index first = n_fixed + grips_[g].begin, count = grips_[g].end - grips_[g].begin;
        const Eigen::Vector3d force = reactions.forces.middleCols(first, count).rowwise().sum();
        const Eigen::Vector3d moment = reactions.moments.middleCols(first, count).rowwise().sum();
        sums.segment<6>(6 * static_cast<Eigen::Index>(g)) << force, moment - arms_.middles[g].cross(force);
    }
    return sums;
}

Eigen::VectorXd GripStiffness::others_of(const Eigen::VectorXd& values) const {
    Eigen::VectorXd others = values;
    move(Eigen::VectorXd::Zero(6 * std::ssize(grips_)), others);
    return others;
}

void GripStiffness::set_others(const Deformer& deformer, const Eigen::VectorXd& values, Control& control) {
    Eigen::VectorXd others = others_of(values);
    rest_ = resultants(deformer, others, control);
    others_ = std::move(others);
}

bool GripStiffness::is_for(const Eigen::VectorXd& values) const {
    return values.size() == others_.size() && others_of(values) == others_;
}

void GripStiffness::move(const Eigen::VectorXd& motions, Eigen::VectorXd& values) const {
    for (std::size_t g = 0; g < grips_.size(); ++g) {
        const auto motion = motions.segment<6>(6 * static_cast<Eigen::Index>(g));
        const Eigen::Vector3d shift = motion.head<3>(), turn = motion.tail<3>();
        const Eigen::Matrix3Xd& arms = arms_.arms[g];
        for (Eigen::Index i = 0; i < arms.cols(); ++i)
            values.segment<3>(3 * (grips_[g].begin + i)) = shift + turn.cross(arms.col(i).eval());
    }
}

Eigen::VectorXd GripStiffness::motions(const Eigen::VectorXd& forces, const Eigen::VectorXd& springs) const {
    if (grips_.empty()) return {};  // BLAS complains of matrices without rows
    const Eigen::VectorXd unit = arms_.units();
    Eigen::MatrixXd held = matrix_;
    for (Eigen::Index g = 0; g < springs.size(); ++g) held.diagonal().segment<3>(6 * g).array() += springs[g];
    Eigen::MatrixXd scaled = unit.asDiagonal() * arms_.working(held) * unit.asDiagonal();
    Eigen::VectorXd wanted = unit.asDiagonal() * arms_.working(forces - rest_);
    const Eigen::VectorXd asked = unit.asDiagonal() * forces;
    if ((arms_.inert.transpose() * asked).norm() > kUnanswered * asked.norm()) throw SolveError(unbalanced_);
    if (springs.isZero(0.0)) {
        const auto loads = others_.tail(load_size_.size());
        const double size = asked.norm() + load_size_.dot(loads.cwiseAbs());
        if ((loose_.transpose() * asked + load_work_ * loads).norm() > kUnanswered * size)
            throw SolveError(unbalanced_);
        scaled -= loose_ * (loose_.transpose() * scaled);
        wanted -= loose_ * (loose_.transpose() * wanted);
    }
    const Eigen::VectorXd motion = solve_minimum_norm(scaled, wanted, kNoStiffness).X;
    if (!((scaled * motion - wanted).norm() <= kUnanswered * (wanted.norm() + asked.norm())))
        throw SolveError(unbalanced_);
    return unit.asDiagonal() * motion;
}

}  // namespace elastolab
