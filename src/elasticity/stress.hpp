#pragma once

#include <Eigen/Core>

#include "elasticity/material.hpp"

namespace elastolab {

/// A symmetric stress as six numbers, in VTK's order: xx, yy, zz, xy, yz, xz [force / L^2].
using StressNumbers = Eigen::Matrix<double, 6, 1>;

StressNumbers stress_numbers(const Eigen::Matrix3d& tensor);
Eigen::Matrix3d stress_tensor(const Eigen::Ref<const StressNumbers>& numbers);

/// Hooke's law, from the gradient of the displacement (du_i / dx_j). At nu = 1/2 the strain does not determine the
/// pressure, and only the deviator is returned.
StressNumbers hooke(const Eigen::Matrix3d& gradient, const Material& material);

/// One number out of a stress. First and third principal: the largest and the smallest eigenvalue, tension positive.
enum class StressMeasure { von_mises, first_principal, third_principal, xx, yy, zz, xy, yz, xz };
double measure(StressMeasure which, const Eigen::Matrix3d& stress);

}  // namespace elastolab
