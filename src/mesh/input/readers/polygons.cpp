#include "mesh/input/readers/polygons.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <queue>
#include <string>

#include "mesh/checks/predicates.hpp"
#include "mesh/input/readers/readers.hpp"

namespace elastolab {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3i;

namespace {

template <class Vector>
auto& at(Vector& values, int i) {
    return values[static_cast<std::size_t>(i)];
}

/// Cuts ears off one polygon, seen along its normal: always the best, of equal ones the first. Only corners that are
/// not convex can lie in an ear, so that a convex polygon takes n log n steps, others n times the number of such
/// corners.
class EarClipping {
public:
    EarClipping(std::vector<int> corners, const std::vector<Vector3d>& vertices) : corners_(std::move(corners)) {
        const int n = size();
        for (int i = 0; i < n; ++i) {
            previous_.push_back((i + n - 1) % n);
            next_.push_back((i + 1) % n);
        }
        project(vertices);
        for (int i = 0; i < n; ++i)
            if (is_dented(i)) dents_.push_back(i);
        if (static_cast<double>(n) * static_cast<double>(dents_.size()) > kMostSteps)
            throw Refusal("a face has " + std::to_string(n) + " corners, " + std::to_string(dents_.size()) +
                          " of them not convex, too many to split it. Triangulate the mesh and export it again.");
        quality_.assign(static_cast<std::size_t>(n), 0.0);
        for (int i = 0; i < n; ++i) judge(i);
    }

    void run(std::vector<Vector3i>& triangles) {
        for (int left = size(), any = 0; left > 2; --left) {
            const int tip = best_ear(any);
            const int before = at(previous_, tip), after = at(next_, tip);
            triangles.push_back(Vector3i(at(corners_, before), at(corners_, tip), at(corners_, after)));
            at(next_, before) = after;
            at(previous_, after) = before;
            at(next_, tip) = kCutOff;
            judge(before);
            judge(after);
            any = after;
        }
    }

private:
    static constexpr int kCutOff = -1;
    static constexpr double kMostSteps = 2e8;  ///< a few seconds
    /// An ear: the best first, of equal ones the first corner.
    struct Ear {
        double quality;
        int tip;
        bool operator<(const Ear& other) const {
            return quality != other.quality ? quality < other.quality : tip > other.tip;
        }
    };

    int size() const { return static_cast<int>(corners_.size()); }
    bool is_cut_off(int i) const { return at(next_, i) == kCutOff; }
    bool is_dented(int i) const { return turn(at(previous_, i), i, at(next_, i)) <= 0; }

    void judge(int tip) {
        at(quality_, tip) = ear_quality(tip);
        if (at(quality_, tip) > 0.0) ears_.push({at(quality_, tip), tip});
    }
    /// The polygon in the plane across its mean normal (Newell), in units of its size.
    void project(const std::vector<Vector3d>& vertices) {
        std::vector<Vector3d> places;
        const Vector3d origin = at(vertices, corners_.front());
        for (const int v : corners_) places.push_back(at(vertices, v) - origin);
        double extent = 0.0;
        for (const Vector3d& p : places) extent = std::max(extent, p.lpNorm<Eigen::Infinity>());
        if (!std::isfinite(extent) || extent == 0.0) extent = 1.0;
        Vector3d normal = Vector3d::Zero();
        for (std::size_t i = 1; i + 1 < places.size(); ++i)
            normal += (places[i] / extent).cross(places[i + 1] / extent);
        const Vector3d x = normal.stableNormalized().unitOrthogonal(), y = normal.stableNormalized().cross(x);
        for (const Vector3d& p : places) points_.emplace_back(x.dot(p) / extent, y.dot(p) / extent);
    }

    int turn(int a, int b, int c) const { return orientation(at(points_, a), at(points_, b), at(points_, c)); }

    /// How good a triangle this corner makes with its neighbours: altitude over longest edge; at most 0 when it is no
    /// ear.
    double ear_quality(int tip) {
        const int a = at(previous_, tip), c = at(next_, tip);
        if (turn(a, tip, c) <= 0) return 0.0;
        std::size_t n_dents = 0;  // what was cut off or has become convex leaves the list
        bool is_blocked = false;
        for (const int i : dents_) {
            if (is_cut_off(i) || !is_dented(i)) continue;
            at(dents_, static_cast<int>(n_dents++)) = i;
            is_blocked = is_blocked || (i != a && i != tip && i != c && blocks(i, a, tip, c));
        }
        dents_.resize(n_dents);
        if (is_blocked) return 0.0;
        const Vector2d u = at(points_, tip) - at(points_, a), v = at(points_, c) - at(points_, a);
        const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
        return std::abs(u.x() * v.y() - u.y() * v.x()) / longest;
    }

    /// Whether corner i lies in the triangle or on its edge; a corner at the place of another (where a hole is joined
    /// to the rim by an edge there and back) does not count.
    bool blocks(int i, int a, int tip, int c) const {
        const Vector2d& p = at(points_, i);
        if (p == at(points_, a) || p == at(points_, tip) || p == at(points_, c)) return false;
        return turn(a, tip, i) >= 0 && turn(tip, c, i) >= 0 && turn(c, a, i) >= 0;
    }

    /// The best ear; any corner, when there is no ear left.
    int best_ear(int any) {
        for (; !ears_.empty(); ears_.pop()) {
            const Ear best = ears_.top();  // what was judged anew since is in the queue once more
            if (!is_cut_off(best.tip) && at(quality_, best.tip) == best.quality) return best.tip;
        }
        return any;
    }

    std::vector<int> corners_, previous_, next_;
    std::vector<Vector2d> points_;
    std::vector<double> quality_;
    std::vector<int> dents_;  ///< corners that are not convex
    std::priority_queue<Ear> ears_;
};

std::vector<int> without_repetition(std::span<const int> corners, const std::vector<Vector3d>& vertices) {
    const auto same = [&](int a, int b) {
        return vertices[static_cast<std::size_t>(a)] == vertices[static_cast<std::size_t>(b)];
    };
    std::vector<int> ring;
    for (const int v : corners)
        if (ring.empty() || !same(ring.back(), v)) ring.push_back(v);
    while (ring.size() > 1 && same(ring.front(), ring.back())) ring.pop_back();
    return ring;
}

/// Four corners, split along the diagonal from 0 to 2 if the quadrilateral lies on both its sides, else from 1 to 3.
void split(const std::vector<int>& q, const std::vector<Vector3d>& vertices, std::vector<Vector3i>& triangles) {
    const auto place = [&](int i) { return vertices[static_cast<std::size_t>(q[static_cast<std::size_t>(i)])]; };
    const Vector3d normal = (place(2) - place(0)).cross(place(3) - place(1));
    const auto faces_along = [&](int a, int b, int c) {
        return normal.dot((place(b) - place(a)).cross(place(c) - place(a))) > 0.0;
    };
    const bool first = faces_along(0, 1, 2) && faces_along(0, 2, 3);
    const bool second = !first && faces_along(1, 2, 3) && faces_along(1, 3, 0);
    const auto put = [&](std::size_t a, std::size_t b, std::size_t c) { triangles.emplace_back(q[a], q[b], q[c]); };
    if (second) {
        put(1, 2, 3);
        put(1, 3, 0);
    } else {
        put(0, 1, 2);
        put(0, 2, 3);
    }
}

void require_size(std::size_t count) {
    constexpr std::size_t kMost = 100'000'000;  // 3 x triangles must fit into an int
    if (count > kMost) throw Refusal("has more than a hundred million vertices or triangles. Simplify it.");
}

template <class Column, class Matrix>
void fill(Matrix& matrix, const std::vector<Column>& columns) {
    require_size(columns.size());
    matrix.resize(3, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = columns[i];
}

}  // namespace

int checked_index(std::int64_t index, std::size_t n_vertices, int first_number) {
    if (index < 0 || index >= static_cast<std::int64_t>(n_vertices))
        throw Refusal("a face refers to vertex " + std::to_string(index + first_number) + " (counted from " +
                      std::to_string(first_number) + "), and there are " + std::to_string(n_vertices) +
                      ". Export the mesh again.");
    return static_cast<int>(index);
}

void triangulate(std::span<const int> corners, const std::vector<Vector3d>& vertices,
                 std::vector<Vector3i>& triangles) {
    if (corners.size() == 3) {  // as it is: what is wrong with it is for the check to say
        triangles.emplace_back(corners[0], corners[1], corners[2]);
        return;
    }
    const std::vector<int> ring = without_repetition(corners, vertices);
    if (ring.size() == 3)
        triangles.emplace_back(ring[0], ring[1], ring[2]);
    else if (ring.size() == 4)
        split(ring, vertices, triangles);
    else if (ring.size() > 4)
        EarClipping(ring, vertices).run(triangles);
}

SurfaceMesh triangulated(const PolygonMesh& mesh) {
    require_size(mesh.vertices.size());
    for (const int v : mesh.corners) checked_index(v, mesh.vertices.size(), mesh.first_number);
    std::vector<Vector3i> triangles;
    std::size_t begin = 0;
    for (const std::size_t end : mesh.ends) {
        triangulate(std::span(mesh.corners).subspan(begin, end - begin), mesh.vertices, triangles);
        begin = end;
    }
    SurfaceMesh result;
    fill(result.vertices, mesh.vertices);
    fill(result.triangles, triangles);
    return result;
}

}  // namespace elastolab
