#include "fem/nonlinear/cost.hpp"

#include "fem/cost.hpp"
#include "fem/quadratic/cost.hpp"
#include "mesh/tets/node_estimate.hpp"

namespace elastolab {

Cost predict_nonlinear_fem(const SurfaceMesh& mesh, const Method& method) {
    constexpr double kFactorisations = 3.0;  // from rest to a motion of some 60 degrees, with the solves between
    constexpr double kFactors = 2.0;         // at rest, and of the last equilibrium or the next one
    const bool quadratic = method.elements == ElementDegree::quadratic;
    const double vertices = estimated_tet_nodes(mesh);
    const FactorEstimate factor(mesh, vertices, quadratic);
    Cost cost = quadratic ? predict_quadratic_fem(mesh, method) : predict_linear_fem(mesh, method);
    cost.memory_bytes += static_cast<std::uint64_t>(10.5 * (kFactors - 1.0) * factor.entries);
    cost.seconds += kFactorisations * factor.seconds();
    return cost;
}

}  // namespace elastolab
