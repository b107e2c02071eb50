#pragma once

#include <array>
#include <cstdint>
#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab::bodies {

/// A closed triangulated surface that can be edited. Every triangle lies on one sheet of the solid; every vertex knows
/// all sheets it is to lie on: one inside a sheet, two on a sharp edge, three at a corner.
class Patchwork {
public:
    using Triangle = std::array<int, 3>;
    using Sheets = std::uint32_t;  ///< one bit each

    int add_vertex(const Eigen::Vector3d& place, Sheets sheets);
    void add_triangle(const Triangle& corners, int sheet);

    int n_vertices() const { return static_cast<int>(places_.size()); }
    int n_triangles() const { return static_cast<int>(triangles_.size()); }
    const Eigen::Vector3d& place(int v) const { return places_[static_cast<std::size_t>(v)]; }
    void move(int v, const Eigen::Vector3d& to) { places_[static_cast<std::size_t>(v)] = to; }
    Sheets sheets(int v) const { return sheets_[static_cast<std::size_t>(v)]; }
    /// How sharp it is there: 1 inside a sheet, 2 on an edge, 3 at a corner.
    int rank(int v) const;
    const Triangle& triangle(int t) const { return triangles_[static_cast<std::size_t>(t)]; }
    bool exists(int t) const { return triangle(t)[0] >= 0; }
    int sheet(int t) const { return sheet_[static_cast<std::size_t>(t)]; }
    const std::vector<int>& around(int v) const { return around_[static_cast<std::size_t>(v)]; }

    /// Vertices joined to v, ascending.
    std::vector<int> neighbours(int v) const;
    /// Each edge once, a < b, ascending.
    std::vector<std::array<int, 2>> edges() const;

    /// The two triangles on an edge and the vertices opposite to it; left of a -> b first.
    struct Wing {
        int left = -1, right = -1;
        int left_tip = -1, right_tip = -1;
    };
    Wing wing(int a, int b) const;
    bool is_sharp(const Wing& wing) const { return sheet(wing.left) != sheet(wing.right); }

    /// Puts a vertex on an edge.
    int split(int a, int b, const Eigen::Vector3d& place);
    /// The vertices a and b become b. Keeps the surface a manifold if may_collapse says so.
    void collapse(int a, int b);
    bool may_collapse(int a, int b) const;
    /// Joins the tips instead.
    void flip(int a, int b);

    /// Places rounded to 5 decimals, vertices numbered along the surface so that a file reads well.
    SurfaceMesh surface() const;

private:
    void attach(int t);
    void detach(int t);
    void replace(int t, const Triangle& corners);

    std::vector<Eigen::Vector3d> places_;
    std::vector<Sheets> sheets_;
    std::vector<std::vector<int>> around_;  // triangles of every vertex, unordered
    std::vector<Triangle> triangles_;       // of -1 once removed
    std::vector<int> sheet_;
};

}  // namespace elastolab::bodies
