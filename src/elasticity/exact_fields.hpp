#pragma once

#include <Eigen/Core>

#include "elasticity/material.hpp"

namespace elastolab {

/// Exact solutions of linear elasticity without body forces (docs/formulation.md section 6), to measure the methods
/// against. Each is a value with
///   displacement(x)  3 [L]
///   stress(x)        3 x 3, symmetric [force / L^2]; the traction on a plane with outward normal n is stress(x) * n
/// Those of a bar, a cylinder and a hollow sphere leave the sides named below free of traction. They hold for every
/// Poisson's ratio up to 1/2.

/// u = translation + rotation x x. Free of stress.
struct RigidMotionField {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    Eigen::Vector3d rotation = Eigen::Vector3d::Zero();

    Eigen::Vector3d displacement(const Eigen::Vector3d& x) const;
    Eigen::Matrix3d stress(const Eigen::Vector3d& x) const;
};

/// u = strain (x, -nu y, -nu z), along axis x; sides parallel to x are free. Linear: the patch test.
struct UniaxialStretch {
    Material material;
    double strain = 1.0;

    Eigen::Vector3d displacement(const Eigen::Vector3d& x) const;
    Eigen::Matrix3d stress(const Eigen::Vector3d& x) const;
};

/// u = curvature (x z, -nu y z, -(x^2 + nu (z^2 - y^2)) / 2), a bar along x bent in the plane of x and z; sides
/// parallel to x are free. curvature [1/L].
struct PureBending {
    Material material;
    double curvature = 1.0;

    Eigen::Vector3d displacement(const Eigen::Vector3d& x) const;
    Eigen::Matrix3d stress(const Eigen::Vector3d& x) const;
};

/// u = twist z (-y, x, 0), a circular cylinder around axis z, whose curved side is free. twist [1/L].
struct Torsion {
    Material material;
    double twist = 1.0;

    Eigen::Vector3d displacement(const Eigen::Vector3d& x) const;
    Eigen::Matrix3d stress(const Eigen::Vector3d& x) const;
};

/// Lame's solution u_r = A r + B / r^2 between two spheres around the origin: the inner one is displaced outward by
/// `inner_displacement` [L], the outer one is free of traction.
struct HollowSphereField {
    Material material;
    double inner_radius = 0.5;
    double outer_radius = 1.0;
    double inner_displacement = 1.0;

    Eigen::Vector3d displacement(const Eigen::Vector3d& x) const;
    Eigen::Matrix3d stress(const Eigen::Vector3d& x) const;

private:
    double A() const;
    double B() const;
};

/// Kelvin's solution for a point force in a full space; `source` lies outside the body. No side is free.
struct PointForceField {
    Material material;
    Eigen::Vector3d source = Eigen::Vector3d::Zero();
    Eigen::Vector3d force = Eigen::Vector3d::UnitX();

    Eigen::Vector3d displacement(const Eigen::Vector3d& x) const;
    Eigen::Matrix3d stress(const Eigen::Vector3d& x) const;
};

/// Values of a field at many points (3 x n): 3n, node-major.
template <class Field>
Eigen::VectorXd displacements(const Field& field, const Eigen::Matrix3Xd& points) {
    Eigen::VectorXd u(points.size());
    for (Eigen::Index i = 0; i < points.cols(); ++i) u.segment<3>(3 * i) = field.displacement(points.col(i));
    return u;
}

}  // namespace elastolab
