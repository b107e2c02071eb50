#pragma once

#include <Eigen/Core>

#include "base/control.hpp"
#include "bem/boundary.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// The hypersingular operator D between the hats of all vertices:
///   D, 3V x 3V [force / L], symmetric positive semidefinite; v^T D u is the energy of u on the surface, to which both
///   the inside and the outside of the body contribute. Its null space: the rigid motions of each closed surface.
/// With c_a = n x grad phi_a, the surface curl of corner a's hat (constant on a triangle), and
/// P = iint 1/r, Q = iint e e^T / r over a pair of triangles, the form of Han (1994) with Guenter's derivatives is
///   D_ab = mu/(4 pi) { P (2 c_b c_a^T - c_a c_b^T) + [c_a]^T (P I - Q) [c_b] / (1 - nu) },   [c] x = c x x,
/// summed over the pairs of triangles at a and b: no hypersingular integral is left. Each pair is integrated once.
/// tolerance: relative, of the integrals of one pair (elasticity/pair_integrals.hpp). The result does not depend on the
/// number of threads. Needs, besides the result, 12 MB and 17 kB for each vertex. Throws Cancelled.
/// Sources: Steinbach, Numerical Approximation Methods for Elliptic Boundary Value Problems (2008), section 6.7;
/// H. Han, Numer. Math. 68 (1994).
void assemble_hypersingular(const Boundary& boundary, const Material& material, double tolerance,
                            Eigen::Ref<Eigen::MatrixXd> D, Control& control);

/// The two parts of D / mu that it is made of: D = mu (without_nu + with_nu / (1 - nu)), so that another Poisson's
/// ratio is a linear combination of what is in memory. Each pair of triangles is integrated once for both.
struct HypersingularParts {
    Eigen::MatrixXd without_nu, with_nu;  ///< 3V x 3V [L], symmetric
    HypersingularParts(const Boundary& boundary, double tolerance, Control& control);
    void evaluate(const Material& material, Eigen::Ref<Eigen::MatrixXd> D) const;
};

}  // namespace elastolab
