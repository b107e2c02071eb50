#include "scene/motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <numbers>

#include "base/overloaded.hpp"

namespace elastolab {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRigid = 1e-9;  ///< what rounding leaves of a turn

}  // namespace

Motion translated(const Motion& motion, const Eigen::Vector3d& shift) {
    Motion result = motion;
    std::visit(Overloaded{[&](AffineMotion& affine) { affine.translate += shift; },
                          [&](VertexMotion& single) {
                              for (Eigen::Vector3d& u : single.displacements) u += shift;
                          }},
               result);
    return result;
}

Motion transformed(const Motion& motion, const Eigen::Matrix3d& map, const Eigen::Vector3d& center,
                   const Positions& rest) {
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    Motion result = motion;
    std::visit(Overloaded{[&](AffineMotion& affine) {
                              affine.matrix = map * (identity + affine.matrix) - identity;
                              affine.translate = map * (affine.translate - center) + center;
                          },
                          [&](VertexMotion& single) {
                              assert(rest.cols() == std::ssize(single.displacements));
                              for (std::size_t i = 0; i < single.displacements.size(); ++i) {
                                  const Eigen::Vector3d x = rest.col(static_cast<Eigen::Index>(i));
                                  Eigen::Vector3d& u = single.displacements[i];
                                  u = center + map * (x + u - center) - x;
                              }
                          }},
               result);
    return result;
}

Motion scaled(const Motion& motion, double factor) {
    Motion result = motion;
    std::visit(Overloaded{[&](AffineMotion& affine) {
                              affine.matrix *= factor;
                              affine.translate *= factor;
                          },
                          [&](VertexMotion& single) {
                              for (Eigen::Vector3d& u : single.displacements) u *= factor;
                          }},
               result);
    return result;
}

std::optional<Placement> placement_of(const Motion& motion, const Positions& rest) {
    const auto* affine = std::get_if<AffineMotion>(&motion);
    if (affine == nullptr) return std::nullopt;
    const Eigen::Matrix3d map = Eigen::Matrix3d::Identity() + affine->matrix;
    const double scale = std::cbrt(map.determinant());
    if (!(scale > 0.0)) return std::nullopt;
    const Eigen::Matrix3d turn = map / scale;
    if (!((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm() < kRigid)) return std::nullopt;
    Eigen::Vector3d angles(std::atan2(turn(2, 1), turn(2, 2)), std::asin(std::clamp(-turn(2, 0), -1.0, 1.0)),
                           std::atan2(turn(1, 0), turn(0, 0)));
    if (std::abs(turn(2, 0)) > 1.0 - kRigid)  // a quarter about y, after which turns about x and z are the same
        angles = {std::atan2(-turn(1, 2), turn(1, 1)), angles.y(), 0.0};
    return Placement{mean_displacement(motion, rest), (angles / kDegree).array() + 0.0, scale};  // + 0: no "-0"
}

AffineMotion motion_of(const Placement& placement, const Positions& rest) {
    const auto turn = [&](int axis) {
        return Eigen::AngleAxisd(kDegree * placement.turn[axis], Eigen::Vector3d::Unit(axis));
    };
    const Eigen::Matrix3d matrix =
        placement.scale * (turn(2) * turn(1) * turn(0)).toRotationMatrix() - Eigen::Matrix3d::Identity();
    return {.matrix = matrix, .translate = placement.move - matrix * rest.rowwise().mean()};
}

Eigen::Vector3d mean_displacement(const Motion& motion, const Positions& rest) {
    if (const auto* affine = std::get_if<AffineMotion>(&motion))
        return affine->matrix * rest.rowwise().mean() + affine->translate;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& u : std::get<VertexMotion>(motion).displacements) sum += u;
    return sum / static_cast<double>(rest.cols());
}

}  // namespace elastolab
