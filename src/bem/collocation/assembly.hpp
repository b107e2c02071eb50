#pragma once

#include <Eigen/Core>
#include <span>

#include "base/control.hpp"
#include "bem/boundary.hpp"
#include "elasticity/material.hpp"

namespace elastolab {

/// The two operators of the boundary integral equation H u = G t.
enum class Layer {
    single_layer,  ///< G: Kelvin displacements U times shape functions
    double_layer,  ///< H: Kelvin tractions T times shape functions, and the free term
};

/// Integrals of one layer over `elements` seen from `points`, as a matrix for one material:
///   out, 3*n_sources x 3*n_slots, block (x, k):  single_layer  int phi_k U(x, y) dS_y  [L^2 / force * L]
///                                                double_layer  int phi_k T(x, y) dS_y + c(x) phi_k(x)  [1]
/// The free term c(x), jump and solid angle together, is minus the sum of all blocks of the row (a translation causes
/// no traction); so the double layer needs `elements` to cover the whole closed surface.
/// tolerance: relative error allowed to an integral (elasticity/far_field.hpp). Parallel over collocation points; the
/// result does not depend on the number of threads. Throws Cancelled.
void assemble(Layer layer, const Boundary& boundary, const CollocationPoints& points, const Elements& elements,
              const Material& material, double tolerance, Eigen::Ref<Eigen::MatrixXd> out, Control& control);

/// The same without the free terms and on one thread: a block of a larger matrix, of whichever elements.
void integrate_block(Layer layer, const Boundary& boundary, const CollocationPoints& points, const Elements& elements,
                     const Material& material, double tolerance, Eigen::Ref<Eigen::MatrixXd> out);

}  // namespace elastolab
