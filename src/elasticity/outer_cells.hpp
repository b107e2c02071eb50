#pragma once

#include <functional>

#include "elasticity/triangle_kernels.hpp"

namespace elastolab {

/// A part of a triangle a, b, c in the coordinates x(u, v) = a + u (b - a + v (c - b)), 0 <= u, v <= 1, with the points
/// that a product of two Gauss-Legendre rules needs there. dx = double_area u du dv.
struct OuterCell {
    double u0, u1, v0, v1;
    int n_u, n_v;
};

/// The parameter rho > 1 of the largest Bernstein ellipse around [p, q], in the complex line through both, in which a
/// closed form over `field` is analytic: its singularities are the edges. Infinite for p = q. p, q: 3 coordinates.
double analytic_ellipse(const double* p, const double* q, const TriangleGeometry& field);

/// The same where `edge`, from corner `edge` to the next, is the only one that counts.
double analytic_ellipse(const double* p, const double* q, const TriangleGeometry& field, int edge);

/// Number n of Gauss-Legendre points that keep `tolerance` for an integrand of size 1 that is analytic in the ellipse
/// rho: their error is like rho^(-2n). Where n is large, the cell had better be cut.
int gauss_points(double rho, double tolerance);

/// Cuts `test` into cells on which a potential of `field`, which it must not touch, is integrated to `tolerance` of its
/// whole integral by at most max_points in each direction. Each direction is cut, and its points are counted, by
/// itself: beside an edge of `field` cells are thin across it and long along it, so that two triangles a distance d
/// apart need log(1/d) of them where edges lie along edges, and 1/d at worst.
void for_each_outer_cell(const TriangleGeometry& test, const TriangleGeometry& field, double tolerance, int max_points,
                         const std::function<void(const OuterCell&)>& visit);

}  // namespace elastolab
