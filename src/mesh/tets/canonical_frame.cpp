#include "mesh/tets/canonical_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <Eigen/LU>
#include <numeric>
#include <tuple>

#include "mesh/tets/boundary.hpp"

namespace elastolab {

namespace {

using GridPoints = Eigen::Matrix<std::int64_t, 3, Eigen::Dynamic>;

/// A signed permutation of the axes: coordinate i of the frame is sign[i] times coordinate axis[i] of the solid.
struct Axes {
    std::array<int, 3> axis{};
    std::array<int, 3> sign{};

    Eigen::Matrix3d matrix() const {
        Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
        for (std::size_t i = 0; i < 3; ++i) m(static_cast<int>(i), axis[i]) = sign[i];
        return m;
    }
};

/// What distinguishes one axis from another, and one direction of it from the other, in whole numbers so that no order
/// of summation matters. Points are taken on a coarse grid: differences by rounding shall not decide.
struct Moments {
    std::int64_t second = 0, third = 0;
};

constexpr int kCoarseBits = 12;  // cubes of 12 bits: millions of them fit in 64

std::array<Moments, 3> moments_of(const GridPoints& points, int grid_bits) {
    std::array<Moments, 3> moments;
    const double to_coarse = std::ldexp(1.0, kCoarseBits - grid_bits);
    for (Eigen::Index v = 0; v < points.cols(); ++v)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int64_t x = std::llround(to_coarse * static_cast<double>(points(static_cast<int>(i), v)));
            moments[i].second += x * x;
            moments[i].third += x * x * x;
        }
    return moments;
}

/// The signed permutations that the moments do not tell apart: one for most bodies, up to 48 for symmetric ones.
std::vector<Axes> candidates(const std::array<Moments, 3>& moments) {
    const auto rank = [&](int axis) {
        const Moments& m = moments[static_cast<std::size_t>(axis)];
        return std::pair(-m.second, -std::abs(m.third));
    };
    std::vector<Axes> found;
    std::array<int, 3> axis{0, 1, 2};
    do {
        if (rank(axis[0]) > rank(axis[1]) || rank(axis[1]) > rank(axis[2])) continue;
        for (int signs = 0; signs < 8; ++signs) {
            Axes axes{axis, {}};
            bool fits = true;
            for (std::size_t i = 0; i < 3; ++i) {
                axes.sign[i] = (signs >> i) % 2 == 0 ? 1 : -1;
                fits &= axes.sign[i] * moments[static_cast<std::size_t>(axis[i])].third >= 0;
            }
            if (fits) found.push_back(axes);
        }
    } while (std::next_permutation(axis.begin(), axis.end()));
    return found;
}

/// The body seen along axes, in ascending order.
struct View {
    GridPoints points;
    Triangles triangles;
    std::vector<int> vertices;  // of the solid
};

bool less(const auto& a, const auto& b) {
    return std::lexicographical_compare(a.data(), a.data() + a.size(), b.data(), b.data() + b.size());
}

View view_along(const Axes& axes, const GridPoints& points, const Triangles& triangles) {
    GridPoints turned(3, points.cols());
    for (std::size_t i = 0; i < 3; ++i) turned.row(static_cast<int>(i)) = axes.sign[i] * points.row(axes.axis[i]);
    View view;
    view.vertices.resize(static_cast<std::size_t>(points.cols()));
    std::iota(view.vertices.begin(), view.vertices.end(), 0);
    const auto key = [&](int v) { return std::tuple(turned(0, v), turned(1, v), turned(2, v)); };
    std::stable_sort(view.vertices.begin(), view.vertices.end(), [&](int a, int b) { return key(a) < key(b); });
    view.points = turned(Eigen::all, view.vertices);

    Eigen::VectorXi place(points.cols());
    for (std::size_t i = 0; i < view.vertices.size(); ++i) place[view.vertices[i]] = static_cast<int>(i);
    Triangles renumbered = triangles.unaryExpr([&](int v) { return place[v]; });
    if (axes.matrix().determinant() < 0.0) renumbered.row(1).swap(renumbered.row(2));
    view.triangles = canonical(renumbered);
    return view;
}

bool comes_first(const View& a, const View& b) {
    if (a.points != b.points) return less(a.points, b.points);
    return less(a.triangles, b.triangles);
}

}  // namespace

CanonicalFrame::CanonicalFrame(const SurfaceMesh& solid, int grid_bits) {
    const Eigen::Vector3d low = solid.vertices.rowwise().minCoeff(), high = solid.vertices.rowwise().maxCoeff();
    centre_ = 0.5 * low + 0.5 * high;
    size_ = (high - low).maxCoeff();
    const double grid = std::ldexp(1.0, grid_bits);
    const GridPoints points = ((solid.vertices.colwise() - centre_) / size_).unaryExpr([&](double x) {
        return static_cast<std::int64_t>(std::llround(grid * x));
    });
    View best;
    for (const Axes& axes : candidates(moments_of(points, grid_bits))) {
        View view = view_along(axes, points, solid.triangles);
        if (!best.vertices.empty() && !comes_first(view, best)) continue;
        best = std::move(view);
        axes_ = axes.matrix();
    }
    mesh_ = {best.points.cast<double>() / grid, std::move(best.triangles)};
    vertices_ = std::move(best.vertices);
}

Positions CanonicalFrame::to_solid(const Positions& points) const {
    return (size_ * (axes_.transpose() * points)).colwise() + centre_;
}

}  // namespace elastolab
