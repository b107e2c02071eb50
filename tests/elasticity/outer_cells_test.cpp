#include "elasticity/outer_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <Eigen/Geometry>
#include <random>

#include "elasticity/triangle_geometry.hpp"

namespace elastolab {
namespace {

using Vec = Eigen::Vector3d;
using Complex = std::complex<double>;

Vec random_point(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    return {uniform(random), uniform(random), uniform(random)};
}

TriangleGeometry geometry_of(const Vec& a, const Vec& b, const Vec& c) { return make_triangle_geometry(a, b, c, 0); }

/// Long semi-axis of the ellipse with foci -1 and 1 through a root z of |w + z h|^2 = 0.
double axis_through(const Vec& w, const Vec& h, Complex& z) {
    const Complex half = w.dot(h) / h.squaredNorm();
    z = -half + std::sqrt(half * half - Complex(w.squaredNorm() / h.squaredNorm()));
    return 0.5 * (std::abs(z - 1.0) + std::abs(z + 1.0));
}

/// By its definition: the smallest over the corners, and over the lines of the edges between their ends.
double ellipse_by_roots(const Vec& p, const Vec& q, const std::array<Vec, 3>& corners) {
    const Vec m = 0.5 * (p + q), h = 0.5 * (q - p);
    double axis = 1e300;
    for (std::size_t i = 0; i < 3; ++i) {
        Complex z;
        const Vec edge = corners[(i + 1) % 3] - corners[i], along = edge.normalized(), w = m - corners[i];
        axis = std::min(axis, axis_through(w, h, z));
        const double beside = axis_through(w - w.dot(along) * along, h - h.dot(along) * along, z);
        const double projection = w.dot(along) + z.real() * h.dot(along);
        if (projection >= 0.0 && projection <= edge.norm()) axis = std::min(axis, beside);
    }
    return axis + std::sqrt(std::max(0.0, axis * axis - 1.0));
}

TEST(OuterCells, TheEllipseReachesTheNearestSingularity) {
    std::mt19937 random(5);
    for (int k = 0; k < 2000; ++k) {
        const std::array<Vec, 3> corners = {random_point(random), random_point(random), random_point(random)};
        const Vec p = random_point(random), q = p + std::pow(10.0, -(k % 4)) * random_point(random);
        const double exact = ellipse_by_roots(p, q, corners);
        const double found = analytic_ellipse(p, q, geometry_of(corners[0], corners[1], corners[2]));
        EXPECT_NEAR(found, exact, 1e-6 * exact) << "chord " << k;
    }
}

TEST(OuterCells, OfOneEdgeTheOthersDoNotCount) {
    const Vec a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), p(-0.1, 0.5, 0.1), q(-0.2, 0.5, 0.1);
    const TriangleGeometry T = geometry_of(a, b, c);
    EXPECT_LT(analytic_ellipse(p, q, T, 2), 0.5 * analytic_ellipse(p, q, T, 0));
    EXPECT_EQ(analytic_ellipse(p, q, T, 2), analytic_ellipse(p, q, T));
    EXPECT_GT(analytic_ellipse(p, p, T), 1e200);
}

TEST(OuterCells, CellsCoverTheTestTriangle) {
    const TriangleGeometry test = geometry_of({0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0});
    for (const double gap : {1.0, 1e-2, 1e-5, 1e-8}) {
        const TriangleGeometry field = geometry_of({0.3, -0.4, gap}, {1.1, 0.6, gap}, {-0.2, 0.5, gap});
        double area = 0.0;
        for_each_outer_cell(test, field, {1e-8, true, 12}, [&](const OuterPart& part, const OuterCell& cell) {
            EXPECT_LE(std::max(cell.n_u, cell.n_v), 12);
            area += 0.5 * part.double_area * (cell.u1 * cell.u1 - cell.u0 * cell.u0) * (cell.v1 - cell.v0);
        });
        EXPECT_NEAR(area, 0.5 * test.double_area, 1e-12) << "gap " << gap;
    }
}

}  // namespace
}  // namespace elastolab
