#pragma once

#include <Eigen/Core>
#include <ostream>

namespace elastolab {

/// Writes a matrix in NumPy's .npy format, version 1.0: little-endian float64 in column-major ("Fortran") order, as it
/// lies in memory. numpy.load gives an array of the same shape. Failures show in the state of `out`.
/// Source: docs/formulation.md [12].
void write_npy(std::ostream& out, const Eigen::MatrixXd& matrix);

}  // namespace elastolab
