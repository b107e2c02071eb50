#include "mesh/triangles_across.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/measures.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

namespace {

double across(const SurfaceMesh& surface) { return thickness(surface) / mean_edge(surface); }

}  // namespace

double thickness(const SurfaceMesh& surface) {
    return 4.0 * std::abs(enclosed_volume(surface)) / surface_area(surface);
}

double triangles_across(const SurfaceMesh& surface) {
    double fewest = across(surface);
    const std::vector<std::vector<int>> parts = connected_components(surface, EdgeTable(surface)).triangles();
    if (parts.size() < 2) return fewest;
    for (const std::vector<int>& triangles : parts)
        fewest = std::min(fewest, across({surface.vertices, surface.triangles(Eigen::all, triangles)}));
    return fewest;
}

}  // namespace elastolab
