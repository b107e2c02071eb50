#pragma once

#include <array>

#include "elasticity/pair_kernels.hpp"
#include "elasticity/triangle_kernels.hpp"

namespace elastolab {

/// The material-free integrals of one pair of flat triangles, x over the test triangle t and y over the field triangle
/// s, with r = |y - x|, e = (y - x) / r, n the field triangle's normal and phi_k its hats:
///   tensor  xx yy zz xy xz yz of  iint e e^T / r        [L^3], symmetric in the pair; iint 1/r is its trace
///   normal  iint phi_k(y) (e . n) / r^2                 [L^2], k = 0, 1, 2; zero for coplanar triangles
/// Kelvin's iint U = [(3-4nu) trace I + tensor] / (16 pi mu (1-nu)).
using PairNumbers = std::array<double, kPairNumbers>;

/// Points per direction that the outer rule needs to keep `tolerance` on a test triangle of radius R whose centre is
/// `ratio` * R away from the nearest edge of the field triangle. Pairs that need more than max_outer_points are left to
/// close_pair.
int outer_points(double ratio, double tolerance);
int max_outer_points(double tolerance);

/// That ratio: distance of the test triangle's centre from the nearest edge of the field triangle over its radius.
double outer_ratio(const double (&test_corners)[3][3], const TriangleGeometry& field);

/// The integrals of any two triangles that do not intersect: apart, or with one, two or three corners in common
/// (recognised by equal coordinates). `all` false: the normal numbers stay zero.
///
/// Apart, the inner integral is the closed form and the outer one a Gauss rule on each cell of the test triangle
/// (for_each_outer_cell), off the field triangle's edges, where the closed form is analytic.
/// With a corner P in common, both planes hold P and the kernels k are homogeneous about it (degree -1, or -2 for the
/// normal numbers without a hat). Euler's identity and the divergence theorem in the four coordinates then leave
///   iint k = 1/(4 + degree) [ h_t int_{edge of t opposite P} dx int_s k + h_s int_{edge of s opposite P} dy int_t k ]
/// with h the distances of P from the two edges: line integrals of closed forms, evaluated by Gauss rules graded where
/// an edge begins at a corner of the other triangle. For one and the same triangle the identity is used three times and
/// nothing is left to quadrature. Sources: Sauter and Schwab, Boundary Element Methods (2011), chapter 5, for the
/// singularities; Lenoir and Salles (2012) for the reduction by homogeneity.
PairNumbers close_pair(const TriangleGeometry& test, const TriangleGeometry& field, bool all, double tolerance);

}  // namespace elastolab
