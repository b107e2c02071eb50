#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace elastolab {

/// A Delaunay triangulation of points with integer coordinates, one inserted after the other (A. Bowyer, D. F. Watson,
/// The Computer Journal 24, 1981). All decisions are exact, so that degenerate positions do no harm.
class PlanarDelaunay {
public:
    /// Coordinates are from 0 to this.
    static constexpr std::int64_t kSize = std::int64_t{1} << 26;
    struct Point {
        std::int64_t x, y;
    };
    /// Corners, counter-clockwise, and the triangle across from each (-1: none). The first three points are those of a
    /// triangle around all others.
    struct Triangle {
        std::array<int, 3> corners, across;
        bool alive = true;
    };

    PlanarDelaunay();
    /// Returns the number of the point; where an earlier one is at the same place, that of the earlier one.
    int insert(Point point);
    int n_points() const { return static_cast<int>(points_.size()); }
    /// Those with alive == false are no part of it.
    const std::vector<Triangle>& triangles() const { return triangles_; }
    bool has_edge(int a, int b) const;

private:
    int locate(Point point) const;
    bool in_circle(const Triangle& triangle, Point point) const;
    std::int64_t turn(int a, int b, Point c) const;
    template <class Visit>
    bool any_around(int point, const Visit& visit) const;

    std::vector<Point> points_;
    std::vector<Triangle> triangles_;
    std::vector<int> triangle_at_;  ///< one at each point
    int last_ = 0;
};

}  // namespace elastolab
