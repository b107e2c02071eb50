#include "render/geometry/coarse_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <Eigen/Geometry>
#include <limits>
#include <unordered_map>
#include <vector>

namespace elastolab {

namespace {

/// Cells of a grid that a surface passes through, times their edge squared, over its area: about this many, counted
/// once for each way that it faces there. Half as many vertices as triangles.
constexpr double kCellsOfArea = 2.0, kTrianglesOfVertex = 2.0;
constexpr int kCellBits = 20;

Eigen::Matrix3Xd normals_of_triangles(const PositionsView& rest, const TrianglesView& triangles) {
    Eigen::Matrix3Xd normals(3, triangles.cols());  // twice the area long
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const Eigen::Vector3d a = rest.col(triangles(0, t));
        normals.col(t) = (rest.col(triangles(1, t)) - a).cross(rest.col(triangles(2, t)) - a);
    }
    return normals;
}

/// Sums over the triangles at each vertex of these corners.
Eigen::Matrix3Xd sums_at(const TrianglesView& corners, const Eigen::Matrix3Xd& normals, Eigen::Index n_vertices) {
    Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, n_vertices);
    for (Eigen::Index t = 0; t < corners.cols(); ++t)
        for (const int v : corners.col(t)) sums.col(v) += normals.col(t);
    return sums;
}

/// One vertex for every cell of a grid and octant of directions.
class Clusters {
public:
    Clusters(const PositionsView& rest, const Eigen::Matrix3Xd& normals, double edge)
        : rest_(rest),
          lowest_(rest.rowwise().minCoeff()),
          edge_(edge),
          cluster_(static_cast<std::size_t>(rest.cols())) {
        std::unordered_map<std::uint64_t, int> known;
        for (Eigen::Index v = 0; v < rest.cols(); ++v) {
            const auto [entry, is_new] = known.try_emplace(key(v, normals.col(v)), static_cast<int>(known.size()));
            cluster_[static_cast<std::size_t>(v)] = entry->second;
        }
        sums_.setZero(4, std::ssize(known));
        for (Eigen::Index v = 0; v < rest.cols(); ++v) sums_.col(of(v)) += rest.col(v).homogeneous();
        chosen_.assign(known.size(), -1);
        ranks_.assign(known.size(), std::numeric_limits<double>::infinity());
    }
    int of(Eigen::Index vertex) const { return cluster_[static_cast<std::size_t>(vertex)]; }
    /// Nearest to the middle of its cluster; those that are preferred before all others.
    void choose(Eigen::Index vertex, bool preferred) {
        const auto c = static_cast<std::size_t>(of(vertex));
        const double distance = (rest_.col(vertex) - sums_.col(of(vertex)).hnormalized()).norm() / edge_;
        const double rank = distance + (preferred ? 0.0 : kFarthest);
        if (rank < ranks_[c]) {
            ranks_[c] = rank;
            chosen_[c] = static_cast<int>(vertex);
        }
    }
    int chosen(Eigen::Index vertex) const { return chosen_[static_cast<std::size_t>(of(vertex))]; }

private:
    static constexpr double kFarthest = 2.0;  ///< more than any distance within a cell, in edges

    std::uint64_t key(Eigen::Index v, const Eigen::Vector3d& normal) const {
        std::uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double cell = std::floor((rest_(axis, v) - lowest_[axis]) / edge_);
            key = (key << kCellBits) | static_cast<std::uint64_t>(std::min(cell, std::ldexp(1.0, kCellBits) - 1.0));
        }
        for (int axis = 0; axis < 3; ++axis) key = (key << 1) | (normal[axis] < 0.0 ? 1U : 0U);
        return key;
    }

    PositionsView rest_;
    Eigen::Vector3d lowest_;
    double edge_;
    std::vector<int> cluster_;
    Eigen::Matrix4Xd sums_;
    std::vector<int> chosen_;
    std::vector<double> ranks_;
};

/// The drawn vertices of each vertex.
class DrawnVertices {
public:
    explicit DrawnVertices(const SmoothingGroups& groups, Eigen::Index n_vertices)
        : drawn_(static_cast<std::size_t>(n_vertices)) {
        for (std::size_t i = 0; i < groups.vertices.size(); ++i)
            drawn_[static_cast<std::size_t>(groups.vertices[i])].push_back(static_cast<int>(i));
    }
    bool on_crease(Eigen::Index vertex) const { return drawn_[static_cast<std::size_t>(vertex)].size() > 1; }
    /// The one whose normal is nearest to this one.
    int facing(int vertex, const Eigen::Vector3d& normal, const Eigen::Matrix3Xd& normals_of_drawn) const {
        const std::vector<int>& all = drawn_[static_cast<std::size_t>(vertex)];
        return *std::max_element(all.begin(), all.end(), [&](int a, int b) {
            return normals_of_drawn.col(a).normalized().dot(normal) < normals_of_drawn.col(b).normalized().dot(normal);
        });
    }

private:
    std::vector<std::vector<int>> drawn_;
};

}  // namespace

Eigen::Matrix3Xi coarse_corners(const PositionsView& rest, const TrianglesView& triangles,
                                const SmoothingGroups& groups, int n_wanted) {
    const Eigen::Matrix3Xd normals = normals_of_triangles(rest, triangles);
    const double area = 0.5 * normals.colwise().norm().sum();
    const double edge = std::sqrt(kCellsOfArea * kTrianglesOfVertex * area / n_wanted);
    if (!(edge > 0.0) || !std::isfinite(edge)) return groups.corners;
    Clusters clusters(rest, sums_at(triangles, normals, rest.cols()), edge);
    const DrawnVertices drawn(groups, rest.cols());
    for (Eigen::Index v = 0; v < rest.cols(); ++v) clusters.choose(v, drawn.on_crease(v));
    const Eigen::Matrix3Xd normals_of_drawn = sums_at(groups.corners, normals, std::ssize(groups.vertices));

    std::vector<Eigen::Vector3i> kept;
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        Eigen::Vector3i corner;
        for (int i = 0; i < 3; ++i) corner[i] = clusters.chosen(triangles(i, t));
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
        const Eigen::Vector3d normal = normals.col(t).normalized();
        for (int& vertex : corner) vertex = drawn.facing(vertex, normal, normals_of_drawn);
        kept.push_back(corner);
    }
    return Eigen::Map<const Eigen::Matrix3Xi>(kept.empty() ? nullptr : kept.front().data(), 3, std::ssize(kept));
}

}  // namespace elastolab
