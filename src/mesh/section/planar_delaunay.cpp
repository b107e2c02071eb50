#include "mesh/section/planar_delaunay.hpp"

#include <algorithm>
#include <unordered_map>

namespace elastolab {

namespace {

__extension__ using Wide = __int128;  // products of four differences of 31 bits

constexpr std::size_t next(std::size_t i) { return i == 2 ? 0 : i + 1; }

std::size_t place_of(const std::array<int, 3>& values, int value) {
    return values[0] == value ? 0 : values[1] == value ? 1 : 2;
}

}  // namespace

PlanarDelaunay::PlanarDelaunay() {
    constexpr std::int64_t far = 4 * kSize;
    points_ = {{-far, -far}, {3 * far, -far}, {-far, 3 * far}};
    triangles_ = {{{0, 1, 2}, {-1, -1, -1}}};
    triangle_at_ = {0, 0, 0};
}

std::int64_t PlanarDelaunay::turn(int a, int b, Point c) const {
    const Point &p = points_[static_cast<std::size_t>(a)], &q = points_[static_cast<std::size_t>(b)];
    return (q.x - p.x) * (c.y - p.y) - (q.y - p.y) * (c.x - p.x);
}

bool PlanarDelaunay::in_circle(const Triangle& triangle, Point point) const {
    std::array<Wide, 3> dx, dy, square;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point& corner = points_[static_cast<std::size_t>(triangle.corners[i])];
        dx[i] = corner.x - point.x, dy[i] = corner.y - point.y;
        square[i] = dx[i] * dx[i] + dy[i] * dy[i];
    }
    return square[0] * (dx[1] * dy[2] - dx[2] * dy[1]) + square[1] * (dx[2] * dy[0] - dx[0] * dy[2]) +
               square[2] * (dx[0] * dy[1] - dx[1] * dy[0]) >
           0;
}

int PlanarDelaunay::locate(Point point) const {
    int t = last_;
    for (std::size_t i = 0; i < 3;) {
        const Triangle& triangle = triangles_[static_cast<std::size_t>(t)];
        if (turn(triangle.corners[next(i)], triangle.corners[next(next(i))], point) < 0) {
            t = triangle.across[i];
            i = 0;
        } else {
            ++i;
        }
    }
    return t;
}

int PlanarDelaunay::insert(Point point) {
    const int first = locate(point);
    for (const int corner : triangles_[static_cast<std::size_t>(first)].corners) {
        const Point& p = points_[static_cast<std::size_t>(corner)];
        if (p.x == point.x && p.y == point.y) return corner;
    }
    const int number = n_points();
    points_.push_back(point);
    triangle_at_.push_back(-1);
    // All triangles with the point in their circles; what they leave empty is seen whole from the point.
    std::vector<int> empty{first};
    triangles_[static_cast<std::size_t>(first)].alive = false;
    std::unordered_map<int, int> starting_at;  // new triangles by the first vertex of their outer edges
    std::vector<int> made;
    for (std::size_t k = 0; k < empty.size(); ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Triangle old = triangles_[static_cast<std::size_t>(empty[k])];
            const int across = old.across[i];
            if (across >= 0) {
                Triangle& neighbour = triangles_[static_cast<std::size_t>(across)];
                if (!neighbour.alive) {
                    if (std::find(empty.begin(), empty.end(), across) != empty.end()) continue;
                } else if (in_circle(neighbour, point)) {
                    neighbour.alive = false;
                    empty.push_back(across);
                    continue;
                }
            }
            const int a = old.corners[next(i)], b = old.corners[next(next(i))];
            const int t = static_cast<int>(triangles_.size());
            triangles_.push_back({{a, b, number}, {-1, -1, across}});
            if (across >= 0) {
                Triangle& outer = triangles_[static_cast<std::size_t>(across)];
                outer.across[place_of(outer.across, empty[k])] = t;
            }
            starting_at[a] = t;
            made.push_back(t);
            triangle_at_[static_cast<std::size_t>(a)] = t;
        }
    }
    for (const int t : made) {
        const int following = starting_at.at(triangles_[static_cast<std::size_t>(t)].corners[1]);
        triangles_[static_cast<std::size_t>(t)].across[0] = following;
        triangles_[static_cast<std::size_t>(following)].across[1] = t;
    }
    last_ = made.back();
    triangle_at_[static_cast<std::size_t>(number)] = last_;
    return number;
}

template <class Visit>
bool PlanarDelaunay::any_around(int point, const Visit& visit) const {
    const int first = triangle_at_[static_cast<std::size_t>(point)];
    int t = first;
    do {
        const Triangle& triangle = triangles_[static_cast<std::size_t>(t)];
        const std::size_t i = place_of(triangle.corners, point);
        if (visit(triangle.corners[next(i)])) return true;
        t = triangle.across[next(i)];
    } while (t >= 0 && t != first);
    return false;
}

bool PlanarDelaunay::has_edge(int a, int b) const {
    return any_around(a, [b](int other) { return other == b; });
}

}  // namespace elastolab
