#include "elasticity/far_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Core>
#include <random>

#include "elasticity/triangle_geometry.hpp"
#include "support/quadrature.hpp"

namespace elastolab {
namespace {

using Eigen::Vector3d;
using testing::Point;

/// int (e.n)/r^2 and int 1/r over the triangle, by a high Gauss product rule: exact to rounding far away.
std::array<long double, 2> truth(const std::array<Point, 3>& corners, const Vector3d& x, const Vector3d& n) {
    const auto function = [&](const Point& y, std::vector<long double>& out) {
        const long double d0 = y[0] - x[0], d1 = y[1] - x[1], d2 = y[2] - x[2];
        const long double r = std::sqrt(d0 * d0 + d1 * d1 + d2 * d2);
        out[0] = 1 / r;
        out[1] = (d0 * n[0] + d1 * n[1] + d2 * n[2]) / (r * r * r);
    };
    const auto values = testing::integrate(corners, 2, function, 1e-16L);
    return {values[0], values[1]};
}

double largest_error(double tolerance, double distance) {
    std::mt19937 random(23);
    std::normal_distribution<double> normal;
    const TriangleKernels& kernels = best_triangle_kernels();
    const FarField far_field(tolerance);
    double worst = 0.0;
    for (int trial = 0; trial < 20; ++trial) {
        std::array<Vector3d, 3> v;
        for (Vector3d& corner : v) corner = Vector3d(normal(random), normal(random), normal(random));
        const TriangleGeometry T = make_triangle_geometry(v[0], v[1], v[2], 0);
        const Vector3d n(T.n), away = Vector3d(normal(random), normal(random), normal(random)).normalized();
        if (T.double_area < 0.3 * T.longest_edge * T.longest_edge || std::fabs(away.dot(n)) < 0.3) continue;
        const Vector3d x = Vector3d(T.centroid) + distance * T.longest_edge * away;
        std::array<Point, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) corners[i] = {v[i][0], v[i][1], v[i][2]};
        SourceLanes lanes{};
        for (int i = 0; i < kMaxLanes; ++i)
            lanes.x[i] = x[0], lanes.y[i] = x[1], lanes.z[i] = x[2], lanes.own_triangle[i] = -1.0;
        std::array<double, 2 * kDoubleLayerNumbers * kMaxLanes> buffer{};
        double* const single[1] = {buffer.data()};
        double* const twofold[1] = {buffer.data() + kDoubleLayerNumbers * kMaxLanes};
        kernels.single_layer_constant(T, lanes, far_field.rule(distance), single);
        kernels.double_layer_constant(T, lanes, far_field.rule(distance), twofold);
        const auto exact = truth(corners, x, n);
        worst = std::max({worst, static_cast<double>(std::fabs(single[0][0] / exact[0] - 1)),
                          static_cast<double>(std::fabs(twofold[0][0] / exact[1] - 1))});
    }
    return worst;
}

TEST(FarField, KeepsTheStatedToleranceAtEveryDistance) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10})
        for (const double distance : {1.5, 3.0, 6.0, 10.0, 20.0, 30.0, 60.0, 150.0, 400.0})
            EXPECT_LT(largest_error(tolerance, distance), tolerance) << tolerance << " at " << distance;
}

TEST(FarField, UsesFewerPointsWhereMoreErrorIsAllowed) {
    EXPECT_EQ(FarField(1e-10).rule(2.0), nullptr);
    EXPECT_EQ(FarField(1e-3).rule(10.0), &gauss_rule_3());
    EXPECT_EQ(FarField(1e-8).rule(20.0), &gauss_rule_7());
    EXPECT_EQ(FarField(1e-10).rule(1e3), &gauss_rule_7());
}

TEST(GaussRules, IntegratePolynomialsOfTheirDegree) {
    const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
    for (const GaussRule* rule : {&gauss_rule_3(), &gauss_rule_7(), &gauss_rule_16()})
        for (int a = 0; a <= rule->degree; ++a)
            for (int b = 0; a + b <= rule->degree; ++b) {
                double sum = 0.0;
                for (int q = 0; q < rule->n_points; ++q) {
                    const auto& p = rule->points[static_cast<std::size_t>(q)];
                    sum += rule->weights[static_cast<std::size_t>(q)] * std::pow(p[0], a) * std::pow(p[1], b);
                }
                EXPECT_NEAR(sum, 2.0 * factorial(a) * factorial(b) / factorial(a + b + 2), 1e-14)
                    << rule->n_points << " points, degree " << a << " " << b;
            }
}

}  // namespace
}  // namespace elastolab
