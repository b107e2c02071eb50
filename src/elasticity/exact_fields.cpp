#include "elasticity/exact_fields.hpp"

#include <cassert>
#include <Eigen/Geometry>

#include "elasticity/kelvin.hpp"

namespace elastolab {

Eigen::Vector3d RigidMotionField::displacement(const Eigen::Vector3d& x) const {
    return translation + rotation.cross(x);
}
Eigen::Matrix3d RigidMotionField::stress(const Eigen::Vector3d&) const { return Eigen::Matrix3d::Zero(); }

Eigen::Vector3d UniaxialStretch::displacement(const Eigen::Vector3d& x) const {
    const double nu = material.poisson_ratio;
    return strain * Eigen::Vector3d(x[0], -nu * x[1], -nu * x[2]);
}
Eigen::Matrix3d UniaxialStretch::stress(const Eigen::Vector3d&) const {
    return Eigen::Vector3d(material.young_modulus * strain, 0.0, 0.0).asDiagonal();
}

Eigen::Vector3d PureBending::displacement(const Eigen::Vector3d& p) const {
    const double nu = material.poisson_ratio, x = p[0], y = p[1], z = p[2];
    return curvature * Eigen::Vector3d(x * z, -nu * y * z, -0.5 * (x * x + nu * (z * z - y * y)));
}
Eigen::Matrix3d PureBending::stress(const Eigen::Vector3d& x) const {
    return Eigen::Vector3d(material.young_modulus * curvature * x[2], 0.0, 0.0).asDiagonal();
}

Eigen::Vector3d Torsion::displacement(const Eigen::Vector3d& x) const {
    return twist * x[2] * Eigen::Vector3d(-x[1], x[0], 0.0);
}
Eigen::Matrix3d Torsion::stress(const Eigen::Vector3d& x) const {
    Eigen::Matrix3d sigma = Eigen::Matrix3d::Zero();
    sigma(0, 2) = sigma(2, 0) = -material.shear_modulus() * twist * x[1];
    sigma(1, 2) = sigma(2, 1) = material.shear_modulus() * twist * x[0];
    return sigma;
}

// Free at the outer radius b: (3 lambda + 2 mu) A = 4 mu B / b^3, written with E / (1 - 2 nu) = 3 lambda + 2 mu so that
// nu = 1/2 needs no limit.
double HollowSphereField::B() const {
    const double a = inner_radius, b = outer_radius;
    const double A_per_B =
        4.0 * material.shear_modulus() * (1.0 - 2.0 * material.poisson_ratio) / (material.young_modulus * b * b * b);
    return inner_displacement / (A_per_B * a + 1.0 / (a * a));
}
double HollowSphereField::A() const {
    return (inner_displacement - B() / (inner_radius * inner_radius)) / inner_radius;
}
Eigen::Vector3d HollowSphereField::displacement(const Eigen::Vector3d& x) const {
    const double r = x.norm();
    assert(r > 0.0);
    return (A() + B() / (r * r * r)) * x;
}
Eigen::Matrix3d HollowSphereField::stress(const Eigen::Vector3d& x) const {
    const double r = x.norm(), b = outer_radius, mu = material.shear_modulus();
    assert(r > 0.0);
    const Eigen::Vector3d e = x / r;
    const double mean = 4.0 * mu * B() / (b * b * b);
    const double radial = mean - 4.0 * mu * B() / (r * r * r), hoop = mean + 2.0 * mu * B() / (r * r * r);
    return hoop * Eigen::Matrix3d::Identity() + (radial - hoop) * e * e.transpose();
}

Eigen::Vector3d PointForceField::displacement(const Eigen::Vector3d& x) const {
    return kelvin_displacement(source, x, material) * force;
}
Eigen::Matrix3d PointForceField::stress(const Eigen::Vector3d& x) const {
    // Column k of the stress is the traction on the plane with normal along axis k.
    Eigen::Matrix3d sigma;
    for (int k = 0; k < 3; ++k)
        sigma.col(k) = kelvin_traction(source, x, Eigen::Vector3d::Unit(k), material.poisson_ratio).transpose() * force;
    return sigma;
}

}  // namespace elastolab
