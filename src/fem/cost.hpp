#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Nodes are estimated from the surface (mesh/tets/node_estimate.hpp), the factor from their number and the shape.
Cost predict_linear_fem(const SurfaceMesh& surface, const Method& method);

/// What a sparse factorisation takes. Powers of the nodes, of the roundness and of nodes per vertex of the surface (how
/// fine the inside is), fitted to 41 bodies of 390 to 40 000 vertices: cubes, bars, plates, rings, organic ones.
struct FactorEstimate {
    double entries = 0.0;   ///< of the factor
    double flops = 0.0;     ///< of the factorisation
    double nonzeros = 0.0;  ///< of the stiffness

    /// nodes: of linear elements; those of quadratic ones have their own powers.
    FactorEstimate(const SurfaceMesh& mesh, double nodes, bool quadratic);
    /// Of a factorisation and what goes with it.
    Work work() const;
};

/// TetGen, assembly and ordering, for a node: as long as so many integrals at scalar_speed().
constexpr double kNodeWork = 440.0;
/// On demand, first set included. elements_work: what is done for nodes and tetrahedra, in the unit of kNodeWork.
Cost predict_sparse(const FactorEstimate& factor, double unknowns, double elements_work);

}  // namespace elastolab
