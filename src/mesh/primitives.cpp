#include "mesh/primitives.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace elastolab {

using Eigen::Vector3d;
using Eigen::Vector3i;

namespace {

constexpr double kPi = std::numbers::pi;

/// Collects vertices and triangles.
class Builder {
public:
    int vertex(const Vector3d& p) {
        vertices_.push_back(p);
        return static_cast<int>(vertices_.size()) - 1;
    }
    void triangle(int a, int b, int c) { triangles_.emplace_back(a, b, c); }
    /// Quad a b c d, counter-clockwise, cut along a-c or along b-d.
    void quad(int a, int b, int c, int d, bool cut_ac) {
        triangle(a, b, cut_ac ? c : d);
        cut_ac ? triangle(a, c, d) : triangle(b, c, d);
    }
    SurfaceMesh build() const {
        SurfaceMesh mesh{Positions(3, vertices_.size()), Triangles(3, triangles_.size())};
        for (std::size_t i = 0; i < vertices_.size(); ++i)
            mesh.vertices.col(static_cast<Eigen::Index>(i)) = vertices_[i];
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles_[i];
        return mesh;
    }

private:
    std::vector<Vector3d> vertices_;
    std::vector<Vector3i> triangles_;
};

/// Points of an integer lattice, numbered in ascending order (z first, then y, then x).
class Lattice {
public:
    void add(const Vector3i& p) { keys_.push_back(key(p)); }  // in ascending order
    int operator[](const Vector3i& p) const {
        const auto found = std::lower_bound(keys_.begin(), keys_.end(), key(p));
        assert(found != keys_.end() && *found == key(p));
        return static_cast<int>(found - keys_.begin());
    }

private:
    static std::int64_t key(const Vector3i& p) {
        constexpr std::int64_t range = std::int64_t{1} << 21, half = range / 2;
        return ((p.z() + half) * range + p.y() + half) * range + p.x() + half;
    }
    std::vector<std::int64_t> keys_;
};

Vector3i box_cells(int cells, const Vector3d& size) {
    return (size * (cells / size.minCoeff())).array().round().cast<int>().cwiseMax(1);
}

/// The two faces of a box normal to one axis.
void add_box_faces(Builder& builder, const Lattice& lattice, const Vector3i& n, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, n[axis]})
        for (int j = 0; j < n[v]; ++j)
            for (int i = 0; i < n[u]; ++i) {
                Vector3i p;
                p[axis] = side, p[u] = i, p[v] = j;
                const Vector3i du = Vector3i::Unit(u), dv = Vector3i::Unit(v);
                const int a = lattice[p], b = lattice[p + du], c = lattice[p + du + dv], d = lattice[p + dv];
                const bool even = p.sum() % 2 == 0;  // every diagonal joins even lattice points
                side == 0 ? builder.quad(a, d, c, b, even) : builder.quad(a, b, c, d, even);
            }
}

}  // namespace

SurfaceMesh make_box(int cells, const Vector3d& size) {
    assert(cells >= 1 && size.minCoeff() > 0.0);
    const Vector3i n = box_cells(cells, size);
    Builder builder;
    Lattice lattice;
    for (int k = 0; k <= n.z(); ++k)
        for (int j = 0; j <= n.y(); ++j) {
            const bool full_row = k == 0 || k == n.z() || j == 0 || j == n.y();
            for (int i = 0; i <= n.x(); i += full_row ? 1 : n.x()) {
                lattice.add({i, j, k});
                builder.vertex(size.cwiseProduct(Vector3d(i, j, k).cwiseQuotient(n.cast<double>())));
            }
        }
    for (int axis = 0; axis < 3; ++axis) add_box_faces(builder, lattice, n, axis);
    return builder.build();
}

namespace {

/// Point of the unit sphere for a point of the octahedron |i| + |j| + |k| = cells. Along the octahedron's edges the
/// arcs are equal; by the odd sine, the mesh has all symmetries of the octahedron.
Vector3d octahedron_to_sphere(const Vector3i& p, int cells) {
    const auto warp = [cells](int i) { return std::sin(0.5 * kPi * i / cells); };
    return Vector3d(warp(p.x()), warp(p.y()), warp(p.z())).normalized();
}

/// One face of the subdivided octahedron: the octant of these signs.
void add_octant(Builder& builder, const Lattice& lattice, int cells, const Vector3i& signs) {
    const auto at = [&](int i, int j) { return lattice[signs.cwiseProduct(Vector3i(i, j, cells - i - j))]; };
    const auto add = [&](int a, int b, int c) {
        signs.prod() > 0 ? builder.triangle(a, b, c) : builder.triangle(a, c, b);
    };
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i + j < cells; ++i) {
            add(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i + j + 1 < cells) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
}

}  // namespace

SurfaceMesh make_sphere(int cells, double radius) {
    assert(cells >= 1 && radius > 0.0);
    Builder builder;
    Lattice lattice;
    for (int k = -cells; k <= cells; ++k)
        for (int j = std::abs(k) - cells; j <= cells - std::abs(k); ++j) {
            const int i = cells - std::abs(k) - std::abs(j);
            for (int x = -i; x <= i; x += std::max(1, 2 * i)) {
                lattice.add({x, j, k});
                builder.vertex(radius * octahedron_to_sphere({x, j, k}, cells));
            }
        }
    for (const int z : {-1, 1})
        for (const int y : {-1, 1})
            for (const int x : {-1, 1}) add_octant(builder, lattice, cells, {x, y, z});
    return builder.build();
}

namespace {

using Ring = std::vector<int>;  ///< vertices around the z axis, counter-clockwise, the first at angle 0

/// Point i of n around the unit circle; on the axes exactly when n is a multiple of 4.
Eigen::Vector2d circle_point(int i, int n) {
    const int quarter = n % 4 == 0 ? n / 4 : n, turns = i / quarter;
    const double angle = 2.0 * kPi * (i % quarter) / n, c = std::cos(angle), s = std::sin(angle);
    switch (turns) {
        case 0:
            return {c, s};
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        default:
            return {s, -c};
    }
}

Ring add_ring(Builder& builder, int n, double radius, double z) {
    Ring ring;
    for (int i = 0; i < n; ++i) {
        const Eigen::Vector2d p = radius * circle_point(i, n);
        ring.push_back(builder.vertex({p.x(), p.y(), z}));
    }
    return ring;
}

/// Fills between two rings in the plane with triangles that face +z, advancing on the ring that lags behind in angle.
/// An inner "ring" of one vertex is the centre.
void add_annulus(Builder& builder, const Ring& inner, const Ring& outer, bool face_up) {
    const std::int64_t n = inner.size() > 1 ? static_cast<std::int64_t>(inner.size()) : 0, m = std::ssize(outer);
    const auto in = [&](std::int64_t i) { return inner[static_cast<std::size_t>(i) % inner.size()]; };
    const auto out = [&](std::int64_t i) { return outer[static_cast<std::size_t>(i) % outer.size()]; };
    const auto add = [&](int a, int b, int c) { face_up ? builder.triangle(a, b, c) : builder.triangle(a, c, b); };
    for (std::int64_t i = 0, j = 0; i < n || j < m;) {
        const bool advance_outer = i == n || (j < m && (2 * j + 1) * n <= (2 * i + 1) * m);
        if (advance_outer) {
            add(in(i), out(j), out(j + 1));
            ++j;
        } else {
            add(in(i), out(j), in(i + 1));
            ++i;
        }
    }
}

/// Concentric rings from the centre up to, but not including, the rim of n vertices.
std::vector<Ring> add_cap_rings(Builder& builder, int n, double radius, double z) {
    std::vector<Ring> rings{{builder.vertex({0.0, 0.0, z})}};
    const int n_rings = std::max(1, static_cast<int>(std::lround(n / (2.0 * kPi))));  // as far apart as rim vertices
    for (int r = 1; r < n_rings; ++r) {
        const int n_around = static_cast<int>(std::lround(static_cast<double>(n) * r / n_rings));
        rings.push_back(add_ring(builder, n_around, radius * r / n_rings, z));
    }
    return rings;
}

void add_cap(Builder& builder, std::vector<Ring> rings, const Ring& rim, bool face_up) {
    rings.push_back(rim);
    for (std::size_t r = 1; r < rings.size(); ++r) add_annulus(builder, rings[r - 1], rings[r], face_up);
}

/// The band between two rings of the same even number of vertices, diagonals alternating.
void add_band(Builder& builder, const Ring& lower, const Ring& upper, int row) {
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const std::size_t next = (i + 1) % lower.size();
        builder.quad(lower[i], lower[next], upper[next], upper[i], (static_cast<int>(i) + row) % 2 == 0);
    }
}

}  // namespace

SurfaceMesh make_cylinder(int cells, double radius, double height) {
    assert(cells >= 1 && radius > 0.0 && height > 0.0);
    Builder builder;
    const int n_around = 4 * cells;
    const int n_rows = std::max(1, static_cast<int>(std::lround(height * n_around / (2.0 * kPi * radius))));
    const std::vector<Ring> bottom = add_cap_rings(builder, n_around, radius, -0.5 * height);
    std::vector<Ring> side;
    for (int row = 0; row <= n_rows; ++row)
        side.push_back(add_ring(builder, n_around, radius, height * (static_cast<double>(row) / n_rows - 0.5)));
    const std::vector<Ring> top = add_cap_rings(builder, n_around, radius, 0.5 * height);
    add_cap(builder, bottom, side.front(), false);
    for (int row = 0; row < n_rows; ++row)
        add_band(builder, side[static_cast<std::size_t>(row)], side[static_cast<std::size_t>(row) + 1], row);
    add_cap(builder, top, side.back(), true);
    return builder.build();
}

SurfaceMesh make_torus(int cells, double ring_radius, double tube_radius) {
    assert(cells >= 1 && tube_radius > 0.0 && tube_radius < ring_radius);
    Builder builder;
    // Cells around the tube about as long as those around the ring; an even number, for alternating diagonals.
    const int n_tube = std::max(4, 2 * static_cast<int>(std::lround(2.0 * cells * tube_radius / ring_radius)));
    std::vector<Ring> rings;
    for (int i = 0; i < n_tube; ++i) {
        const double angle = 2.0 * kPi * i / n_tube;
        rings.push_back(
            add_ring(builder, 4 * cells, ring_radius + tube_radius * std::cos(angle), tube_radius * std::sin(angle)));
    }
    for (int i = 0; i < n_tube; ++i)
        add_band(builder, rings[static_cast<std::size_t>(i)], rings[static_cast<std::size_t>((i + 1) % n_tube)], i);
    return builder.build();
}

SurfaceMesh make_hollow_sphere(int cells, double outer_radius, double inner_radius) {
    assert(inner_radius > 0.0 && inner_radius < outer_radius);
    // The same mesh at both radii: scaled copies never touch, however thin the shell.
    const SurfaceMesh outer = make_sphere(cells, outer_radius), inner = make_sphere(cells, inner_radius);
    SurfaceMesh mesh{Positions(3, 2 * outer.n_vertices()), Triangles(3, 2 * outer.n_triangles())};
    mesh.vertices << outer.vertices, inner.vertices;
    const Triangles inward = (inner.triangles.array() + outer.n_vertices()).matrix()(Vector3i(0, 2, 1), Eigen::all);
    mesh.triangles << outer.triangles, inward;
    return mesh;
}

}  // namespace elastolab
