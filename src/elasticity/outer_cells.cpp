#include "elasticity/outer_cells.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace elastolab {

namespace {

using Vec = Eigen::Vector3d;

constexpr double kInfinite = 1e300;
/// Enough for edges above edges at 1e-6 of their length; ends the recursion where triangles cross one another.
constexpr int kMaxCuts = 28;

/// The long semi-axis of the ellipse with foci -1 and 1 through the zeros of |w + z h|^2: half the sum of their
/// distances from the foci.
double axis_through_zeros(double ww, double wh, double hh) {
    const double real = -wh / hh, imaginary2 = std::max(0.0, ww / hh - real * real);
    const double left = real + 1.0, right = real - 1.0;
    return 0.5 * (std::sqrt(left * left + imaginary2) + std::sqrt(right * right + imaginary2));
}

/// Long semi-axis of the largest ellipse for the chord m + z h, -1 <= z <= 1. Its singularities are the zeros of the
/// distance from either end, and those of the distance from the line through both ends that project between them.
double axis_beside_edge(const Vec& m, const Vec& h, const Vec& begin, const Vec& end) {
    const Vec w = m - begin, edge = end - begin;
    const double hh = h.squaredNorm(), length = edge.norm();
    const double axis = std::min(axis_through_zeros(w.squaredNorm(), w.dot(h), hh),
                                 axis_through_zeros((m - end).squaredNorm(), (m - end).dot(h), hh));
    const Vec t = edge / length;
    const Vec w_across = w - w.dot(t) * t, h_across = h - h.dot(t) * t;
    const double across = h_across.squaredNorm();
    if (across < 1e-24 * hh) return axis;
    const double nearest = (w - w_across.dot(h_across) / across * h).dot(t);
    if (nearest < 0.0 || nearest > length) return axis;
    return std::min(axis, axis_through_zeros(w_across.squaredNorm(), w_across.dot(h_across), across));
}

double axis_beside_edge(const double* p, const double* q, const TriangleGeometry& field, int edge) {
    const Eigen::Map<const Vec> from(p), to(q), begin(field.corner[edge]), end(field.corner[(edge + 1) % 3]);
    const Vec half = 0.5 * (to - from);
    return half.squaredNorm() == 0.0 ? kInfinite : axis_beside_edge(0.5 * (from + to), half, begin, end);
}

/// The parameter rho, which is the sum of both semi-axes, from the long one.
double ellipse_of(double axis) { return axis < kInfinite ? axis + std::sqrt(axis * axis - 1.0) : kInfinite; }

class Cutter {
public:
    Cutter(const TriangleGeometry& test, const TriangleGeometry& field, double tolerance, int max_points,
           const std::function<void(const OuterCell&)>& visit)
        : test_(test), field_(field), tolerance_(tolerance), max_points_(max_points), visit_(visit) {}

    void cut(OuterCell cell, int n_cuts) const {
        const double u = 0.5 * (cell.u0 + cell.u1), v = 0.5 * (cell.v0 + cell.v1);
        double rho_u = kInfinite, rho_v = kInfinite;
        for (const double at : {cell.v0, v, cell.v1}) rho_u = std::min(rho_u, chord(cell.u0, at, cell.u1, at));
        for (const double at : {cell.u0, u, cell.u1}) rho_v = std::min(rho_v, chord(at, cell.v0, at, cell.v1));
        // Small cells may be less exact: those of one size lie side by side along a line, so that there are few of
        // them.
        const double share = (cell.u1 * cell.u1 - cell.u0 * cell.u0) * (cell.v1 - cell.v0);
        const double tolerance = std::min(0.1, tolerance_ / std::sqrt(share));
        cell.n_u = gauss_points(rho_u, tolerance);
        cell.n_v = gauss_points(rho_v, tolerance);
        if (std::max(cell.n_u, cell.n_v) <= max_points_ || n_cuts == kMaxCuts) {
            cell.n_u = std::min(cell.n_u, max_points_);
            cell.n_v = std::min(cell.n_v, max_points_);
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
    double chord(double u0, double v0, double u1, double v1) const {
        double p[3], q[3];
        for (int i = 0; i < 3; ++i) {
            const double a = test_.corner[0][i], b = test_.corner[1][i], c = test_.corner[2][i];
            p[i] = a + u0 * (b - a + v0 * (c - b));
            q[i] = a + u1 * (b - a + v1 * (c - b));
        }
        return analytic_ellipse(p, q, field_);
    }

    const TriangleGeometry& test_;
    const TriangleGeometry& field_;
    double tolerance_;
    int max_points_;
    const std::function<void(const OuterCell&)>& visit_;
};

}  // namespace

double analytic_ellipse(const double* p, const double* q, const TriangleGeometry& field, int edge) {
    return ellipse_of(axis_beside_edge(p, q, field, edge));
}

double analytic_ellipse(const double* p, const double* q, const TriangleGeometry& field) {
    double axis = kInfinite;
    for (int edge = 0; edge < 3; ++edge) axis = std::min(axis, axis_beside_edge(p, q, field, edge));
    return ellipse_of(axis);
}

int gauss_points(double rho, double tolerance) {
    if (rho < 1.2) return 1000;
    return std::max(2, 1 + static_cast<int>(std::ceil((-std::log(tolerance) - 2.0) / (2.0 * std::log(rho)))));
}

void for_each_outer_cell(const TriangleGeometry& test, const TriangleGeometry& field, double tolerance, int max_points,
                         const std::function<void(const OuterCell&)>& visit) {
    Cutter(test, field, tolerance, max_points, visit).cut({0.0, 1.0, 0.0, 1.0, 0, 0}, 0);
}

}  // namespace elastolab
