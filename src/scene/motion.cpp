#include "scene/motion.hpp"

#include <cassert>

#include "base/overloaded.hpp"

namespace elastolab {

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

Eigen::Vector3d mean_displacement(const Motion& motion, const Positions& rest) {
    if (const auto* affine = std::get_if<AffineMotion>(&motion))
        return affine->matrix * rest.rowwise().mean() + affine->translate;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& u : std::get<VertexMotion>(motion).displacements) sum += u;
    return sum / static_cast<double>(rest.cols());
}

}  // namespace elastolab
