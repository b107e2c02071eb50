#include "elasticity/kelvin.hpp"

#include <cassert>
#include <numbers>

namespace elastolab {

using std::numbers::pi;

Eigen::Matrix3d kelvin_displacement(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Material& material) {
    const double r = (y - x).norm(), nu = material.poisson_ratio;
    assert(r > 0.0);
    const Eigen::Vector3d e = (y - x) / r;
    return ((3.0 - 4.0 * nu) * Eigen::Matrix3d::Identity() + e * e.transpose()) /
           (16.0 * pi * material.shear_modulus() * (1.0 - nu) * r);
}

Eigen::Matrix3d kelvin_traction(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& n,
                                double nu) {
    const double r = (y - x).norm();
    assert(r > 0.0);
    const Eigen::Vector3d e = (y - x) / r;
    const Eigen::Matrix3d normal_part = (1.0 - 2.0 * nu) * Eigen::Matrix3d::Identity() + 3.0 * e * e.transpose();
    const Eigen::Matrix3d skew_part = (1.0 - 2.0 * nu) * (e * n.transpose() - n * e.transpose());
    return -(e.dot(n) * normal_part - skew_part) / (8.0 * pi * (1.0 - nu) * r * r);
}

}  // namespace elastolab
