#include "mesh/surface_distance.hpp"

#include <algorithm>
#include <atomic>
#include <Eigen/Geometry>
#include <mutex>
#include <numeric>
#include <tuple>

#include "base/parallel.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/measures.hpp"

namespace elastolab {

namespace {

using Eigen::Vector3d;

/// Two sides face each other when the cosine of the angle between their normals is below minus this.
constexpr double kFacing = 0.5;

double distance_to_segment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
    const Vector3d edge = b - a;
    const double s = std::clamp((x - a).dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0.0, 1.0);
    return (x - a - s * edge).norm();
}

/// The sizes of boxes are right to rounding only; a search reaches a little farther, so that it misses nothing.
constexpr double kSlack = 1.0 + 1e-12;
/// Vertices at a time for a thread.
constexpr int kGrain = 256;

struct Side {
    Vector3d normal;
    double longest_edge;
};

double longest_edge(const TrianglePoints& p) {
    return std::max({(p.b - p.a).norm(), (p.c - p.b).norm(), (p.a - p.c).norm()});
}

std::vector<Side> sides_of(const SurfaceMesh& mesh) {
    std::vector<Side> sides;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(mesh, t);
        sides.push_back({area_vector(p).normalized(), longest_edge(p)});
    }
    return sides;
}

BoxTree tree_of(const SurfaceMesh& mesh) {
    std::vector<int> all(static_cast<std::size_t>(mesh.n_triangles()));
    std::iota(all.begin(), all.end(), 0);
    return {mesh, std::move(all)};
}

/// The mean normal of a vertex, weighted by area: not of unit length.
Eigen::Matrix3Xd vertex_normals(const SurfaceMesh& mesh) {
    Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, mesh.n_vertices());
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (const int v : mesh.triangles.col(t)) normals.col(v) += area_vector(triangle_points(mesh, t));
    return normals;
}

bool is_closer(const FacingApproach& a, const FacingApproach& b) {
    return a.ratio < b.ratio || (a.ratio == b.ratio && a.vertex < b.vertex);
}

/// The search for the closest approach; visit() may be called by several threads.
class ApproachSearch {
public:
    explicit ApproachSearch(const SurfaceMesh& mesh)
        : mesh_(mesh),
          sides_(sides_of(mesh)),
          normals_(vertex_normals(mesh).colwise().normalized()),
          tree_(tree_of(mesh)) {}

    void visit(int begin, int end) {
        FacingApproach closest{reach_, -1};
        for (int v = begin; v < end; ++v) visit(v, closest);
        if (closest.vertex < 0) return;
        const std::lock_guard lock(mutex_);
        if (!is_closer(closest, closest_)) return;
        closest_ = closest;
        reach_ = closest.ratio;
    }
    const FacingApproach& closest() const { return closest_; }

private:
    /// A vertex as close as the closest so far counts when nothing was found yet or when it comes before.
    void visit(int v, FacingApproach& closest) const {
        const Vector3d x = mesh_.vertices.col(v), normal = normals_.col(v);
        tree_.for_each_near(
            x, [&](double edge) { return kSlack * closest.ratio * edge; },
            [&](int t) {
                const Side& side = sides_[static_cast<std::size_t>(t)];
                if (side.normal.dot(normal) > -kFacing || (mesh_.triangles.col(t).array() == v).any()) return;
                const double ratio = distance_to_triangle(x, mesh_, t) / side.longest_edge;
                if (ratio < closest.ratio || (ratio == closest.ratio && closest.vertex < 0 && ratio < 1.0))
                    closest = {ratio, v};
            });
    }

    const SurfaceMesh& mesh_;
    std::vector<Side> sides_;
    Eigen::Matrix3Xd normals_;
    BoxTree tree_;
    std::atomic<double> reach_{1.0};  ///< ratio that is still of interest
    std::mutex mutex_;
    FacingApproach closest_;
};

/// Parts in contact, and what orders one such finding before another.
struct OrderedContact {
    int triangle = std::numeric_limits<int>::max();
    std::size_t part = 0, place = 0;  ///< of the vertex, and in it

    bool operator<(const OrderedContact& other) const {
        return std::tie(triangle, part, place) < std::tie(other.triangle, other.part, other.place);
    }
};

}  // namespace

double distance_to_triangle(const Vector3d& point, const SurfaceMesh& mesh, int triangle) {
    const TrianglePoints p = triangle_points(mesh, triangle);
    const Vector3d n = area_vector(p);
    const bool above = n.dot((p.b - p.a).cross(point - p.a)) >= 0.0 && n.dot((p.c - p.b).cross(point - p.b)) >= 0.0 &&
                       n.dot((p.a - p.c).cross(point - p.c)) >= 0.0;
    if (above) return std::abs(n.dot(point - p.a)) / n.norm();
    return std::min({distance_to_segment(point, p.a, p.b), distance_to_segment(point, p.b, p.c),
                     distance_to_segment(point, p.c, p.a)});
}

FacingApproach closest_facing_approach(const SurfaceMesh& mesh, Control& control) {
    ApproachSearch search(mesh);
    parallel_blocks(mesh.n_vertices(), kGrain, control, [&](int begin, int end) { search.visit(begin, end); });
    return search.closest();
}

FacingApproach closest_facing_approach(const SurfaceMesh& mesh) {
    Control control;
    return closest_facing_approach(mesh, control);
}

std::vector<double> wall_thickness(const SurfaceMesh& mesh, double reach, Control& control) {
    const std::vector<Side> sides = sides_of(mesh);
    const Eigen::Matrix3Xd normals = vertex_normals(mesh).colwise().normalized();
    const BoxTree tree = tree_of(mesh);
    std::vector<double> thickness(static_cast<std::size_t>(mesh.n_vertices()), std::numeric_limits<double>::infinity());
    parallel_blocks(mesh.n_vertices(), kGrain, control, [&](int begin, int end) {
        for (int v = begin; v < end; ++v) {
            double& nearest = thickness[static_cast<std::size_t>(v)];
            const Vector3d x = mesh.vertices.col(v), normal = normals.col(v);
            tree.for_each_near(
                x, [&](double) { return kSlack * std::min(nearest, reach); },
                [&](int t) {
                    if (sides[static_cast<std::size_t>(t)].normal.dot(normal) > -kFacing) return;
                    if ((mesh.triangles.col(t).array() == v).any() || normal.dot(centroid(mesh, t) - x) > 0.0) return;
                    const double distance = distance_to_triangle(x, mesh, t);
                    if (distance < std::min(nearest, reach)) nearest = distance;
                });
        }
    });
    return thickness;
}

std::optional<Contact> find_contact(const SurfaceMesh& mesh, std::span<const std::vector<int>> parts, double distance,
                                    Control& control) {
    std::vector<std::size_t> part_of(static_cast<std::size_t>(mesh.n_vertices()), parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const int v : parts[p]) part_of[static_cast<std::size_t>(v)] = p;
    const auto part_of_triangle = [&](int t) { return part_of[static_cast<std::size_t>(mesh.triangles(0, t))]; };
    const BoxTree tree = tree_of(mesh);
    std::mutex mutex;
    OrderedContact first;
    for (std::size_t p = 0; p < parts.size(); ++p)
        parallel_blocks(static_cast<int>(parts[p].size()), kGrain, control, [&](int begin, int end) {
            for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
                const Vector3d x = mesh.vertices.col(parts[p][i]);
                tree.for_each_near(
                    x, [&](double) { return kSlack * distance; },
                    [&](int t) {
                        if (part_of_triangle(t) == p || !(distance_to_triangle(x, mesh, t) < distance)) return;
                        const std::lock_guard lock(mutex);
                        first = std::min(first, OrderedContact{t, p, i});
                    });
            }
        });
    if (first.triangle == std::numeric_limits<int>::max()) return std::nullopt;
    const std::size_t own = part_of_triangle(first.triangle);
    return Contact{std::min(own, first.part), std::max(own, first.part), parts[first.part][first.place]};
}

std::optional<Contact> find_contact(const SurfaceMesh& mesh, std::span<const std::vector<int>> parts, double distance) {
    Control control;
    return find_contact(mesh, parts, distance, control);
}

}  // namespace elastolab
