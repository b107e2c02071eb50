#include "study/error/sphere_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace elastolab {

namespace {

double orientation(const Positions& p, int a, int b, int c) { return p.col(a).dot(p.col(b).cross(p.col(c))); }

/// Positive when point d lies outside the plane of the face.
double height_above(const Positions& p, const Eigen::Vector3i& f, int d) {
    return (p.col(f[1]) - p.col(f[0])).cross(p.col(f[2]) - p.col(f[0])).dot(p.col(d) - p.col(f[0]));
}

/// First tetrahedron of the hull: far-apart points, outward faces.
std::vector<Eigen::Vector3i> first_faces(const Positions& p) {
    const auto farthest = [&](auto&& measure) {
        int best = 0;
        for (int i = 1; i < p.cols(); ++i)
            if (measure(i) > measure(best)) best = i;
        return best;
    };
    const int a = 0;
    const int b = farthest([&](int i) { return (p.col(i) - p.col(a)).norm(); });
    const int c = farthest([&](int i) { return (p.col(i) - p.col(a)).cross(p.col(b) - p.col(a)).norm(); });
    const int d = farthest([&](int i) { return std::abs(height_above(p, {a, b, c}, i)); });
    std::vector<Eigen::Vector3i> faces = {{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}};
    if (height_above(p, faces[0], d) > 0.0)
        for (Eigen::Vector3i& f : faces) std::swap(f[1], f[2]);
    return faces;
}

/// Replaces the faces that see point d by a fan from d to their outline.
void add_point(std::vector<Eigen::Vector3i>& faces, const Positions& p, int d) {
    std::set<std::pair<int, int>> outline;
    std::vector<Eigen::Vector3i> kept;
    for (const Eigen::Vector3i& f : faces) {
        if (height_above(p, f, d) <= 0.0) {
            kept.push_back(f);
            continue;
        }
        for (int i = 0; i < 3; ++i) {
            const int from = f[i], to = f[(i + 1) % 3];
            if (outline.erase({to, from}) == 0) outline.insert({from, to});
        }
    }
    for (const auto& [from, to] : outline) kept.emplace_back(from, to, d);
    faces = std::move(kept);
}

/// Cotangent of the angle at corner c of the triangle with the edge ab.
double cotangent(const Positions& x, int a, int b, int c) {
    const Eigen::Vector3d u = x.col(a) - x.col(c), v = x.col(b) - x.col(c);
    return u.dot(v) / u.cross(v).norm();
}

}  // namespace

Triangles triangulate_sphere(const Positions& directions) {
    std::vector<Eigen::Vector3i> faces = first_faces(directions);
    std::set<int> used;
    for (const Eigen::Vector3i& f : faces) used.insert(f.begin(), f.end());
    for (int i = 0; i < directions.cols(); ++i)
        if (used.count(i) == 0) add_point(faces, directions, i);
    Triangles triangles(3, std::ssize(faces));
    for (std::size_t t = 0; t < faces.size(); ++t) triangles.col(static_cast<Eigen::Index>(t)) = faces[t];
    return triangles;
}

void flip_to_delaunay(Triangles& triangles, const Positions& directions, const Positions& places) {
    std::map<std::pair<int, int>, Eigen::Index> triangle_of;  // by directed edge
    for (Eigen::Index t = 0; t < triangles.cols(); ++t)
        for (int i = 0; i < 3; ++i) triangle_of[{triangles(i, t), triangles((i + 1) % 3, t)}] = t;
    const auto opposite = [&](Eigen::Index t, int a, int b) { return triangles.col(t).sum() - a - b; };
    const auto set_triangle = [&](Eigen::Index t, int a, int b, int c) {
        triangles.col(t) << a, b, c;
        triangle_of[{a, b}] = triangle_of[{b, c}] = triangle_of[{c, a}] = t;
    };
    bool changed = true;
    for (int round = 0; changed && round < 50; ++round) {
        changed = false;
        for (Eigen::Index t = 0; t < triangles.cols(); ++t)
            for (int i = 0; i < 3; ++i) {
                const int a = triangles(i, t), b = triangles((i + 1) % 3, t);
                const Eigen::Index other = triangle_of.at({b, a});
                const int c = opposite(t, a, b), d = opposite(other, a, b);
                // The angles opposite to the edge sum to more than a half turn: the other diagonal is better.
                if (cotangent(places, a, b, c) + cotangent(places, a, b, d) > -1e-9) continue;
                if (triangle_of.count({c, d}) != 0 || orientation(directions, c, d, b) <= 0.0 ||
                    orientation(directions, d, c, a) <= 0.0)
                    continue;
                triangle_of.erase({a, b});
                triangle_of.erase({b, a});
                set_triangle(t, c, d, b);
                set_triangle(other, d, c, a);
                changed = true;
                break;
            }
    }
}

}  // namespace elastolab
