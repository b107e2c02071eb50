#include "elasticity/pair_integrals.hpp"
#include "elasticity/triangle_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <functional>
#include <random>
#include <string>

#include "elasticity/outer_cells.hpp"
#include "elasticity/triangle_geometry.hpp"
#include "support/quadrature.hpp"

namespace elastolab {
namespace {

using Vec = Eigen::Vector3d;

struct Pair {
    const char* name;
    TriangleGeometry t, s;
};

TriangleGeometry triangle(const Vec& a, const Vec& b, const Vec& c) { return make_triangle_geometry(a, b, c, 0); }

const Vec kP(0, 0, 0), kQ(1, 0, 0), kR(0.3, 0.8, 0.1);

std::vector<Pair> pairs() {
    const TriangleGeometry t = triangle(kP, kQ, kR);
    return {{"common edge", t, triangle(kQ, kP, {0.4, -0.7, 0.4})},
            {"common edge, flat", triangle(kP, kQ, {0.3, 0.8, 0.0}), triangle(kQ, kP, {0.4, -0.7, 0.0})},
            {"common edge, sharp", t, triangle(kQ, kP, kR + Vec(0.05, 0.02, 0.1))},
            {"common vertex", t, triangle(kP, {-0.6, 0.3, 0.5}, {-0.5, -0.4, 0.2})},
            {"common vertex, sharp", t, triangle(kP, {1.0, 0.05, 0.05}, {0.3, -0.8, 0.1})},
            {"apart", t, triangle({2, 0, 0}, {2.5, 1, 0}, {2, 0.5, 1})},
            {"thin wall", t, triangle(kP + Vec(0.1, 0.1, -0.1), kQ + Vec(0, 0.1, -0.15), kR + Vec(0, 0, -0.1))},
            {"thin triangles, common edge", triangle(kP, kQ, {0.3, 0.05, 0}), triangle(kQ, kP, {0.5, -0.02, 0.02})},
            {"thin triangles, common vertex", triangle(kP, kQ, {0.3, 0.05, 0}),
             triangle(kP, {-0.5, -0.02, 0.02}, {-0.9, 0.01, 0})}};
}

/// The outer integral by adaptive quadrature; the inner closed form has its own tests.
PairNumbers by_adaptive_quadrature(const TriangleGeometry& t, const TriangleGeometry& s, long double tolerance) {
    const TriangleKernels& kernels = plain_triangle_kernels();
    std::array<testing::Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) corners[i][k] = t.corner[i][k];
    const auto values = testing::integrate(
        corners, kPairNumbers,
        [&](const testing::Point& x, std::vector<long double>& out) {
            SourceLanes source{};
            source.x[0] = static_cast<double>(x[0]), source.y[0] = static_cast<double>(x[1]);
            source.z[0] = static_cast<double>(x[2]);
            source.own_triangle[0] = -1.0;
            double single[kSingleLayerNumbers] = {}, normal[3][kDoubleLayerNumbers] = {};
            double* const single_out[1] = {single};
            double* const normal_out[3] = {normal[0], normal[1], normal[2]};
            kernels.single_layer_constant(s, source, nullptr, single_out);
            kernels.double_layer_linear(s, source, nullptr, normal_out);
            for (std::size_t k = 0; k < 6; ++k) out[k] = single[1 + k];
            for (std::size_t k = 0; k < 3; ++k) out[6 + k] = normal[k][0];
        },
        tolerance);
    PairNumbers numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<double>(values[k]);
    return numbers;
}

/// Largest difference of the tensor numbers and of the normal numbers, each relative to its largest number.
double difference(const PairNumbers& a, const PairNumbers& b) {
    double worst = 0.0;
    for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 6}, {6, 9}}) {
        double error = 0.0, size = 1e-12;  // of unit triangles: below it a number is zero
        for (std::size_t k = from; k < to; ++k) {
            error = std::max(error, std::abs(a[k] - b[k]));
            size = std::max(size, std::abs(b[k]));
        }
        worst = std::max(worst, error / (size > 1e-10 ? size : 1.0));
    }
    return worst;
}

double mean_power(int i, int j) {  // of b1^i b2^j over a triangle
    return 2.0 * std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3);
}

TEST(PairRules, IntegrateEveryPolynomialOfTheirTotalDegree) {
    for (const PairRule* rule : {&pair_rule_5(), &pair_rule_7(), &pair_rule_9(), &pair_rule_11()})
        for (int a = 0; a <= rule->degree; ++a)
            for (int b = 0; a + b <= rule->degree; ++b)
                for (int c = 0; a + b + c <= rule->degree; ++c)
                    for (int d = 0; a + b + c + d <= rule->degree; ++d) {
                        double sum = 0.0;
                        for (const PairRuleTerm& term : rule->terms)
                            for (int i = term.first_x; i < term.first_x + term.n_x; ++i)
                                for (int j = term.first_y; j < term.first_y + term.n_y; ++j) {
                                    const auto& x = rule->points[static_cast<std::size_t>(i)];
                                    const auto& y = rule->points[static_cast<std::size_t>(j)];
                                    sum += term.weight * std::pow(x[1], a) * std::pow(x[2], b) * std::pow(y[1], c) *
                                           std::pow(y[2], d);
                                }
                        EXPECT_NEAR(sum, mean_power(a, b) * mean_power(c, d), 1e-14) << rule->degree;
                    }
}

TEST(TriangleRules, IntegrateEveryPolynomialOfTheirDegree) {
    for (int n = 2; n <= 12; ++n) {
        const TriangleRule& rule = triangle_rule(n);
        EXPECT_LE(std::ssize(rule.points), n * n);
        for (int a = 0; a <= 2 * n - 2; ++a)
            for (int b = 0; a + b <= 2 * n - 2; ++b) {
                double sum = 0.0;
                for (std::size_t i = 0; i < rule.points.size(); ++i) {
                    for (const double coordinate : rule.points[i]) EXPECT_GT(coordinate, 0.0);
                    sum += rule.weights[i] * std::pow(rule.points[i][1], a) * std::pow(rule.points[i][2], b);
                }
                EXPECT_NEAR(sum, mean_power(a, b), 1e-15 + 1e-13 * mean_power(a, b)) << n << " " << a << " " << b;
            }
    }
}

TEST(PairIntegrals, AgreeWithAdaptiveQuadrature) {
    for (const Pair& pair : pairs()) {
        const PairNumbers truth = by_adaptive_quadrature(pair.t, pair.s, 1e-10L);
        EXPECT_LT(difference(close_pair(pair.t, pair.s, true, 1e-8), truth), 1e-8) << pair.name;
    }
}

TEST(PairIntegrals, OfATriangleWithItselfAgreeWithAdaptiveQuadrature) {
    const TriangleGeometry t = triangle(kP, kQ, kR);
    const PairNumbers truth = by_adaptive_quadrature(t, t, 1e-9L), numbers = close_pair(t, t, false, 1e-8);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(numbers[k], truth[k], 1e-8 * truth[0]);
}

/// A triangle cut in two: identical pairs, which are closed forms, and the pair with a common edge check each other.
TEST(PairIntegrals, AreTheSumOfThoseOfTheParts) {
    for (const Vec& apex : {kR, Vec(0.4, 0.02, 0.0), Vec(-0.7, 0.3, 0.2)}) {
        const TriangleGeometry whole = triangle(kP, kQ, apex);
        const Vec middle = 0.4 * kP + 0.6 * kQ;
        const TriangleGeometry parts[2] = {triangle(kP, middle, apex), triangle(middle, kQ, apex)};
        PairNumbers sum{};
        for (const TriangleGeometry& a : parts)
            for (const TriangleGeometry& b : parts) {
                const PairNumbers part = close_pair(a, b, false, 1e-11);
                for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part[k];
            }
        EXPECT_LT(difference(sum, close_pair(whole, whole, false, 1e-11)), 1e-11) << apex.transpose();
    }
}

TEST(PairIntegrals, KeepATightTolerance) {
    for (const Pair& pair : pairs()) {
        const PairNumbers loose = close_pair(pair.t, pair.s, true, 1e-11),
                          tight = close_pair(pair.t, pair.s, true, 1e-15);
        EXPECT_LT(difference(loose, tight), 1e-11) << pair.name;
        const PairNumbers exchanged = close_pair(pair.s, pair.t, false, 1e-11);
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_NEAR(exchanged[k], tight[k], 1e-11 * (tight[0] + tight[1] + tight[2]));
    }
}

/// Two triangles over one another, nearly touching, as on both sides of a plate: edges over edges, and across them, and
/// one that leans over the other.
std::vector<Pair> over_one_another(double gap) {
    const Vec up(0.0, 0.0, gap), aside(0.21, 0.13, 0.0), p(kP), q(kQ), r(0.3, 0.8, 0.0);
    return {{"edges over edges", triangle(p, q, r), triangle(p + up, r + up, q + up)},
            {"beside one another", triangle(p, q, r), triangle(q + up, p + up, p + q - r + up)},
            {"edges across edges", triangle(p, q, r), triangle(p + aside + up, r + aside + up, q + aside + up)},
            {"across a thin triangle", triangle(p, q, {0.5, 0.02, 0.0}), triangle(p + up, r + up, q + aside + up)},
            {"leaning", triangle(p, q, r), triangle(p + aside + up, Vec(0.2, 0.7, 0.3) + up, Vec(0.9, 0.3, 0.1) + up)}};
}

TEST(PairIntegrals, OfTrianglesOverOneAnotherAreTheSumOfThoseOfTheParts) {
    for (const double gap : {0.1, 0.003, 1e-4, 1e-6, 1e-8})
        for (const Pair& pair : over_one_another(gap)) {
            const PairNumbers whole = close_pair(pair.t, pair.s, true, 1e-8);
            PairNumbers sum{};
            const auto at = [&](int i) { return Vec(Eigen::Map<const Vec>(pair.t.corner[i])); };
            const Vec inside = 0.2 * at(0) + 0.3 * at(1) + 0.5 * at(2);
            for (int i = 0; i < 3; ++i) {
                const PairNumbers part = close_pair(triangle(at(i), at((i + 1) % 3), inside), pair.s, true, 1e-10);
                for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part[k];
            }
            // Beside one another the normal numbers nearly cancel: they are relative to the area.
            for (std::size_t k = 0; k < sum.size(); ++k)
                EXPECT_NEAR(sum[k], whole[k], 1e-8 * (k < 6 ? whole[0] + whole[1] + whole[2] : pair.t.double_area))
                    << pair.name << ", gap " << gap << ", number " << k;
            // The other triangle's closed form, and this one's quadrature.
            const PairNumbers exchanged = close_pair(pair.s, pair.t, false, 1e-8),
                              alone = close_pair(pair.t, pair.s, false, 1e-8);
            for (std::size_t k = 0; k < 6; ++k) {
                EXPECT_NEAR(exchanged[k], whole[k], 2e-8 * (whole[0] + whole[1] + whole[2])) << pair.name;
                EXPECT_NEAR(alone[k], whole[k], 2e-8 * (whole[0] + whole[1] + whole[2])) << pair.name;
            }
        }
}

/// int over a-b of g ds, seen from x in the plane, with g(rho) = R - z log(R + z), R^2 = rho^2 + z^2, whose Laplacian
/// in the plane is 1/R.
double edge_potential(const Vec& x, const Vec& a, const Vec& b, double z) {
    const Vec tangent = (b - a).normalized();
    const double h = (a - x).cross(tangent).norm();
    const auto primitive = [&](double s) {
        const double R = std::sqrt(s * s + h * h + z * z),
                     log_s = std::copysign(std::asinh(std::abs(s) / std::hypot(h, z)), s);
        const double angles = h > 0.0 ? h * (std::atan(s / h) - std::atan(s * z / (h * R))) : 0.0;
        return 0.5 * (s * R + (h * h + z * z) * log_s) - z * (s * std::log(R + z) + z * log_s - s + angles);
    };
    return primitive((b - x).dot(tangent)) - primitive((a - x).dot(tangent));
}

double adaptive(const std::function<double(double)>& f, double from, double to, double tolerance, int depth = 0) {
    const auto gauss = [&](double a, double b) {
        const LineRule& rule = legendre_rule(10);
        double sum = 0.0;
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) sum += rule.weights[q] * f(a + (b - a) * rule.nodes[q]);
        return sum * (b - a);
    };
    const double middle = 0.5 * (from + to), halves = gauss(from, middle) + gauss(middle, to);
    if (depth == 40 || std::abs(halves - gauss(from, to)) < tolerance) return halves;
    return adaptive(f, from, middle, tolerance, depth + 1) + adaptive(f, middle, to, tolerance, depth + 1);
}

/// iint 1/r of parallel triangles z apart: two line integrals, by the divergence theorem in each plane.
double inverse_distance(const TriangleGeometry& t, const TriangleGeometry& s, double z) {
    const auto corner = [](const TriangleGeometry& T, int i) {
        return Vec(T.corner[i % 3][0], T.corner[i % 3][1], 0.0);
    };
    const auto outward = [&](const TriangleGeometry& T, int i) {
        const Vec normal(0.0, 0.0, T.n[2]);
        return Vec((corner(T, i + 1) - corner(T, i)).cross(normal).normalized());
    };
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const Vec a = corner(t, i), ab = corner(t, i + 1) - a;
            const auto potential = [&](double u) {
                return edge_potential(a + u * ab, corner(s, j), corner(s, j + 1), z);
            };
            sum -= outward(t, i).dot(outward(s, j)) * ab.norm() * adaptive(potential, 0.0, 1.0, 1e-12);
        }
    return sum;
}

TEST(PairIntegrals, OfParallelTrianglesAreThoseOfTheDivergenceTheorem) {
    for (const double gap : {0.1, 0.003, 1e-5, 1e-6, 1e-8})
        for (const Pair& pair : over_one_another(gap)) {
            if (std::abs(pair.t.n[2] * pair.s.n[2]) < 1.0) continue;
            const double truth = inverse_distance(pair.t, pair.s, gap);
            for (const bool all : {false, true}) {
                const PairNumbers numbers = close_pair(pair.t, pair.s, all, 1e-8);
                EXPECT_NEAR(numbers[0] + numbers[1] + numbers[2], truth, 1e-8 * truth) << pair.name << ", gap " << gap;
            }
        }
}

int n_outer_points(const TriangleGeometry& t, const TriangleGeometry& s, bool is_continuous) {
    int n = 0;
    for_each_outer_cell(t, s, {1e-8, is_continuous, 8},
                        [&](const OuterPart&, const OuterCell& cell) { n += cell.n_u * cell.n_v; });
    return n;
}

/// Plates a million times thinner cost some ten times more, however their edges cross, and no more from where on less
/// counts than the tolerance.
TEST(PairIntegrals, OfTrianglesOverOneAnotherTakeFewPoints) {
    for (const bool is_continuous : {true, false})
        for (std::size_t i = 0; i < over_one_another(0.1).size(); ++i) {
            std::vector<int> n;
            for (const double gap : {1e-1, 1e-2, 1e-4, 1e-6, 1e-8}) {
                const Pair pair = over_one_another(gap)[i];
                n.push_back(n_outer_points(pair.t, pair.s, is_continuous));
            }
            const std::string what =
                std::string(over_one_another(0.1)[i].name) + (is_continuous ? "" : ", double layer");
            EXPECT_LT(n[0], 2000) << what;
            EXPECT_LT(n[2], 20000) << what;
            EXPECT_LT(n[4], is_continuous ? 20000 : 40000) << what;
        }
}

/// Packs at all distances, so that every far rule and the medium range are met.
TEST(PairIntegrals, OfPacksKeepTheTolerance) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto vec = [&] { return Vec(unit(random), unit(random), unit(random)); };
    for (const double tolerance : {1e-6, 1e-8, 1e-11})
        for (const double distance : {2.0, 3.0, 4.0, 6.0, 9.0, 14.0, 40.0}) {
            std::vector<TriangleGeometry> triangles;
            for (int i = 0; i < kMaxLanes; ++i) {
                const Vec at = 0.3 * vec();
                triangles.push_back(
                    triangle(at + Vec(0.6, 0, 0.1 * unit(random)), at + Vec(-0.3, 0.5, 0), at + Vec(-0.3, -0.5, 0)));
            }
            const Vec at = distance * vec().normalized();
            triangles.push_back(triangle(at + Vec(0, 0.5, 0.1), at + Vec(0, -0.4, 0.4), at + Vec(0.2, -0.3, -0.5)));
            const PairIntegrals integrals(triangles, tolerance);
            std::vector<int> tests(static_cast<std::size_t>(integrals.lanes()));
            for (std::size_t i = 0; i < tests.size(); ++i) tests[i] = static_cast<int>(i);
            double out[kPairNumbers * kMaxLanes];
            integrals.integrate(integrals.pack(tests), kMaxLanes, true, out);
            for (std::size_t lane = 0; lane < tests.size(); ++lane) {
                const PairNumbers truth = close_pair(triangles[lane], triangles.back(), true, 1e-14);
                PairNumbers numbers;
                for (std::size_t k = 0; k < numbers.size(); ++k)
                    numbers[k] = out[k * static_cast<std::size_t>(integrals.lanes()) + lane];
                double error = 0.0, size = 0.0;
                for (std::size_t k = 0; k < 6; ++k)
                    error = std::max(error, std::abs(numbers[k] - truth[k])), size = std::max(size, truth[k]);
                EXPECT_LT(error, tolerance * size) << distance;
            }
        }
}

}  // namespace
}  // namespace elastolab
