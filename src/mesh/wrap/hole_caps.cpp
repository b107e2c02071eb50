#include "mesh/wrap/hole_caps.hpp"

#include <algorithm>
#include <Eigen/Geometry>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/measures.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

namespace {

/// A closed walk along edges of one triangle only, that passes each vertex once.
struct Rim {
    std::vector<int> vertices;  ///< each joined to the next and the last to the first
    std::vector<int> edges;     ///< of the edge table: from each vertex to the next
};

/// Finds the rims: walks on along unused boundary edges, and cuts a rim off where it comes back to a vertex.
class RimSearch {
public:
    explicit RimSearch(const EdgeTable& edges) : edges_(edges), used_(static_cast<std::size_t>(edges.size()), true) {
        for (int e = 0; e < edges.size(); ++e) {
            if (edges.half_edges(e).size() != 1 || edges[e].a == edges[e].b) continue;
            used_[static_cast<std::size_t>(e)] = false;
            at_[edges[e].a].push_back(e);
            at_[edges[e].b].push_back(e);
        }
    }

    std::vector<Rim> search() {
        for (const auto& [vertex, edges] : at_)
            while (next_edge(vertex) >= 0) walk_from(vertex);
        return std::move(rims_);
    }

private:
    int next_edge(int vertex) {
        std::vector<int>& candidates = at_[vertex];
        while (!candidates.empty() && used_[static_cast<std::size_t>(candidates.back())]) candidates.pop_back();
        return candidates.empty() ? -1 : candidates.back();
    }

    void walk_from(int vertex) {
        std::vector<int> vertices{vertex}, walked;
        std::map<int, std::size_t> place{{vertex, 0}};
        while (true) {
            const int edge = next_edge(vertices.back());
            if (edge < 0) {  // where edges of three triangles end a rim
                if (walked.empty()) return;
                place.erase(vertices.back());
                vertices.pop_back();
                walked.pop_back();
                continue;
            }
            used_[static_cast<std::size_t>(edge)] = true;
            walked.push_back(edge);
            const int to = edges_[edge].a == vertices.back() ? edges_[edge].b : edges_[edge].a;
            const auto before = place.find(to);
            if (before == place.end()) {
                place[to] = vertices.size();
                vertices.push_back(to);
            } else {
                cut_off(before->second, vertices, walked, place);
            }
        }
    }

    /// The rim from this place of the walk to its end.
    void cut_off(std::size_t begin, std::vector<int>& vertices, std::vector<int>& walked,
                 std::map<int, std::size_t>& place) {
        const auto from = static_cast<std::ptrdiff_t>(begin);
        Rim rim{{vertices.begin() + from, vertices.end()}, {walked.begin() + from, walked.end()}};
        for (std::size_t i = begin + 1; i < vertices.size(); ++i) place.erase(vertices[i]);
        vertices.resize(begin + 1);
        walked.resize(begin);
        if (rim.vertices.size() >= 3) rims_.push_back(std::move(rim));
    }

    const EdgeTable& edges_;
    std::vector<bool> used_;
    std::map<int, std::vector<int>> at_;
    std::vector<Rim> rims_;
};

double area_of_fan(const SurfaceMesh& surface, const std::vector<int>& rim, const Eigen::Vector3d& middle) {
    double area = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i)
        area += 0.5 * (surface.vertices.col(rim[i]) - middle)
                          .cross(surface.vertices.col(rim[(i + 1) % rim.size()]) - middle)
                          .norm();
    return area;
}

/// The parts of a surface that are judged as one: components, joined where a rim runs along several of them.
class Parts {
public:
    Parts(const SurfaceMesh& surface, const EdgeTable& edges, const std::vector<Rim>& rims)
        : edges_(edges), components_(connected_components(surface, edges)) {
        parent_.resize(static_cast<std::size_t>(components_.count));
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
        for (const Rim& rim : rims)
            for (const int edge : rim.edges) parent_[root(component(edge))] = root(component(rim.edges.front()));
    }

    std::size_t size() const { return parent_.size(); }
    std::size_t of(const Rim& rim) { return root(component(rim.edges.front())); }
    std::size_t of_triangle(int t) { return root(of_triangle_unjoined(t)); }

private:
    std::size_t of_triangle_unjoined(int t) const {
        return static_cast<std::size_t>(components_.of_triangle[static_cast<std::size_t>(t)]);
    }
    std::size_t component(int edge) const { return of_triangle_unjoined(edges_.half_edges(edge).front() / 3); }
    std::size_t root(std::size_t part) {
        while (parent_[part] != part) part = parent_[part] = parent_[parent_[part]];
        return part;
    }

    const EdgeTable& edges_;
    Components components_;
    std::vector<std::size_t> parent_;
};

/// A rim and the fan that would close it.
struct HoleCap {
    std::vector<int> rim;
    Eigen::Vector3d middle;
    double area;
    std::size_t part;
};

std::vector<HoleCap> possible_caps(const SurfaceMesh& surface, const std::vector<Rim>& rims, Parts& parts) {
    std::vector<HoleCap> caps;
    for (const Rim& rim : rims) {
        const Eigen::Vector3d middle = surface.vertices(Eigen::all, rim.vertices).rowwise().mean();
        caps.push_back({rim.vertices, middle, area_of_fan(surface, rim.vertices, middle), parts.of(rim)});
    }
    return caps;
}

/// For each part, whether it is a solid but for its holes.
std::vector<bool> solid_parts(const SurfaceMesh& surface, const std::vector<HoleCap>& caps, Parts& parts) {
    std::vector<double> area(parts.size(), 0.0), opening(parts.size(), 0.0);
    for (int t = 0; t < surface.n_triangles(); ++t)
        area[parts.of_triangle(t)] += 0.5 * area_vector(triangle_points(surface, t)).norm();
    for (const HoleCap& cap : caps) opening[cap.part] += cap.area;
    std::vector<bool> solid;
    for (std::size_t p = 0; p < parts.size(); ++p) solid.push_back(opening[p] <= kLargestOpening * area[p]);
    return solid;
}

void add_cap(const HoleCap& cap, std::vector<Eigen::Vector3d>& middles, std::vector<Eigen::Vector3i>& fans,
             int n_vertices) {
    const int at = n_vertices + static_cast<int>(middles.size());
    for (std::size_t i = 0; i < cap.rim.size(); ++i)
        fans.emplace_back(cap.rim[(i + 1) % cap.rim.size()], cap.rim[i], at);
    middles.push_back(cap.middle);
}

}  // namespace

HoleCaps cap_holes(const SurfaceMesh& surface, OpenSurface taken_for) {
    const EdgeTable edges(surface);
    const std::vector<Rim> rims = RimSearch(edges).search();
    Parts parts(surface, edges, rims);
    const std::vector<HoleCap> caps = possible_caps(surface, rims, parts);
    std::vector<bool> solid(parts.size(), taken_for == OpenSurface::solid);
    if (taken_for == OpenSurface::automatic) solid = solid_parts(surface, caps, parts);

    std::vector<Eigen::Vector3d> middles;
    std::vector<Eigen::Vector3i> fans;
    for (const HoleCap& cap : caps)
        if (solid[cap.part]) add_cap(cap, middles, fans, surface.n_vertices());
    HoleCaps result{surface, static_cast<int>(middles.size()), static_cast<int>(caps.size() - middles.size())};
    result.closed.vertices.conservativeResize(3, surface.n_vertices() + std::ssize(middles));
    result.closed.triangles.conservativeResize(3, surface.n_triangles() + std::ssize(fans));
    for (std::size_t i = 0; i < middles.size(); ++i)
        result.closed.vertices.col(surface.n_vertices() + static_cast<Eigen::Index>(i)) = middles[i];
    for (std::size_t i = 0; i < fans.size(); ++i)
        result.closed.triangles.col(surface.n_triangles() + static_cast<Eigen::Index>(i)) = fans[i];
    return result;
}

}  // namespace elastolab
