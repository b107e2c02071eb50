#include "render/geometry/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

namespace elastolab {

namespace {

/// Room for rounding: in barycentric coordinates, and in distances relative to that of the tested vertex.
constexpr double kEdgeSlack = 1e-12, kDepthSlack = 1e-7;

/// Turns world coordinates into those in which the ray is the positive z axis.
Eigen::Matrix3d axes_of(const Eigen::Vector3d& direction) {
    Eigen::Matrix3d axes;
    axes.col(2) = direction;
    axes.col(0) = direction.unitOrthogonal();
    axes.col(1) = direction.cross(axes.col(0));
    return axes.transpose();
}

double cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Meeting of the z axis with a triangle: z > 0 and barycentric coordinates, or nothing.
std::optional<RayHit> meet(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d weight(cross(b, c), cross(c, a), cross(a, b));
    const double sum = weight.sum(), slack = kEdgeSlack * weight.cwiseAbs().sum();
    if (std::abs(sum) <= slack) return std::nullopt;
    if (sum > 0.0 ? weight.minCoeff() < -slack : weight.maxCoeff() > slack) return std::nullopt;
    const Eigen::Vector3d barycentric = weight / sum;
    const double z = barycentric.dot(Eigen::Vector3d(a.z(), b.z(), c.z()));
    if (!(z > 0.0)) return std::nullopt;
    return RayHit{-1, barycentric, z};
}

bool has_corner(const TrianglesView& triangles, Eigen::Index t, int vertex) {
    return triangles(0, t) == vertex || triangles(1, t) == vertex || triangles(2, t) == vertex;
}

/// A vertex, as rays from the eye to it see other triangles.
class Sight {
public:
    Sight(const Eigen::Vector3d& eye, int vertex, const PositionsView& positions)
        : eye_(eye), vertex_(vertex), limit_((positions.col(vertex) - eye).norm() * (1.0 - kDepthSlack)) {
        axes_ = axes_of((positions.col(vertex) - eye).normalized());
    }
    bool is_blocked_by(Eigen::Index t, const PositionsView& positions, const TrianglesView& triangles) const {
        if (has_corner(triangles, t, vertex_)) return false;
        const auto place = [&](int i) -> Eigen::Vector3d { return axes_ * (positions.col(triangles(i, t)) - eye_); };
        const std::optional<RayHit> hit = meet(place(0), place(1), place(2));
        return hit && hit->distance < limit_;
    }

private:
    Eigen::Vector3d eye_;
    int vertex_;
    double limit_;
    Eigen::Matrix3d axes_;
};

/// Triangles by cells of a rectangle of the screen: each is in every cell that its bounding box touches.
class CellGrid {
public:
    CellGrid(const Eigen::AlignedBox2d& box, int cells) : box_(box), cells_(cells) {
        triangles_.resize(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
    }
    void add(int triangle, const Eigen::AlignedBox2d& extent) {
        if (!box_.intersects(extent)) return;
        const Eigen::Array2i low = cell_of(extent.min()), high = cell_of(extent.max());
        for (int y = low.y(); y <= high.y(); ++y)
            for (int x = low.x(); x <= high.x(); ++x) triangles_[number(x, y)].push_back(triangle);
    }
    std::span<const int> at(const Eigen::Vector2d& pixel) const {
        const Eigen::Array2i cell = cell_of(pixel);
        return triangles_[number(cell.x(), cell.y())];
    }
    const Eigen::AlignedBox2d& box() const { return box_; }

private:
    std::size_t number(int x, int y) const { return static_cast<std::size_t>(y * cells_ + x); }
    Eigen::Array2i cell_of(const Eigen::Vector2d& pixel) const {
        const Eigen::Array2d size = box_.sizes().array().max(1e-9);
        const Eigen::Array2d place = (pixel - box_.min()).array() / size * cells_;
        return place.max(0.0).min(cells_ - 1.0).cast<int>();
    }

    Eigen::AlignedBox2d box_;
    int cells_;
    std::vector<std::vector<int>> triangles_;
};

/// On the screen; all of `whole` for a triangle that reaches behind the eye.
Eigen::AlignedBox2d extent_of(const std::vector<ProjectedPoint>& seen, const TrianglesView& triangles, Eigen::Index t,
                              const Eigen::AlignedBox2d& whole) {
    constexpr double kRoom = 1e-3;  // pixels, for rounding
    Eigen::AlignedBox2d box;
    for (int i = 0; i < 3; ++i) {
        const ProjectedPoint& corner = seen[static_cast<std::size_t>(triangles(i, t))];
        if (!(corner.depth > 0.0)) return whole;
        box.extend(corner.pixel);
    }
    return {box.min().array() - kRoom, box.max().array() + kRoom};
}

CellGrid sorted_triangles(const std::vector<ProjectedPoint>& seen, std::span<const int> vertices,
                          const TrianglesView& triangles) {
    Eigen::AlignedBox2d box;
    for (const int vertex : vertices) box.extend(seen[static_cast<std::size_t>(vertex)].pixel);
    const int cells = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(vertices.size()))), 1, 128);
    CellGrid grid(box, cells);
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        grid.add(static_cast<int>(t), extent_of(seen, triangles, t, grid.box()));
    return grid;
}

}  // namespace

std::optional<RayHit> first_hit(const Ray& ray, const PositionsView& positions, const TrianglesView& triangles) {
    const Eigen::Matrix3d axes = axes_of(ray.direction);
    const Eigen::Matrix3Xd seen = axes * (positions.colwise() - ray.origin);
    std::optional<RayHit> first;
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const auto a = seen.col(triangles(0, t)), b = seen.col(triangles(1, t)), c = seen.col(triangles(2, t));
        const std::optional<RayHit> hit = meet(a, b, c);
        if (!hit || (first && hit->distance >= first->distance)) continue;
        first = hit;
        first->triangle = static_cast<int>(t);
    }
    return first;
}

bool is_visible(const Eigen::Vector3d& eye, int vertex, const PositionsView& positions,
                const TrianglesView& triangles) {
    const Sight sight(eye, vertex, positions);
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        if (sight.is_blocked_by(t, positions, triangles)) return false;
    return true;
}

std::vector<int> visible_of(std::span<const int> vertices, const Camera& camera, const Viewport& viewport,
                            const PositionsView& positions, const TrianglesView& triangles) {
    if (vertices.empty()) return {};
    std::vector<ProjectedPoint> seen;
    for (Eigen::Index i = 0; i < positions.cols(); ++i) seen.push_back(camera.project(positions.col(i), viewport));
    const CellGrid grid = sorted_triangles(seen, vertices, triangles);
    std::vector<int> visible;
    for (const int vertex : vertices) {
        const Sight sight(camera.eye(), vertex, positions);
        const std::span<const int> near = grid.at(seen[static_cast<std::size_t>(vertex)].pixel);
        const auto blocks = [&](int t) { return sight.is_blocked_by(t, positions, triangles); };
        if (std::none_of(near.begin(), near.end(), blocks)) visible.push_back(vertex);
    }
    return visible;
}

}  // namespace elastolab
