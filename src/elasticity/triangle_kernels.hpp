#pragma once

#include "elasticity/gauss_rules.hpp"

// Plain arrays only: this header is also read by sources compiled for particular instruction sets.

namespace elastolab {

/// One flat triangle, in the frame (e1, e2, n) with e1 along its first edge.
template <class Real>
struct BasicTriangleGeometry {
    Real corner[3][3];  ///< corners, counter-clockwise seen from outside [L]
    Real centroid[3];   ///< [L]
    Real e1[3], e2[3];  ///< unit vectors in the plane
    Real n[3];          ///< outward unit normal
    Real tx[3], ty[3];  ///< unit tangents of the edges corner i -> i + 1, in the frame
    Real length[3];     ///< of the edges [L]
    Real gx[3], gy[3];  ///< gradients of the three linear shape functions, in the frame [1/L]
    Real double_area;   ///< [L^2]
    Real longest_edge;  ///< [L]
    int index;          ///< number of the triangle
};
using TriangleGeometry = BasicTriangleGeometry<double>;

/// Altitude over longest edge below which a triangle is a sliver: cancellation in its closed forms multiplies rounding
/// errors by (edge / altitude)^2, so that the kernels evaluate them in extended precision (see sliver_kernels.hpp).
constexpr double kSliverAltitude = 0.01;

/// The same for the potential, which has no product of a hat and a tensor: at this altitude its normals lose 3e-9 at
/// worst, next to the triangle, and 1e-13 on the average; its tensor 1.5e-11 at worst.
constexpr double kSliverAltitudeOfPotential = 2e-3;

/// Largest number of sources in one kernel call.
constexpr int kMaxLanes = 8;

/// Source (collocation) points as a structure of arrays. A kernel reads the first `lanes` entries; fewer points are
/// padded by repeating one.
struct SourceLanes {
    double x[kMaxLanes], y[kMaxLanes], z[kMaxLanes];
    double own_triangle[kMaxLanes];  ///< index of the triangle in whose interior the point lies, -1 for none
};

/// How many numbers store a 3 x 3 block of either layer, free of any material constant:
///   single layer, 7:   s, Sxx Syy Szz Sxy Sxz Syz           int phi U = [(3-4nu) s I + S] / (16 pi mu (1-nu))
///   double layer, 10:  a, cx cy cz, Sxx Syy Szz Sxy Sxz Syz
///                      int phi T = -[(1-2nu) (a I - [c]) + S] / (8 pi (1-nu)),   [c]_ij = eps_ijk c_k
/// with s = int phi/r, S = int phi e e^T / r (single) or 3 int phi (e.n) e e^T / r^2 (double),
/// a = int phi (e.n)/r^2, c = int phi (e x n)/r^2.
constexpr int kSingleLayerNumbers = 7;
constexpr int kDoubleLayerNumbers = 10;

/// What is wanted of the potential of a triangle, as pairs of triangles need it; e = (y - x) / r, n the normal:
///   tensor         xx yy zz xy xz yz of int e e^T / r           [L]
///   with_normals   then int phi_k (e . n) / r^2, k = 0, 1, 2    [1]
///   with_gradient  then instead int e / r^2, x y z              [1]
enum class Potential { tensor, with_normals, with_gradient };
constexpr int kPotentialTensorNumbers = 6, kPotentialNumbers = 9;

/// Integrals of Kelvin's kernels times shape functions over one triangle, for several sources at once.
/// Every function ADDS its result to out[k]: numbers x lanes doubles for shape function k (the lane runs fastest).
/// rule == nullptr: closed form; else that Gauss rule, for sources far away.
/// A source may be a corner of the triangle (exactly equal coordinates) or lie in its interior (own_triangle): then
/// the finite part is added, from which the free term follows by the rigid-body sum.
struct TriangleKernels {
    const char* name;  ///< instruction set
    int lanes;
    void (*single_layer_linear)(const TriangleGeometry&, const SourceLanes&, const GaussRule* rule,
                                double* const out[3]);
    void (*single_layer_constant)(const TriangleGeometry&, const SourceLanes&, const GaussRule* rule,
                                  double* const out[1]);
    void (*double_layer_linear)(const TriangleGeometry&, const SourceLanes&, const GaussRule* rule,
                                double* const out[3]);
    void (*double_layer_constant)(const TriangleGeometry&, const SourceLanes&, const GaussRule* rule,
                                  double* const out[1]);
    /// In closed form: 6 or 9 numbers x lanes.
    void (*potential)(const TriangleGeometry&, const SourceLanes&, Potential wanted, double* out);
};

/// The widest kernels that this CPU can run: AVX-512 (8 lanes), AVX2 (4), or plain (1).
const TriangleKernels& best_triangle_kernels();
/// One lane, without special instructions.
const TriangleKernels& plain_triangle_kernels();

}  // namespace elastolab
