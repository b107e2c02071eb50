#include "elasticity/triangle_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <functional>
#include <random>

#include "elasticity/triangle_geometry.hpp"
#include "support/quadrature.hpp"

namespace elastolab {
namespace {

using Eigen::Vector3d;
using testing::Point;
using Values = std::vector<long double>;

enum class Layer { single, twofold };

int numbers_of(Layer layer) { return layer == Layer::single ? kSingleLayerNumbers : kDoubleLayerNumbers; }

struct Corners {
    Vector3d a, b, c;
    TriangleGeometry geometry() const { return make_triangle_geometry(a, b, c, 0); }
};

Point as_point(const Vector3d& v) { return {v[0], v[1], v[2]}; }

/// The definitions of triangle_kernels.hpp at one point y, times one shape function (or 1 for shape < 0).
class Integrand {
public:
    Integrand(const Corners& corners, const Vector3d& x, Layer layer, int shape)
        : x_(as_point(x)), layer_(layer), shape_(shape) {
        const Point a = as_point(corners.a), b = as_point(corners.b), c = as_point(corners.c);
        for (int i = 0; i < 3; ++i) u_[i] = b[i] - a[i], v_[i] = c[i] - a[i], origin_[i] = a[i];
        n_ = {u_[1] * v_[2] - u_[2] * v_[1], u_[2] * v_[0] - u_[0] * v_[2], u_[0] * v_[1] - u_[1] * v_[0]};
        const long double length = std::sqrt(dot(n_, n_));
        for (long double& component : n_) component /= length;
    }

    void operator()(const Point& y, Values& out) const {
        Point d;
        for (int i = 0; i < 3; ++i) d[i] = y[i] - x_[i];
        const long double r = std::sqrt(dot(d, d)), r3 = r * r * r, phi = shape(y), z = dot(d, n_);
        int next = 0;
        if (layer_ == Layer::single) {
            out[next++] = phi / r;
        } else {
            out[next++] = phi * z / r3;
            for (int i = 0; i < 3; ++i) {
                const int j = (i + 1) % 3, k = (i + 2) % 3;
                out[next++] = phi * (d[j] * n_[k] - d[k] * n_[j]) / r3;
            }
        }
        const long double factor = layer_ == Layer::single ? phi / r3 : 3 * phi * z / (r3 * r * r);
        constexpr int kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};
        for (int k = 0; k < 6; ++k) out[next++] = factor * d[kRow[k]] * d[kColumn[k]];
    }

private:
    static long double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
    long double shape(const Point& y) const {
        if (shape_ < 0) return 1;
        Point w;
        for (int i = 0; i < 3; ++i) w[i] = y[i] - origin_[i];
        const long double uu = dot(u_, u_), uv = dot(u_, v_), vv = dot(v_, v_), wu = dot(w, u_), wv = dot(w, v_);
        const long double det = uu * vv - uv * uv;
        const long double s = (vv * wu - uv * wv) / det, t = (uu * wv - uv * wu) / det;
        return shape_ == 0 ? 1 - s - t : shape_ == 1 ? s : t;
    }

    Point x_, origin_, u_, v_, n_;
    Layer layer_;
    int shape_;
};

/// The point of the triangle nearest to x.
Vector3d nearest_point(const Corners& t, const Vector3d& x) {
    const Vector3d n(t.geometry().n), offset = n * n.dot(x - t.a);
    const Vector3d projected = offset.norm() < 1e-12 ? x : Vector3d(x - offset);
    const std::array<Vector3d, 3> corner = {t.a, t.b, t.c};
    Vector3d best = projected;
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d edge = corner[(i + 1) % 3] - corner[i];
        if (n.dot(edge.cross(projected - corner[i])) > 1e-9 * edge.squaredNorm()) continue;
        const Vector3d on_edge =
            corner[i] + std::clamp((projected - corner[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge;
        if (inside || (on_edge - x).norm() < (best - x).norm()) best = on_edge;
        inside = false;
    }
    return best;
}

/// Quadrature of one layer times each of `shapes`, one after the other. The triangle is split at the point nearest to
/// x, which becomes the collapsed corner of the quadrature.
Values truth(const Corners& t, const Vector3d& x, Layer layer, const std::vector<int>& shapes) {
    std::vector<Integrand> integrands;
    for (const int shape : shapes) integrands.emplace_back(t, x, layer, shape);
    const int n_numbers = numbers_of(layer), n_values = n_numbers * static_cast<int>(shapes.size());
    Values block(n_numbers);
    const auto function = [&](const Point& y, Values& out) {
        for (std::size_t s = 0; s < integrands.size(); ++s) {
            integrands[s](y, block);
            std::copy(block.begin(), block.end(), out.begin() + static_cast<long>(s) * n_numbers);
        }
    };
    const std::array<Vector3d, 3> corner = {t.a, t.b, t.c};
    Values sum(n_values, 0.0L);
    const auto add = [&](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
        const Values part = testing::integrate({as_point(p), as_point(q), as_point(r)}, n_values, function, 1e-14L);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part[k];
    };
    const Vector3d split = nearest_point(t, x);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d &p = corner[i], &q = corner[(i + 1) % 3];
        if ((p - split).cross(q - split).norm() > 1e-12 * (q - p).squaredNorm()) add(split, p, q);
    }
    return sum;
}

SourceLanes lanes_at(const Vector3d& x, double own_triangle = -1.0) {
    SourceLanes lanes{};
    for (int i = 0; i < kMaxLanes; ++i) {
        lanes.x[i] = x[0], lanes.y[i] = x[1], lanes.z[i] = x[2];
        lanes.own_triangle[i] = own_triangle;
    }
    return lanes;
}

/// Runs the kernels on one source repeated in all lanes; shape < 0 asks for the constant function. Lane `lane` counts.
std::vector<double> integral(const TriangleKernels& kernels, const Corners& t, const SourceLanes& points, Layer layer,
                             int shape, const GaussRule* rule = nullptr, int lane = 0) {
    const int n = numbers_of(layer);
    std::vector<double> buffer(static_cast<std::size_t>(3 * n * kernels.lanes), 0.0);
    double* const out[3] = {buffer.data(), buffer.data() + n * kernels.lanes, buffer.data() + 2 * n * kernels.lanes};
    const auto linear = layer == Layer::single ? kernels.single_layer_linear : kernels.double_layer_linear;
    const auto constant = layer == Layer::single ? kernels.single_layer_constant : kernels.double_layer_constant;
    if (shape < 0)
        constant(t.geometry(), points, rule, out);
    else
        linear(t.geometry(), points, rule, out);
    std::vector<double> values(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) values[k] = out[std::max(shape, 0)][k * kernels.lanes + lane];
    return values;
}

long double relative_error(const std::vector<double>& values, const Values& exact) {
    long double difference = 0, scale = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        difference = std::max(difference, std::fabs(values[k] - exact[k]));
        scale = std::max(scale, std::fabs(exact[k]));
    }
    return difference / scale;
}

/// Largest relative error of one layer at x over `shapes` and all kernels; each shape is relative to its own block.
long double layer_error(const Corners& t, const SourceLanes& points, Layer layer, const std::vector<int>& shapes,
                        const GaussRule* rule = nullptr) {
    const Values exact = truth(t, Vector3d(points.x[0], points.y[0], points.z[0]), layer, shapes);
    long double worst = 0;
    for (const TriangleKernels* kernels : {&plain_triangle_kernels(), &best_triangle_kernels()})
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            const auto begin = exact.begin() + static_cast<long>(s) * numbers_of(layer);
            worst = std::max(worst, relative_error(integral(*kernels, t, points, layer, shapes[s], rule),
                                                   Values(begin, begin + numbers_of(layer))));
        }
    return worst;
}

const std::vector<int> kAllShapes = {-1, 0, 1, 2};  // -1 is the constant function

long double closed_form_error(const Corners& t, const Vector3d& x) {
    return std::max(layer_error(t, lanes_at(x), Layer::single, kAllShapes),
                    layer_error(t, lanes_at(x), Layer::twofold, kAllShapes));
}

Corners random_triangle(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const auto point = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
    for (;;) {
        const Corners t{point(), point(), point()};
        const TriangleGeometry g = t.geometry();
        if (g.double_area / (g.longest_edge * g.longest_edge) > 0.3) return t;
    }
}

constexpr double kTolerance = 1e-12;

/// n_trials: fewer where the quadrature takes seconds.
void expect_closed_form(const std::function<Vector3d(const Corners&, std::mt19937&)>& place, int n_trials = 4) {
    std::mt19937 random(7);
    for (int trial = 0; trial < n_trials; ++trial) {
        const Corners t = random_triangle(random);
        EXPECT_LT(closed_form_error(t, place(t, random)), kTolerance) << "trial " << trial;
    }
}

TEST(TriangleKernels, AgreeWithQuadratureAtRandomPoints) {
    expect_closed_form([](const Corners& t, std::mt19937& random) {
        std::normal_distribution<double> normal;
        return Vector3d(t.a + Vector3d(normal(random), normal(random), normal(random)));
    });
}

TEST(TriangleKernels, AgreeWithQuadratureJustAboveAndBelowTheFace) {
    for (const double distance : {2e-2, -2e-2}) {
        const auto place = [distance](const Corners& t, std::mt19937&) {
            return Vector3d(0.5 * t.a + 0.3 * t.b + 0.2 * t.c + distance * Vector3d(t.geometry().n));
        };
        expect_closed_form(place, 1);
    }
}

TEST(TriangleKernels, AgreeWithQuadratureNextToAnEdge) {
    const auto place = [](const Corners& t, std::mt19937& random) {
        std::normal_distribution<double> normal;
        const Vector3d away = Vector3d(normal(random), normal(random), normal(random)).normalized();
        return Vector3d(0.4 * t.a + 0.6 * t.b + 5e-2 * away);
    };
    expect_closed_form(place, 2);
}

TEST(TriangleKernels, AgreeWithQuadratureInThePlane) {
    expect_closed_form([](const Corners& t, std::mt19937& random) {
        return Vector3d(t.a + (1.2 + 0.1 * static_cast<double>(random() % 10)) * (t.b - t.a) + 0.7 * (t.c - t.a));
    });
}

TEST(TriangleKernels, AgreeWithQuadratureOnTheExtensionOfAnEdge) {
    expect_closed_form([](const Corners& t, std::mt19937& random) {
        return Vector3d(t.a + (1.1 + 0.1 * static_cast<double>(random() % 10)) * (t.b - t.a));
    });
}

/// At a corner the two shape functions that vanish there have ordinary integrals; the third diverges in the double
/// layer by design (its sum over neighbours is finite) and is ordinary in the single layer.
TEST(TriangleKernels, AgreeWithQuadratureAtACorner) {
    std::mt19937 random(11);
    for (int trial = 0; trial < 4; ++trial) {
        const Corners t = random_triangle(random);
        EXPECT_LT(layer_error(t, lanes_at(t.a), Layer::single, kAllShapes), kTolerance) << "trial " << trial;
        EXPECT_LT(layer_error(t, lanes_at(t.a), Layer::twofold, {1, 2}), kTolerance) << "trial " << trial;
    }
}

/// In the interior the double layer is a principal value: by polar coordinates around x,
/// int rho/r^3 = oint e(theta) ln R(theta) d theta, and with a shape function phi(x) times that plus
/// oint e (g.e) R d theta.
Vector3d principal_value(const Corners& t, const Vector3d& x, int shape) {
    const TriangleGeometry g = t.geometry();
    const Vector3d e1(g.e1), e2(g.e2), n(g.n);
    const std::array<Vector3d, 3> corner = {t.a, t.b, t.c};
    const Vector3d gradient = shape < 0 ? Vector3d::Zero() : Vector3d(g.gx[shape] * e1 + g.gy[shape] * e2);
    const double phi = shape < 0 ? 1.0 : gradient.dot(x - corner[shape]) + 1.0;
    const testing::LegendreRule rule(40);
    Vector3d w = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
        const Vector3d a = corner[i] - x, b = corner[(i + 1) % 3] - x, m = (b - a).cross(n).normalized();
        const double begin = std::atan2(a.dot(e2), a.dot(e1));
        const double sweep = std::atan2(n.dot(a.cross(b)), a.dot(b));
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            const double theta = begin + sweep * static_cast<double>(rule.nodes[q]);
            const Vector3d e = std::cos(theta) * e1 + std::sin(theta) * e2;
            const double R = a.dot(m) / e.dot(m);
            w += sweep * static_cast<double>(rule.weights[q]) * e * (phi * std::log(R) + gradient.dot(e) * R);
        }
    }
    return w.cross(n);
}

TEST(TriangleKernels, GiveThePrincipalValueAtAnInteriorPoint) {
    std::mt19937 random(13);
    for (int trial = 0; trial < 6; ++trial) {
        const Corners t = random_triangle(random);
        const Vector3d x = 2.0 / 3.0 * t.a + 1.0 / 6.0 * t.b + 1.0 / 6.0 * t.c;
        EXPECT_LT(layer_error(t, lanes_at(x, 0.0), Layer::single, kAllShapes), kTolerance);
        for (const TriangleKernels* kernels : {&plain_triangle_kernels(), &best_triangle_kernels()})
            for (const int shape : kAllShapes) {
                const std::vector<double> block = integral(*kernels, t, lanes_at(x, 0.0), Layer::twofold, shape);
                const Vector3d c(block[1], block[2], block[3]), exact = principal_value(t, x, shape);
                EXPECT_LT((c - exact).norm() / exact.norm(), kTolerance) << kernels->name << ", shape " << shape;
                EXPECT_LT(std::fabs(block[0]), 1e-15);
            }
    }
}

/// With (edge / altitude)^2 roundings lost, of a double just above the limit of slivers, of a long double below it.
TEST(TriangleKernels, KeepTheirDigitsOnSlivers) {
    for (const auto& [altitude, tolerance] : {std::pair(0.011, 2e-11), {0.009, 1e-12}, {1e-3, 1e-12}, {1e-4, 1e-9}}) {
        const Corners t{{0, 0, 0}, {1, 0, 0}, {0.37, altitude, 0}};
        for (const Vector3d& x : {Vector3d(0.4, 0.3, 0.2), Vector3d(-0.5, 0.1, 0.0), Vector3d(0.5, 0.05, 0.02)})
            EXPECT_LT(closed_form_error(t, x), tolerance) << "altitude " << altitude << ", x " << x.transpose();
    }
}

/// What the kernels of both layers say of the numbers of a potential.
std::vector<double> potential_of_layers(const Corners& t, const Vector3d& x, Potential wanted) {
    const TriangleKernels& kernels = plain_triangle_kernels();
    const SourceLanes points = lanes_at(x);
    const std::vector<double> single = integral(kernels, t, points, Layer::single, -1);
    std::vector<double> values(single.begin() + 1, single.end());
    if (wanted == Potential::with_normals)
        for (const int shape : {0, 1, 2}) values.push_back(integral(kernels, t, points, Layer::twofold, shape)[0]);
    if (wanted == Potential::with_gradient) {
        const std::vector<double> twofold = integral(kernels, t, points, Layer::twofold, -1);
        const Vector3d n(t.geometry().n), c(twofold[1], twofold[2], twofold[3]);
        const Vector3d gradient = twofold[0] * n + n.cross(c);
        values.insert(values.end(), gradient.begin(), gradient.end());
    }
    return values;
}

/// Largest error over all kernels, relative to the largest number; of normals and gradients, to the largest of these.
double potential_error(const Corners& t, const Vector3d& x, Potential wanted) {
    const std::vector<double> expected = potential_of_layers(t, x, wanted);
    const std::vector<double> gradients = potential_of_layers(t, x, Potential::with_gradient);
    const auto largest = [](auto begin, auto end) {
        double size = 0.0;
        for (; begin != end; ++begin) size = std::max(size, std::abs(*begin));
        return size;
    };
    const auto rest = gradients.begin() + kPotentialTensorNumbers;
    const double tensor = largest(gradients.begin(), rest), gradient = largest(rest, gradients.end());
    double worst = 0.0;
    for (const TriangleKernels* kernels : {&plain_triangle_kernels(), &best_triangle_kernels()}) {
        std::vector<double> out(static_cast<std::size_t>(kPotentialNumbers * kernels->lanes), 0.0);
        kernels->potential(t.geometry(), lanes_at(x), wanted, out.data());
        for (int k = 0; k < std::ssize(expected); ++k)
            worst = std::max(worst, std::abs(out[k * kernels->lanes] - expected[k]) /
                                        (k < kPotentialTensorNumbers ? tensor : gradient));
    }
    return worst;
}

/// On both sides of every limit of slivers; the layers of slivers are computed in extended precision.
TEST(TriangleKernels, HaveThePotentialsThatTheLayersHave) {
    std::mt19937 random(23);
    std::normal_distribution<double> normal;
    for (const auto& [altitude, tolerance] :
         {std::pair(0.7, 1e-12), {0.009, 5e-10}, {2.1e-3, 5e-9}, {1.9e-3, 1e-12}, {1e-4, 1e-9}}) {
        const Corners t{{0, 0, 0}, {1, 0, 0}, {0.37, altitude, 0}};
        for (int trial = 0; trial < 40; ++trial) {
            Vector3d x(0.5 + normal(random), normal(random), normal(random));
            if (trial % 4 == 1) x = {normal(random), 0.1 * normal(random), 0.0};
            if (trial % 4 == 2) x = {0.4, 0.5 * altitude, 0.01 * normal(random)};
            if (trial == 3) x = t.b;
            for (const Potential wanted : {Potential::tensor, Potential::with_normals, Potential::with_gradient})
                EXPECT_LT(potential_error(t, x, wanted), tolerance)
                    << "altitude " << altitude << ", x " << x.transpose();
        }
    }
}

void expect_same_in_every_lane(const Corners& t, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const TriangleKernels &best = best_triangle_kernels(), &plain = plain_triangle_kernels();
    SourceLanes lanes{};
    std::vector<Vector3d> points;
    for (int i = 0; i < kMaxLanes; ++i) {
        points.push_back(i == 2   ? t.b
                         : i == 3 ? Vector3d(t.a + t.b + t.c) / 3.0
                                  : Vector3d(normal(random), normal(random), normal(random)));
        lanes.x[i] = points[i][0], lanes.y[i] = points[i][1], lanes.z[i] = points[i][2];
        lanes.own_triangle[i] = i == 3 ? 0.0 : -1.0;
    }
    for (const Layer layer : {Layer::single, Layer::twofold})
        for (int shape = -1; shape < 3; ++shape)
            for (int lane = 0; lane < best.lanes; ++lane) {
                const auto one = integral(plain, t, lanes_at(points[lane], lanes.own_triangle[lane]), layer, shape);
                const auto many = integral(best, t, lanes, layer, shape, nullptr, lane);
                EXPECT_LT(relative_error(many, Values(one.begin(), one.end())), kTolerance) << "lane " << lane;
            }
}

TEST(TriangleKernels, AreTheSameInEveryLaneAndInstructionSet) {
    std::mt19937 random(17);
    expect_same_in_every_lane(random_triangle(random), random);
    expect_same_in_every_lane({{0, 0, 0}, {1, 0, 0}, {0.37, 0.002, 0.001}}, random);
}

TEST(TriangleKernels, ConvergeToTheClosedFormByGaussRulesFarAway) {
    std::mt19937 random(19);
    const Corners t = random_triangle(random);
    const Vector3d x = t.a + 12.0 * t.geometry().longest_edge * Vector3d(0.5, 0.7, 0.5).normalized();
    for (const Layer layer : {Layer::single, Layer::twofold}) {
        EXPECT_LT(layer_error(t, lanes_at(x), layer, kAllShapes, &gauss_rule_3()), 1e-3);
        EXPECT_LT(layer_error(t, lanes_at(x), layer, kAllShapes, &gauss_rule_7()), 1e-7);
        EXPECT_LT(layer_error(t, lanes_at(x), layer, kAllShapes, &gauss_rule_16()), 1e-9);
    }
}

}  // namespace
}  // namespace elastolab
