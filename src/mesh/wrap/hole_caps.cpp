#include "mesh/wrap/hole_caps.hpp"

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesh/measures.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

namespace {

/// Fraction of the area of the surface above which a hole gets no cap.
constexpr double kLargestCap = 0.1;

using Rim = std::vector<int>;  ///< vertices, each joined to the next and the last to the first

/// The closed walks along boundary edges (those of one triangle only) that pass each vertex once.
std::vector<Rim> rims_of(const SurfaceMesh& surface) {
    const EdgeTable edges(surface);
    std::map<int, std::vector<int>> neighbours;
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.half_edges(e).size() != 1 || edges[e].a == edges[e].b) continue;
        neighbours[edges[e].a].push_back(edges[e].b);
        neighbours[edges[e].b].push_back(edges[e].a);
    }
    std::vector<Rim> rims;
    std::set<int> seen;
    for (const auto& entry : neighbours) {
        if (seen.contains(entry.first)) continue;
        Rim rim;
        bool simple = true;
        for (int at = entry.first, from = -1; simple;) {
            rim.push_back(at);
            seen.insert(at);
            const std::vector<int>& next = neighbours[at];
            simple = next.size() == 2;
            if (!simple) break;
            const int to = next[0] != from ? next[0] : next[1];
            if (to == entry.first) break;
            if (seen.contains(to)) simple = false;
            from = at;
            at = to;
        }
        if (simple && rim.size() >= 3) rims.push_back(std::move(rim));
    }
    return rims;
}

double area_of_fan(const SurfaceMesh& surface, const Rim& rim, const Eigen::Vector3d& middle) {
    double area = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i)
        area += 0.5 * (surface.vertices.col(rim[i]) - middle)
                          .cross(surface.vertices.col(rim[(i + 1) % rim.size()]) - middle)
                          .norm();
    return area;
}

}  // namespace

HoleCaps cap_holes(const SurfaceMesh& surface) {
    const double largest = kLargestCap * surface_area(surface);
    std::vector<Eigen::Vector3d> middles;
    std::vector<Eigen::Vector3i> fans;
    for (const Rim& rim : rims_of(surface)) {
        const Eigen::Vector3d middle = surface.vertices(Eigen::all, rim).rowwise().mean();
        if (area_of_fan(surface, rim, middle) > largest) continue;
        const int at = surface.n_vertices() + static_cast<int>(middles.size());
        for (std::size_t i = 0; i < rim.size(); ++i) fans.emplace_back(rim[i], rim[(i + 1) % rim.size()], at);
        middles.push_back(middle);
    }
    HoleCaps result{surface, static_cast<int>(middles.size())};
    result.closed.vertices.conservativeResize(3, surface.n_vertices() + std::ssize(middles));
    result.closed.triangles.conservativeResize(3, surface.n_triangles() + std::ssize(fans));
    for (std::size_t i = 0; i < middles.size(); ++i)
        result.closed.vertices.col(surface.n_vertices() + static_cast<Eigen::Index>(i)) = middles[i];
    for (std::size_t i = 0; i < fans.size(); ++i)
        result.closed.triangles.col(surface.n_triangles() + static_cast<Eigen::Index>(i)) = fans[i];
    return result;
}

}  // namespace elastolab
