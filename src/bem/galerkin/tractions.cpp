#include "bem/galerkin/tractions.hpp"

#include <algorithm>

namespace elastolab {

GalerkinTractions::GalerkinTractions(const SurfaceMesh& mesh, const ClosedSurfaces& surfaces,
                                     std::span<const int> vertices) {
    std::vector<char> is_constrained(static_cast<std::size_t>(mesh.n_vertices()), 0);
    for (const int v : vertices) is_constrained[static_cast<std::size_t>(v)] = 1;
    std::vector<char> carries(static_cast<std::size_t>(surfaces.size()), 0);
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Eigen::Vector3i v = mesh.triangles.col(t);
        const auto constrained = [&](int vertex) { return is_constrained[static_cast<std::size_t>(vertex)] != 0; };
        if (!std::all_of(v.begin(), v.end(), constrained)) continue;
        triangles.push_back(t);
        carries[static_cast<std::size_t>(surfaces.surface_of_triangle[static_cast<std::size_t>(t)])] = 1;
    }
    const bool any = !triangles.empty();
    for (int s = any ? 0 : 1; s < surfaces.size(); ++s)
        if (!carries[static_cast<std::size_t>(s)]) free_surfaces.push_back(s);
}

}  // namespace elastolab
