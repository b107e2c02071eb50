#include "scene/motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>
#include <numbers>

#include "base/lapack.hpp"
#include "base/overloaded.hpp"
#include "elasticity/rotation.hpp"

namespace elastolab {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRigid = 1e-9;         ///< what rounding leaves of a turn
constexpr double kRoundedMove = 1e-14;  ///< of a position, in what a stretch about a point leaves of a move
constexpr double kNearTurn = 1.6;       ///< between a rotation vector and the one it continues [radians]
constexpr double kNoTurn = 1e-13;       ///< [degree]
constexpr double kSamePatch = 0.01;     ///< of its size: two places of a vertex that look the same
constexpr double kFlatPatch = 1e-6;     ///< square of its extent along a direction, over the largest

/// A rotation vector, along the axis and as long as the angle [radians].
Vector3d vector_of(const Rotation& rotation) { return kDegree * rotation.degrees * rotation.axis.stableNormalized(); }

Matrix3d matrix_of(const Rotation& rotation) {
    const double angle = kDegree * std::remainder(rotation.degrees, 360.0);
    return Eigen::AngleAxisd(angle, rotation.axis.stableNormalized()).toRotationMatrix();
}

/// The middle of the vertices as the matrix of `motion` leaves it.
Vector3d middle_before_turn(const AffineMotion& motion, const Positions& rest) {
    const Vector3d middle = rest.rowwise().mean();
    return middle + motion.matrix * middle;
}

/// A rotation and a symmetric stretch: map = rotation * stretch.
struct Polar {
    Matrix3d rotation, stretch;
};
/// A mirroring map has no rotation that leads to it: all of it is the stretch.
Polar polar(const Matrix3d& map) {
    if (!(map.determinant() > 0.0)) return {Matrix3d::Identity(), map};
    const Matrix3d rotation = nearest_rotation(map);
    return {rotation, rotation.transpose() * map};
}

/// The rotation about the same axis or, from none, about the new one; nothing where the axes differ.
std::optional<Rotation> added(const Rotation& before, const Vector3d& turn) {
    const Vector3d own = before.degrees == 0.0 ? turn.stableNormalized() : before.axis.stableNormalized();
    const double along = own.dot(turn);
    if ((turn - along * own).norm() > kRigid * turn.norm()) return std::nullopt;
    Rotation sum = before;
    if (before.degrees == 0.0) sum.axis = own;
    sum.degrees += along / kDegree;
    return sum;
}

/// Whole turns beyond what a scene file may hold are left out.
double without_excess(double degrees) {
    const double excess = std::max(0.0, std::abs(degrees) - kMostDegrees);
    return degrees - std::copysign(360.0 * std::ceil(excess / 360.0), degrees);
}

AffineMotion turned(const AffineMotion& motion, const Vector3d& turn, const Vector3d& center, const Positions& rest) {
    const Matrix3d identity = Matrix3d::Identity(), before = matrix_of(motion.rotate), next = rotation_by(turn);
    AffineMotion result = motion;
    if (motion.rotate.degrees == 0.0) result.rotate.center = middle_before_turn(motion, rest);
    if (const auto sum = added(result.rotate, turn)) {
        result.rotate = *sum;
    } else {
        const Vector3d guess = vector_of(motion.rotate) + turn;
        const Vector3d vector = rotation_vector(next * before, guess);
        const bool near = std::abs(motion.rotate.degrees) <= 180.0 || (vector - guess).norm() < kNearTurn;
        if (near) result.rotate.axis = vector.stableNormalized();
        if (near) result.rotate.degrees = vector.norm() / kDegree;
        if (!near) result.matrix = before.transpose() * next * before * (identity + motion.matrix) - identity;
    }
    if (std::abs(result.rotate.degrees) < kNoTurn) result.rotate = {};
    result.rotate.degrees = without_excess(result.rotate.degrees);
    // Both ways to write where a vertex goes agree for every y = x + matrix x of `motion`.
    const Vector3d& old_center = motion.rotate.center;
    const Vector3d at_zero = next * (old_center - before * old_center + motion.translate - center) + center;
    result.translate = at_zero - result.rotate.center + matrix_of(result.rotate) * result.rotate.center;
    return result;
}

AffineMotion transformed(const AffineMotion& motion, const Matrix3d& map, const Vector3d& center) {
    const Matrix3d identity = Matrix3d::Identity(), turn = matrix_of(motion.rotate);
    const Vector3d at_zero = motion.rotate.center - turn * motion.rotate.center;
    AffineMotion result = motion;
    result.matrix = turn.transpose() * map * turn * (identity + motion.matrix) - identity;
    result.translate = map * (at_zero + motion.translate - center) + center - at_zero;
    return result;
}

AffineMotion part_of(const AffineMotion& motion, double part, const Positions& rest) {
    const Matrix3d identity = Matrix3d::Identity();
    const Polar whole = polar(identity + motion.matrix);
    const Matrix3d own = rotation_by(Vector3d(part * rotation_vector(whole.rotation, Vector3d::Zero())));
    const Matrix3d map = own * (identity + part * (whole.stretch - identity));
    const Vector3d middle = rest.rowwise().mean(), after = middle_before_turn(motion, rest);
    AffineMotion result = motion;
    result.matrix = map - identity;
    result.rotate.degrees *= part;
    result.translate =
        matrix_of(result.rotate) * (after - map * middle) + (1.0 - part) * (middle - after) + part * motion.translate;
    return result;
}

}  // namespace

AffineMap map_of(const AffineMotion& motion) {
    if (motion.rotate.degrees == 0.0) return {motion.matrix, motion.translate};
    const Matrix3d turn = matrix_of(motion.rotate), less = turn - Matrix3d::Identity();
    return {less + turn * motion.matrix, motion.translate - less * motion.rotate.center};
}

AffineMotion rigid_motion(const Eigen::Vector3d& shift, const Eigen::Vector3d& turn, const Eigen::Vector3d& center) {
    if (turn.isZero(0.0)) return {.translate = shift};
    return {.translate = shift,
            .rotate = {.axis = turn.stableNormalized(), .degrees = turn.stableNorm() / kDegree, .center = center}};
}

Eigen::Matrix3Xd displacements(const Motion& motion, const Positions& rest) {
    Eigen::Matrix3Xd u(3, rest.cols());
    std::visit(Overloaded{[&](const AffineMotion& affine) {
                              const AffineMap map = map_of(affine);
                              for (Eigen::Index i = 0; i < u.cols(); ++i) u.col(i) = map.displacement(rest.col(i));
                          },
                          [&](const VertexMotion& single) {
                              assert(rest.cols() == std::ssize(single.displacements));
                              for (Eigen::Index i = 0; i < u.cols(); ++i)
                                  u.col(i) = single.displacements[static_cast<std::size_t>(i)];
                          }},
               motion);
    return u;
}

Motion motion_to(const Positions& rest, const Positions& present) {
    const Eigen::Index n = rest.cols();
    const Vector3d middle = rest.rowwise().mean(), to = present.rowwise().mean();
    const Positions arms = rest.colwise() - middle, turned = present.colwise() - to;
    if (arms.isZero(0.0)) return AffineMotion{.translate = to - middle};
    const SymmetricEigen spread = symmetric_eigen(arms * arms.transpose());
    const double least = kFlatPatch * spread.values[2];
    AffineMotion motion;
    if (spread.values[1] > least) {  // the vertices are not on a line
        const Matrix3d products = turned * arms.transpose(), turn = nearest_rotation(products);
        // Along directions in which the patch has no extent, nothing stretches.
        Matrix3d stretch = Matrix3d::Zero();
        for (int k = 0; k < 3; ++k) {
            const Vector3d along = spread.vectors.col(k);
            stretch += (spread.values[k] > least ? Vector3d(turn.transpose() * (products * along) / spread.values[k])
                                                 : along) *
                       along.transpose();
        }
        motion = rigid_motion(Vector3d::Zero(), rotation_vector(turn, Vector3d::Zero()), stretch * middle);
        motion.matrix = stretch - Matrix3d::Identity();
        motion.translate = to - stretch * middle;
    }
    const double size = arms.colwise().norm().maxCoeff();
    const Positions missed = rest + displacements(motion, rest) - present;
    if (missed.colwise().norm().maxCoeff() <= kSamePatch * size) return motion;
    VertexMotion single;
    for (Eigen::Index i = 0; i < n; ++i) single.displacements.emplace_back(present.col(i) - rest.col(i));
    return single;
}

Motion translated(const Motion& motion, const Eigen::Vector3d& shift) {
    Motion result = motion;
    std::visit(Overloaded{[&](AffineMotion& affine) { affine.translate += shift; },
                          [&](VertexMotion& single) {
                              for (Vector3d& u : single.displacements) u += shift;
                          }},
               result);
    return result;
}

Motion transformed(const Motion& motion, const Eigen::Matrix3d& map, const Eigen::Vector3d& center,
                   const Positions& rest) {
    Motion result = motion;
    std::visit(Overloaded{[&](AffineMotion& affine) { affine = transformed(affine, map, center); },
                          [&](VertexMotion& single) {
                              assert(rest.cols() == std::ssize(single.displacements));
                              for (std::size_t i = 0; i < single.displacements.size(); ++i) {
                                  const Vector3d x = rest.col(static_cast<Eigen::Index>(i));
                                  Vector3d& u = single.displacements[i];
                                  u = center + map * (x + u - center) - x;
                              }
                          }},
               result);
    return result;
}

Motion turned(const Motion& motion, const Eigen::Vector3d& turn, const Eigen::Vector3d& center, const Positions& rest) {
    if (turn.isZero(0.0)) return motion;
    if (const auto* affine = std::get_if<AffineMotion>(&motion)) return turned(*affine, turn, center, rest);
    return transformed(motion, rotation_by(turn), center, rest);
}

Motion part_of(const Motion& motion, double part, const Positions& rest) {
    Motion result = motion;
    std::visit(Overloaded{[&](AffineMotion& affine) { affine = part_of(affine, part, rest); },
                          [&](VertexMotion& single) {
                              for (Vector3d& u : single.displacements) u *= part;
                          }},
               result);
    return result;
}

double turn_between(const Motion& from, const Motion& to) {
    const auto turn = [](const Motion& motion) -> Vector3d {
        const auto* affine = std::get_if<AffineMotion>(&motion);
        return affine ? vector_of(affine->rotate) : Vector3d::Zero();
    };
    return (turn(to) - turn(from)).norm() / kDegree;
}

std::optional<Motion> between(const Motion& from, const Motion& to, double part) {
    const auto *a = std::get_if<AffineMotion>(&from), *b = std::get_if<AffineMotion>(&to);
    if (a == nullptr || b == nullptr) return std::nullopt;
    const auto mixed = [part](const auto& x, const auto& y) { return (x + part * (y - x)).eval(); };
    Rotation first = a->rotate, second = b->rotate;
    if (first.degrees == 0.0) first = {second.axis, 0.0, second.center};
    if (second.degrees == 0.0) second = {first.axis, 0.0, first.center};
    const Vector3d axis = first.axis.stableNormalized();
    const double same = axis.dot(second.axis.stableNormalized());
    if (std::abs(same) < 1.0 - kRigid) return std::nullopt;
    const double angle = same > 0.0 ? second.degrees : -second.degrees;
    return AffineMotion{.matrix = mixed(a->matrix, b->matrix),
                        .translate = mixed(a->translate, b->translate),
                        .rotate = {.axis = axis,
                                   .degrees = first.degrees + part * (angle - first.degrees),
                                   .center = mixed(first.center, second.center)}};
}

std::optional<Placement> placement_of(const Motion& motion, const Positions& rest) {
    const auto* affine = std::get_if<AffineMotion>(&motion);
    if (affine == nullptr) return std::nullopt;
    const Matrix3d identity = Matrix3d::Identity(), map = identity + affine->matrix;
    const double scale = std::cbrt(map.determinant());
    if (!(scale > 0.0)) return std::nullopt;
    const Matrix3d own = map / scale;
    if (!((own.transpose() * own - identity).norm() < kRigid)) return std::nullopt;
    Vector3d turn = affine->rotate.degrees * affine->rotate.axis.stableNormalized();
    if ((own - identity).norm() >= kRigid) {
        if (!turn.isZero(0.0)) return std::nullopt;
        turn = rotation_vector(own, Vector3d::Zero()) / kDegree;
    }
    Vector3d move = mean_displacement(motion, rest);
    const double rounding = kRoundedMove * rest.cwiseAbs().maxCoeff();
    for (double& along : move)
        if (std::abs(along) < rounding) along = 0.0;
    return Placement{move, turn.array() + 0.0, scale};  // + 0: no "-0"
}

AffineMotion motion_of(const Placement& placement, const Positions& rest) {
    const double stretch = placement.scale - 1.0;
    const Vector3d middle = rest.rowwise().mean();
    AffineMotion motion{.matrix = stretch * Matrix3d::Identity(), .translate = placement.move - stretch * middle};
    if (placement.turn.isZero(0.0)) return motion;
    motion.rotate = {.axis = placement.turn.stableNormalized(),
                     .degrees = placement.turn.stableNorm(),
                     .center = placement.scale * middle};
    return motion;
}

Eigen::Vector3d mean_displacement(const Motion& motion, const Positions& rest) {
    if (const auto* affine = std::get_if<AffineMotion>(&motion))
        return map_of(*affine).displacement(rest.rowwise().mean());
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& u : std::get<VertexMotion>(motion).displacements) sum += u;
    return sum / static_cast<double>(rest.cols());
}

}  // namespace elastolab
