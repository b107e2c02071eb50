#include "mesh/tets/node_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/tets/size_field.hpp"
#include "mesh/tets/tetrahedralize.hpp"

namespace elastolab {

namespace {

/// Columns of points parallel to z through the box of a surface, and where each enters and leaves it.
class Columns2d {
public:
    Columns2d(const SurfaceMesh& surface, int per_side)
        : n_(per_side),
          low_(surface.vertices.rowwise().minCoeff()),
          step_((surface.vertices.rowwise().maxCoeff() - low_) / per_side),
          crossings_(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_)) {
        for (const auto& t : surface.triangles.colwise())
            add(surface.vertices.col(t[0]), surface.vertices.col(t[1]), surface.vertices.col(t[2]));
        for (auto& column : crossings_) std::sort(column.begin(), column.end());
    }

    /// Calls use(point) for the points inside, and returns the volume of each.
    template <class Use>
    double for_each_inside(const Use& use) const {
        for (int i = 0; i < n_; ++i)
            for (int j = 0; j < n_; ++j) {
                const auto& column = crossings_[static_cast<std::size_t>(i * n_ + j)];
                for (std::size_t k = 0; k + 1 < column.size(); k += 2)
                    for (int m = level(column[k]); m < level(column[k + 1]); ++m)
                        use(Eigen::Vector3d(at(0, i), at(1, j), at(2, m)));
            }
        return step_.prod();
    }

private:
    // Off the middle: vertices of boxes and spheres are not hit.
    static constexpr double kOff = 0.4871;
    double at(int axis, int i) const { return low_[axis] + (i + kOff) * step_[axis]; }
    /// First point above z.
    int level(double z) const { return static_cast<int>(std::ceil((z - low_[2]) / step_[2] - kOff)); }

    void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
        const double area = cross(b - a, c - a);
        if (area == 0.0) return;
        const auto first = [&](int axis) {
            const double least = std::min({a[axis], b[axis], c[axis]});
            return std::max(0, static_cast<int>(std::ceil((least - low_[axis]) / step_[axis] - kOff)));
        };
        const auto last = [&](int axis) {
            const double greatest = std::max({a[axis], b[axis], c[axis]});
            return std::min(n_ - 1, static_cast<int>(std::floor((greatest - low_[axis]) / step_[axis] - kOff)));
        };
        for (int i = first(0); i <= last(0); ++i)
            for (int j = first(1); j <= last(1); ++j) {
                const Eigen::Vector3d p(at(0, i), at(1, j), 0.0);
                const double u = cross(b - p, c - p) / area, v = cross(c - p, a - p) / area, w = 1.0 - u - v;
                if (u < 0.0 || v < 0.0 || w < 0.0) continue;
                crossings_[static_cast<std::size_t>(i * n_ + j)].push_back(u * a[2] + v * b[2] + w * c[2]);
            }
    }
    static double cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[0] * b[1] - a[1] * b[0]; }

    int n_;
    Eigen::Vector3d low_, step_;
    std::vector<std::vector<double>> crossings_;
};

}  // namespace

double estimated_tet_nodes(const SurfaceMesh& surface) {
    if (surface.n_triangles() == 0 || !surface.vertices.allFinite()) return surface.n_vertices();
    // Nodes for a cube of the wanted edge, fitted.
    constexpr double kDensity = 1.04;
    constexpr int kPerSide = 24;
    const Eigen::Vector3d origin = surface.vertices.col(0);
    const Positions local = surface.vertices.colwise() - origin;
    const SurfaceMesh moved{local, surface.triangles};
    const SizeField sizes(
        std::vector<double>(local.data(), local.data() + local.size()),
        std::vector<int>(surface.triangles.data(), surface.triangles.data() + surface.triangles.size()),
        default_growth(surface.n_vertices()));
    double sum = 0.0;
    const double volume = Columns2d(moved, kPerSide).for_each_inside([&](const Eigen::Vector3d& x) {
        sum += std::pow(sizes.at(x.data()), -3.0);
    });
    return surface.n_vertices() + kDensity * volume * sum;
}

}  // namespace elastolab
