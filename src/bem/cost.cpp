#include "bem/cost.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

bool is_hierarchical(const SurfaceMesh& surface, const Method& method) {
    return is_hierarchical(surface.n_vertices(), method);
}

bool is_hierarchical(std::int64_t n_vertices, const Method& method) {
    return method.mode == Mode::on_demand && n_vertices >= method.hierarchical_from &&
           method.update != Update::eqn9;  // which acts on inverses of the whole matrix
}

double cluster_levels(std::int64_t n_vertices) {
    return std::log2(std::max(static_cast<double>(n_vertices) / 48.0, 2.0));
}

UsualSet::UsualSet(const SurfaceMesh& surface) : vertices(std::max(0.1 * surface.n_vertices(), 3.0)) {
    triangles = std::min(2.0 * vertices + 5.0 * std::sqrt(vertices), static_cast<double>(surface.n_triangles()));
}

Cost predict_hierarchical(const SurfaceMesh& surface, const HierarchicalPrices& prices) {
    const double n = surface.n_vertices(), levels = cluster_levels(surface.n_vertices());
    const double set = UsualSet(surface).triangles;
    const Work work{.integrals = (prices.precomputation + prices.set) * n * std::cbrt(n) +
                                 prices.set_triangles * set * std::cbrt(set)};
    return {3 * static_cast<std::int64_t>(surface.n_vertices()),
            (64u << 20) + static_cast<std::uint64_t>(prices.bytes * levels * n), work};
}

}  // namespace elastolab
