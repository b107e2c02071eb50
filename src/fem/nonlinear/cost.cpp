#include "fem/nonlinear/cost.hpp"

#include "fem/cost.hpp"
#include "fem/quadratic/cost.hpp"
#include "mesh/tets/node_estimate.hpp"

namespace elastolab {

/// Until the body at rest can be pulled.
Cost predict_nonlinear_fem(const SurfaceMesh& mesh, const Method& method) {
    constexpr double kFactors = 2.0;        // at rest, and of the last equilibrium or the next one
    constexpr double kTangentWork = 250.0;  // for a node, in the unit of kNodeWork
    const bool quadratic = method.elements == ElementDegree::quadratic;
    const FactorEstimate factor(mesh, estimated_tet_nodes(mesh), quadratic);
    Cost cost = quadratic ? predict_quadratic_fem(mesh, method) : predict_linear_fem(mesh, method);
    cost.memory_bytes += static_cast<std::uint64_t>(10.5 * (kFactors - 1.0) * factor.entries);
    cost.work.scalars += kTangentWork * static_cast<double>(cost.degrees_of_freedom) / 3.0;
    return cost;
}

}  // namespace elastolab
