#include "elasticity/outer_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace elastolab {

namespace {

using Vec = Eigen::Vector3d;

constexpr double kInfinite = 1e300;
/// Cuts in both directions together: enough for edges above edges at 1e-9 of their length; ends the recursion where
/// triangles cross one another.
constexpr int kMaxCuts = 64;
/// Edges of the field triangle cut a test triangle that they come closer to, in units of its longest edge.
constexpr double kCutWithin = 0.1;
/// Share of the tolerance below which the cells at a singularity are no longer cut: there are some dozens of them.
constexpr double kNegligible = 0.03;

/// The long semi-axis of the ellipse with foci -1 and 1 through the zeros of |w + z h|^2: half the sum of their
/// distances from the foci.
double axis_through_zeros(double ww, double wh, double hh) {
    const double real = -wh / hh, imaginary2 = std::max(0.0, ww / hh - real * real);
    const double left = real + 1.0, right = real - 1.0;
    return 0.5 * (std::sqrt(left * left + imaginary2) + std::sqrt(right * right + imaginary2));
}

/// The singularities of the closed form over a triangle, for many chords.
class EdgeSingularities {
public:
    explicit EdgeSingularities(const TriangleGeometry& field) {
        for (int i = 0; i < 3; ++i) {
            const Eigen::Map<const Vec> begin(field.corner[i]), end(field.corner[(i + 1) % 3]);
            edges_[static_cast<std::size_t>(i)] = {begin, (end - begin).normalized(), (end - begin).norm()};
        }
    }

    /// Long semi-axis of the largest ellipse for the chord m + z h, -1 <= z <= 1; `least` where it is no smaller.
    double axis(const Vec& m, const Vec& h, double least) const {
        for (std::size_t i = 0; i < 3; ++i) least = beside_line(edges_[i], m, h, at_corner(edges_[i], m, h, least));
        return least;
    }

    /// The same where one edge and its ends are all that counts.
    double axis_of(int edge, const Vec& m, const Vec& h) const {
        const auto i = static_cast<std::size_t>(edge);
        const double at_corners = at_corner(edges_[(i + 1) % 3], m, h, at_corner(edges_[i], m, h, kInfinite));
        return beside_line(edges_[i], m, h, at_corners);
    }

private:
    struct Edge {
        Vec begin, along;  ///< along: unit
        double length;
    };

    /// Of the zeros of the distance from the corner where an edge begins. A zero lies no farther than the ellipse's
    /// long semi-axis from the middle, which tells of most chords that they need no roots.
    static double at_corner(const Edge& edge, const Vec& m, const Vec& h, double least) {
        const Vec w = m - edge.begin;
        const double ww = w.squaredNorm(), hh = h.squaredNorm();
        return ww < least * least * hh ? std::min(least, axis_through_zeros(ww, w.dot(h), hh)) : least;
    }

    /// Of the zeros of the distance from the line through both ends that project between them.
    static double beside_line(const Edge& edge, const Vec& m, const Vec& h, double least) {
        const Vec w = m - edge.begin;
        const double w_along = w.dot(edge.along), h_along = h.dot(edge.along);
        const Vec w_across = w - w_along * edge.along, h_across = h - h_along * edge.along;
        const double ww = w_across.squaredNorm(), hh = h_across.squaredNorm();
        if (hh < 1e-24 * h.squaredNorm() || ww >= least * least * hh) return least;
        const double wh = w_across.dot(h_across), nearest = w_along - wh / hh * h_along;
        if (nearest < 0.0 || nearest > edge.length) return least;
        return std::min(least, axis_through_zeros(ww, wh, hh));
    }

    std::array<Edge, 3> edges_;
};

/// The parameter rho, which is the sum of both semi-axes, from the long one.
double ellipse_of(double axis) {
    return axis < kInfinite ? axis + std::sqrt(std::max(0.0, axis * axis - 1.0)) : kInfinite;
}

using Corners = std::array<Vec, 3>;

Vec point(const Corners& T, double u, double v) { return T[0] + u * (T[1] - T[0] + v * (T[2] - T[1])); }

/// Cuts one part of a test triangle into cells.
class Cutter {
public:
    /// share: of the part in the whole test triangle.
    Cutter(const Corners& part, double share, const EdgeSingularities& singularities, const OuterAccuracy& accuracy,
           const std::function<void(const OuterCell&)>& visit)
        : part_(part), share_(share), singularities_(singularities), accuracy_(accuracy), visit_(visit) {}

    void cut(OuterCell cell, int n_cuts) const {
        const double u = 0.5 * (cell.u0 + cell.u1), v = 0.5 * (cell.v0 + cell.v1);
        double axis_u = kInfinite, axis_v = kInfinite;
        for (const double at : {v, cell.v0, cell.v1}) axis_u = axis(cell.u0, at, cell.u1, at, axis_u);
        for (const double at : {u, cell.u0, cell.u1}) axis_v = axis(at, cell.v0, at, cell.v1, axis_v);
        const double rho_u = ellipse_of(axis_u), rho_v = ellipse_of(axis_v);
        // Small cells may be less exact: those of one size lie side by side along a line, so that there are few of
        // them.
        const double share = share_ * (cell.u1 * cell.u1 - cell.u0 * cell.u0) * (cell.v1 - cell.v0);
        const double tolerance = std::min(0.1, accuracy_.tolerance / std::sqrt(share));
        cell.n_u = gauss_points(rho_u, tolerance);
        cell.n_v = gauss_points(rho_v, tolerance);
        if (std::max(cell.n_u, cell.n_v) <= accuracy_.max_points || n_cuts == kMaxCuts || is_negligible(share, cell)) {
            cell.n_u = std::min(cell.n_u, accuracy_.max_points);
            cell.n_v = std::min(cell.n_v, accuracy_.max_points);
            return visit_(cell);
        }
        OuterCell first = cell, second = cell;
        if (rho_u <= rho_v)
            first.u1 = second.u0 = u;
        else
            first.v1 = second.v0 = v;
        cut(first, n_cuts + 1);
        cut(second, n_cuts + 1);
    }

private:
    /// Whether what a potential does within a cell no longer counts: it stays below its mean, and a continuous one
    /// changes by no more than the width of the cell.
    bool is_negligible(double share, const OuterCell& cell) const {
        const double width = accuracy_.is_continuous ? std::min(cell.u1 - cell.u0, cell.u1 * (cell.v1 - cell.v0)) : 1.0;
        return share * width < kNegligible * accuracy_.tolerance;
    }
    double axis(double u0, double v0, double u1, double v1, double least) const {
        const Vec p = point(part_, u0, v0), q = point(part_, u1, v1), half = 0.5 * (q - p);
        return half.squaredNorm() == 0.0 ? least : singularities_.axis(0.5 * (p + q), half, least);
    }

    const Corners& part_;
    double share_;
    const EdgeSingularities& singularities_;
    const OuterAccuracy& accuracy_;
    const std::function<void(const OuterCell&)>& visit_;
};

/// A line of a plane that convex polygons are cut along which reach farther than `least` to either side.
struct CutLine {
    Vec point, across;  ///< unit
    double least;
};

/// The part of a field triangle's edge over (or under) the test triangle, if it comes close to it there.
std::optional<CutLine> line_under(const Vec& a, const Vec& b, const Corners& test, const Vec& normal, double size) {
    double from = 0.0, to = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec inward = normal.cross(test[(i + 1) % 3] - test[i]);
        const double at_a = (a - test[i]).dot(inward), at_b = (b - test[i]).dot(inward);
        if (at_a <= 0.0 && at_b <= 0.0) return {};
        const double zero = at_a / (at_a - at_b);
        if (at_a < 0.0) from = std::max(from, zero);
        if (at_b < 0.0) to = std::min(to, zero);
    }
    const double z_a = (a + from * (b - a) - test[0]).dot(normal), z_b = (a + to * (b - a) - test[0]).dot(normal);
    const double height = z_a * z_b < 0.0 ? 0.0 : std::min(std::abs(z_a), std::abs(z_b));
    const Vec across = normal.cross(b - a);
    if (from >= to || height > kCutWithin * size || across.norm() < 1e-6 * (b - a).norm()) return {};
    return CutLine{a, across.normalized(), std::max(0.5 * height, 1e-12 * size)};
}

using Polygon = std::vector<Vec>;

/// The polygons on both sides of the line; the polygon itself where the line misses it.
std::vector<Polygon> cut_along(const CutLine& line, const Polygon& polygon) {
    std::vector<double> side;
    for (const Vec& p : polygon) side.push_back((p - line.point).dot(line.across));
    if (*std::min_element(side.begin(), side.end()) >= -line.least ||
        *std::max_element(side.begin(), side.end()) <= line.least)
        return {polygon};
    std::vector<Polygon> halves(2);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t next = (i + 1) % polygon.size();
        if (side[i] >= 0.0) halves[0].push_back(polygon[i]);
        if (side[i] <= 0.0) halves[1].push_back(polygon[i]);
        if (side[i] * side[next] >= 0.0) continue;
        const Vec between = polygon[i] + side[i] / (side[i] - side[next]) * (polygon[next] - polygon[i]);
        for (Polygon& half : halves) half.push_back(between);
    }
    return halves;
}

/// The test triangle, cut along the edges of the field triangle that lie close over it: each part then has the
/// potential's singularities along its own edges only, where cells are long.
std::vector<Polygon> parts_of(const Corners& test, const TriangleGeometry& field) {
    const Vec cross = (test[1] - test[0]).cross(test[2] - test[0]), normal = cross.normalized();
    const double size = std::max({(test[1] - test[0]).norm(), (test[2] - test[1]).norm(), (test[0] - test[2]).norm()});
    std::vector<Polygon> parts{{test.begin(), test.end()}};
    for (int edge = 0; edge < 3; ++edge) {
        const Eigen::Map<const Vec> a(field.corner[edge]), b(field.corner[(edge + 1) % 3]);
        const auto line = line_under(a, b, test, normal, size);
        if (!line) continue;
        std::vector<Polygon> finer;
        for (const Polygon& part : parts)
            for (Polygon& half : cut_along(*line, part)) finer.push_back(std::move(half));
        parts = std::move(finer);
    }
    return parts;
}

}  // namespace

double analytic_ellipse(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const TriangleGeometry& field,
                        std::optional<int> edge) {
    const EdgeSingularities singularities(field);
    const Vec middle = 0.5 * (p + q), half = 0.5 * (q - p);
    if (half.squaredNorm() == 0.0) return kInfinite;
    return ellipse_of(edge ? singularities.axis_of(*edge, middle, half) : singularities.axis(middle, half, kInfinite));
}

int gauss_points(double rho, double tolerance) {
    if (rho < 1.2) return 1000;
    return std::max(2, 1 + static_cast<int>(std::ceil((-std::log(tolerance) - 2.0) / (2.0 * std::log(rho)))));
}

void for_each_outer_cell(const TriangleGeometry& test, const TriangleGeometry& field, const OuterAccuracy& accuracy,
                         const std::function<void(const OuterPart&, const OuterCell&)>& visit) {
    const auto corner = [&](int i) { return Vec(Eigen::Map<const Vec>(test.corner[i])); };
    const EdgeSingularities singularities(field);
    for (const Polygon& polygon : parts_of({corner(0), corner(1), corner(2)}, field))
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            const Corners corners{polygon[0], polygon[i], polygon[i + 1]};
            const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
            if (area == 0.0) continue;
            const OuterPart part{corners[0], corners[1] - corners[0], corners[2] - corners[1], area};
            Cutter(corners, area / test.double_area, singularities, accuracy, [&](const OuterCell& cell) {
                visit(part, cell);
            }).cut({0.0, 1.0, 0.0, 1.0, 0, 0}, 0);
        }
}

}  // namespace elastolab
