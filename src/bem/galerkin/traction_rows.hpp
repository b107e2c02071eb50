#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>

#include "base/control.hpp"
#include "bem/boundary.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// Rows of the boundary integral equation <tau, V t> = <tau, K u>, tested with tractions tau that are constant on each
/// of n triangles; u in the hats of all V vertices, t constant on the same triangles. Node-major: row 3 i + component.
struct TractionRows {
    /// 3n x 3n: iint U(x, y) over pairs of the triangles [L^5 / force]; symmetric.
    Eigen::MatrixXd single_layer;
    /// 3n x 3V: iint phi(y) T(x, y), and half the mass matrix (the free term at the smooth points of a triangle) [L^2].
    /// Annihilates the rigid motions of every closed surface to the tolerance. T through Guenter's derivatives, by the
    /// numbers of elasticity/close_pairs.hpp and the surface curl c_b of a vertex's hat:
    ///   K_b = -1/(4 pi) normal_b I + [(1-2nu) P I + Q] [c_b] / (8 pi (1-nu)) + area/6 I
    Eigen::MatrixXd double_layer;
};

/// Both, for any list of different triangles; tolerance relative, of the integrals of a pair. The result does not
/// depend on the number of threads. Throws Cancelled. Source: Steinbach, Numerical Approximation Methods for Elliptic
/// Boundary Value Problems (2008), section 6.7.
TractionRows assemble_traction_rows(const Boundary& boundary, std::span<const int> triangles, const Material& material,
                                    double tolerance, Control& control);

/// The single layer alone: pairs of these triangles only.
Eigen::MatrixXd assemble_single_layer(const Boundary& boundary, std::span<const int> triangles,
                                      const Material& material, double tolerance, Control& control);

/// int tau phi, 3n x 3V [L^2]: a third of a triangle's area for each of its corners.
Eigen::SparseMatrix<double, Eigen::RowMajor> traction_mass(const Boundary& boundary, std::span<const int> triangles);

}  // namespace elastolab
