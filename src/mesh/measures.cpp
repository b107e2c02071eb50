#include "mesh/measures.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include "mesh/topology.hpp"

namespace elastolab {

using Eigen::Vector3d;

TrianglePoints triangle_points(const SurfaceMesh& mesh, int triangle) {
    const Eigen::Vector3i v = mesh.triangles.col(triangle);
    return {mesh.vertices.col(v[0]), mesh.vertices.col(v[1]), mesh.vertices.col(v[2])};
}

Eigen::Vector3d centroid(const SurfaceMesh& mesh, int triangle) {
    const TrianglePoints p = triangle_points(mesh, triangle);
    return (p.a + p.b + p.c) / 3.0;
}

Vector3d area_vector(const TrianglePoints& triangle) {
    return (triangle.b - triangle.a).cross(triangle.c - triangle.a);
}

double mean_edge(const SurfaceMesh& mesh) {
    const EdgeTable edges(mesh);
    double sum = 0.0;
    for (int e = 0; e < edges.size(); ++e)
        sum += (mesh.vertices.col(edges[e].a) - mesh.vertices.col(edges[e].b)).norm();
    return sum / std::max(1, edges.size());
}

double surface_area(const SurfaceMesh& mesh) {
    double area = 0.0;
    for (int t = 0; t < mesh.n_triangles(); ++t) area += 0.5 * area_vector(triangle_points(mesh, t)).norm();
    return area;
}

namespace {

/// Shortest ways along edges from one vertex (E. W. Dijkstra 1959).
class WaysAlongEdges {
public:
    explicit WaysAlongEdges(const SurfaceMesh& mesh)
        : mesh_(mesh), triangles_(mesh), way_(static_cast<std::size_t>(mesh.n_vertices()), kNone) {}

    bool reached(int vertex) const { return way_[static_cast<std::size_t>(vertex)] < kNone; }
    /// The vertex that is farthest from this one, and how far.
    std::pair<int, double> farthest(int from) {
        for (const int v : std::exchange(done_, {})) way_[static_cast<std::size_t>(v)] = kNone;
        std::priority_queue<Place, std::vector<Place>, std::greater<>> next;
        std::pair<int, double> last{from, 0.0};
        const auto go = [&](int v, double length) {
            double& best = way_[static_cast<std::size_t>(v)];
            if (length < best) next.emplace(best = length, v);
        };
        for (go(from, 0.0); !next.empty();) {
            const auto [length, v] = next.top();
            next.pop();
            if (length > way_[static_cast<std::size_t>(v)]) continue;
            done_.push_back(v);
            last = {v, length};
            for (const int t : triangles_[v])
                for (const int w : mesh_.triangles.col(t))
                    go(w, length + (mesh_.vertices.col(w) - mesh_.vertices.col(v)).norm());
        }
        return last;
    }
    void next_surface() { done_.clear(); }

private:
    using Place = std::pair<double, int>;
    static constexpr double kNone = std::numeric_limits<double>::infinity();
    const SurfaceMesh& mesh_;
    VertexTriangles triangles_;
    std::vector<double> way_;
    std::vector<int> done_;  ///< since next_surface()
};

}  // namespace

double length_along_surface(const SurfaceMesh& mesh) {
    constexpr int kTimes = 3;
    WaysAlongEdges ways(mesh);
    double longest = 0.0;
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        if (ways.reached(v)) continue;
        ways.next_surface();
        std::pair<int, double> end{v, 0.0};
        for (int i = 0; i < kTimes; ++i) {
            end = ways.farthest(end.first);
            longest = std::max(longest, end.second);
        }
    }
    return longest;
}

double enclosed_volume(const SurfaceMesh& mesh, std::span<const int> triangles) {
    if (triangles.empty()) return 0.0;
    // Volumes of cones with their apex on the surface: far from the origin, an apex at the origin would lose digits.
    const Vector3d apex = triangle_points(mesh, triangles.front()).a;
    double volume = 0.0;
    for (const int t : triangles) {
        const TrianglePoints p = triangle_points(mesh, t);
        volume += (p.a - apex).dot((p.b - apex).cross(p.c - apex)) / 6.0;
    }
    return volume;
}

double enclosed_volume(const SurfaceMesh& mesh) {
    std::vector<int> all(static_cast<std::size_t>(mesh.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    return enclosed_volume(mesh, all);
}

namespace {

double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

double winding_number(const SurfaceMesh& mesh, std::span<const int> triangles, const Vector3d& point) {
    double angle = 0.0;
    for (const int t : triangles) {
        const TrianglePoints p = triangle_points(mesh, t);
        angle += solid_angle(p.a - point, p.b - point, p.c - point);
    }
    return angle / (4.0 * std::numbers::pi);
}

}  // namespace elastolab
