#include "mesh/solids.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "mesh/checks/nesting.hpp"
#include "mesh/measures.hpp"
#include "mesh/numbering.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

Solid with_triangles(const SurfaceMesh& mesh, std::vector<int> triangles) {
    std::sort(triangles.begin(), triangles.end());
    Triangles own = mesh.triangles(Eigen::all, triangles);
    const std::vector<int> vertices = used_vertices(own);
    renumber(own, vertices);
    return {{mesh.vertices(Eigen::all, vertices), std::move(own)}, vertices, std::move(triangles)};
}

std::vector<Solid> split_solids(const SurfaceMesh& mesh) {
    const std::vector<std::vector<int>> components = connected_components(mesh, EdgeTable(mesh)).triangles();
    const auto around = surfaces_around(mesh, components, [](int, int) { return false; });
    std::vector<double> volume;
    for (const auto& triangles : components) volume.push_back(enclosed_volume(mesh, triangles));
    const auto volume_of = [&](int c) { return volume[static_cast<std::size_t>(c)]; };

    std::vector<std::vector<int>> parts(components.size());  // triangles of the solid that each outward surface begins
    for (std::size_t c = 0; c < components.size(); ++c) {
        std::size_t outer = c;
        if (volume[c] < 0.0) {
            // Surfaces around one point are nested, so the least in volume is the innermost.
            std::vector<int> candidates;
            std::copy_if(around[c].begin(), around[c].end(), std::back_inserter(candidates),
                         [&](int d) { return volume_of(d) > 0.0; });
            if (candidates.empty())
                throw MeshError("a surface faces inward with no solid around it. Flip its triangles and reload.");
            outer = static_cast<std::size_t>(*std::min_element(
                candidates.begin(), candidates.end(), [&](int a, int b) { return volume_of(a) < volume_of(b); }));
        }
        parts[outer].insert(parts[outer].end(), components[c].begin(), components[c].end());
    }
    std::vector<Solid> solids;
    for (auto& triangles : parts)
        if (!triangles.empty()) solids.push_back(with_triangles(mesh, std::move(triangles)));
    return solids;
}

Eigen::Vector3d computing_origin(const SurfaceMesh& surface) {
    constexpr double kFar = 4.0;
    const Eigen::Vector3d low = surface.vertices.rowwise().minCoeff(), high = surface.vertices.rowwise().maxCoeff();
    const Eigen::Vector3d centre = low + 0.5 * (high - low);
    return centre.norm() > kFar * (high - low).norm() ? centre : Eigen::Vector3d::Zero();
}

double computing_scale(const SurfaceMesh& surface) {
    const double diagonal = (surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff()).norm();
    return std::ldexp(1.0, -std::ilogb(diagonal));
}

}  // namespace elastolab
