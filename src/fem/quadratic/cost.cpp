#include "fem/quadratic/cost.hpp"

#include "fem/cost.hpp"
#include "mesh/tets/node_estimate.hpp"

namespace elastolab {

/// One more node for every edge, of which there are about six per vertex.
Cost predict_quadratic_fem(const SurfaceMesh& mesh, const Method&) {
    const double vertices = estimated_tet_nodes(mesh), nodes = 7.0 * vertices;
    return predict_sparse(FactorEstimate(mesh, vertices, true), 3.0 * nodes, kNodeWork * (vertices + nodes / 3.0));
}

}  // namespace elastolab
