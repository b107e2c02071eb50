#include "render/geometry/smoothing_groups.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numeric>
#include <tuple>

namespace elastolab {

namespace {

constexpr double kLeastLine = 0.2;  ///< of the bounding box's diagonal

/// One side of a triangle: from its corner `corner` (3 t + i) to the next.
struct Side {
    int low, high;  ///< its vertices in ascending order
    int corner;
    bool ascending;  ///< runs from low to high

    int next_corner() const { return corner % 3 == 2 ? corner - 2 : corner + 1; }
    int corner_at_low() const { return ascending ? corner : next_corner(); }
    int corner_at_high() const { return ascending ? next_corner() : corner; }
};

std::vector<Side> sorted_sides(const TrianglesView& triangles) {
    std::vector<Side> sides;
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t)
        for (int i = 0; i < 3; ++i) {
            const int a = triangles(i, t), b = triangles((i + 1) % 3, t);
            sides.push_back({std::min(a, b), std::max(a, b), 3 * t + i, a < b});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
    });
    return sides;
}

Eigen::Matrix3Xd unit_normals(const PositionsView& positions, const TrianglesView& triangles) {
    Eigen::Matrix3Xd normals(3, triangles.cols());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
        const Eigen::Vector3d a = positions.col(triangles(0, t));
        const Eigen::Vector3d ab = positions.col(triangles(1, t)) - a, ac = positions.col(triangles(2, t)) - a;
        normals.col(t) = ab.normalized().cross(ac.normalized()).normalized();
    }
    return normals;
}

/// Sets of corners, or of vertices, that are joined step by step.
class CornerSets {
public:
    explicit CornerSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
    int root(int corner) {
        while (at(corner) != corner) corner = at(corner) = at(at(corner));
        return corner;
    }
    void join(int a, int b) { at(root(a)) = root(b); }

private:
    int& at(int corner) { return parent_[static_cast<std::size_t>(corner)]; }
    std::vector<int> parent_;
};

void number_groups(CornerSets& sets, const TrianglesView& triangles, SmoothingGroups& groups) {
    std::vector<int> number(static_cast<std::size_t>(3 * triangles.cols()), -1);
    groups.corners.resize(3, triangles.cols());
    for (int corner = 0; corner < static_cast<int>(3 * triangles.cols()); ++corner) {
        int& drawn = number[static_cast<std::size_t>(sets.root(corner))];
        if (drawn < 0) {
            drawn = static_cast<int>(groups.vertices.size());
            groups.vertices.push_back(triangles(corner % 3, corner / 3));
        }
        groups.corners(corner % 3, corner / 3) = drawn;
    }
}

double length(const PositionsView& positions, const Side& side) {
    return (positions.col(side.low) - positions.col(side.high)).norm();
}

/// Those that belong to a line of at least this length: a few sharp edges at the web of a finger, or where a scan
/// crosses itself, look like dirt.
std::vector<const Side*> long_lines(const std::vector<const Side*>& creases, const PositionsView& positions,
                                    double least) {
    CornerSets lines(static_cast<std::size_t>(positions.cols()));
    for (const Side* side : creases) lines.join(side->low, side->high);
    std::vector<double> lengths(static_cast<std::size_t>(positions.cols()));
    const auto length_of_line = [&](const Side* side) -> double& {
        return lengths[static_cast<std::size_t>(lines.root(side->low))];
    };
    for (const Side* side : creases) length_of_line(side) += length(positions, *side);
    std::vector<const Side*> kept;
    for (const Side* side : creases)
        if (length_of_line(side) >= least) kept.push_back(side);
    return kept;
}

double diagonal(const PositionsView& positions) {
    return positions.cols() == 0 ? 0.0 : (positions.rowwise().maxCoeff() - positions.rowwise().minCoeff()).norm();
}

}  // namespace

SmoothingGroups smoothing_groups(const PositionsView& rest, const TrianglesView& triangles, double crease_angle) {
    const Eigen::Matrix3Xd normals = unit_normals(rest, triangles);
    const double least_cosine = std::cos(crease_angle);
    const std::vector<Side> sides = sorted_sides(triangles);
    CornerSets sets(static_cast<std::size_t>(3 * triangles.cols()));
    std::vector<const Side*> creases;
    for (auto side = sides.begin(), next = side; side != sides.end(); side = next) {
        while (next != sides.end() && next->low == side->low && next->high == side->high) ++next;
        const bool joined = next - side == 2 && side[0].ascending != side[1].ascending &&
                            normals.col(side[0].corner / 3).dot(normals.col(side[1].corner / 3)) >= least_cosine;
        if (!joined) creases.push_back(&*side);
        if (!joined) continue;
        sets.join(side[0].corner_at_low(), side[1].corner_at_low());
        sets.join(side[0].corner_at_high(), side[1].corner_at_high());
    }
    creases = long_lines(creases, rest, kLeastLine * diagonal(rest));
    SmoothingGroups groups;
    number_groups(sets, triangles, groups);
    groups.features.resize(2, static_cast<Eigen::Index>(creases.size()));
    const auto drawn = [&groups](int corner) { return groups.corners(corner % 3, corner / 3); };
    for (Eigen::Index i = 0; i < groups.features.cols(); ++i) {
        const Side& side = *creases[static_cast<std::size_t>(i)];
        groups.features.col(i) << drawn(side.corner_at_low()), drawn(side.corner_at_high());
    }
    return groups;
}

}  // namespace elastolab
