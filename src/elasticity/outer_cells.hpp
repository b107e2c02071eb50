#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "elasticity/triangle_kernels.hpp"

namespace elastolab {

/// A triangular part of a test triangle: x(u, v) = a + u (ab + v bc), 0 <= u, v <= 1, dx = double_area u du dv.
struct OuterPart {
    Eigen::Vector3d a, ab, bc;
    double double_area;
};

/// A cell of a part, with the points that a product of two Gauss-Legendre rules needs there.
struct OuterCell {
    double u0, u1, v0, v1;
    int n_u, n_v;
};

/// tolerance: relative, of the whole integral. is_continuous: whether the potential is continuous across the edges of
/// `field` (single layers are, double layers jump). max_points: in each direction of a cell.
struct OuterAccuracy {
    double tolerance;
    bool is_continuous;
    int max_points;
};

/// The parameter rho > 1 of the largest Bernstein ellipse around [p, q], in the complex line through both, in which a
/// closed form over `field` is analytic: its singularities are the edges, or the one edge from corner `edge` to the
/// next. Infinite for p = q.
double analytic_ellipse(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const TriangleGeometry& field,
                        std::optional<int> edge = {});

/// Number n of Gauss-Legendre points that keep `tolerance` for an integrand of size 1 that is analytic in the ellipse
/// rho: their error is like rho^(-2n). Where n is large, the cell had better be cut.
int gauss_points(double rho, double tolerance);

/// Cuts `test` into cells on which a potential of `field`, which it must not touch, is integrated to `tolerance` by few
/// points. Where edges of `field` lie close over the test triangle, it is first cut along them, so that singularities
/// lie along edges of its parts. Each direction of a part is cut, and its points are counted, by itself: beside an edge
/// cells are thin across it and long along it, and grow with the distance from it. Two triangles a distance d apart
/// need log(1/d)^2 cells, however their edges lie, and no more than log(1/tolerance)^2.
void for_each_outer_cell(const TriangleGeometry& test, const TriangleGeometry& field, const OuterAccuracy& accuracy,
                         const std::function<void(const OuterPart&, const OuterCell&)>& visit);

}  // namespace elastolab
