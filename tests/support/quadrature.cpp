#include "support/quadrature.hpp"

#include <cmath>

namespace elastolab::testing {

namespace {

constexpr int kPoints = 14;
constexpr int kDeepest = 40;

using Values = std::vector<long double>;
using Function = std::function<void(const Point&, Values&)>;

Point along(const Point& a, const Point& b, long double t) {
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

long double double_area(const std::array<Point, 3>& t) {
    Point u, v;
    for (std::size_t i = 0; i < 3; ++i) u[i] = t[1][i] - t[0][i], v[i] = t[2][i] - t[0][i];
    const long double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return std::sqrt(x * x + y * y + z * z);
}

long double norm(const Values& values) {
    long double sum = 0;
    for (const long double v : values) sum += v * v;
    return std::sqrt(sum);
}

class Integrator {
public:
    Integrator(int n_values, const Function& function) : n_values_(n_values), function_(function), rule_(kPoints) {}

    Values once(const std::array<Point, 3>& triangle) const {
        Values sum(n_values_, 0.0L), value(n_values_, 0.0L);
        const long double area = double_area(triangle);
        for (int i = 0; i < kPoints; ++i)
            for (int j = 0; j < kPoints; ++j) {
                const Point far_point = along(triangle[1], triangle[2], rule_.nodes[j]);
                function_(along(triangle[0], far_point, rule_.nodes[i]), value);
                const long double weight = area * rule_.weights[i] * rule_.nodes[i] * rule_.weights[j];
                for (std::size_t k = 0; k < n_values_; ++k) sum[k] += weight * value[k];
            }
        return sum;
    }

    Values adaptive(const std::array<Point, 3>& t, const Values& whole, long double allowed, int depth) const {
        // Two parts keep the collapsed corner, each with half its angle: similar parts would never converge there.
        const Point a = along(t[0], t[1], 0.5L), b = along(t[1], t[2], 0.5L), c = along(t[2], t[0], 0.5L);
        const Point m = along(a, c, 0.5L);
        constexpr std::size_t kParts = 6;
        const std::array<std::array<Point, 3>, kParts> parts = {
            {{t[0], a, m}, {t[0], m, c}, {t[1], b, a}, {t[2], c, b}, {a, b, m}, {c, m, b}}};
        std::array<Values, kParts> values;
        Values sum(n_values_, 0.0L), difference = whole;
        for (std::size_t p = 0; p < kParts; ++p) {
            values[p] = once(parts[p]);
            for (std::size_t k = 0; k < n_values_; ++k) sum[k] += values[p][k], difference[k] -= values[p][k];
        }
        if (norm(difference) <= allowed || depth == kDeepest) return sum;
        Values refined(n_values_, 0.0L);
        for (std::size_t p = 0; p < kParts; ++p) {
            // The same bound at every depth: the difference is the error of the whole, the parts are far better.
            const Values part = adaptive(parts[p], values[p], allowed, depth + 1);
            for (std::size_t k = 0; k < n_values_; ++k) refined[k] += part[k];
        }
        return refined;
    }

private:
    std::size_t n_values_;
    const Function& function_;
    LegendreRule rule_;
};

}  // namespace

LegendreRule::LegendreRule(int n) : nodes(n), weights(n) {
    for (int i = 0; i < n; ++i) {
        long double x = std::cos(3.14159265358979323846264338327950288L * (i + 0.75L) / (n + 0.5L));
        long double slope = 1;
        for (int iteration = 0; iteration < 100; ++iteration) {
            long double previous = 1, value = x;
            for (int k = 2; k <= n; ++k) {
                const long double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
                previous = value;
                value = next;
            }
            slope = n * (x * value - previous) / (x * x - 1);
            const long double step = value / slope;
            x -= step;
            if (std::fabs(step) < 1e-19L) break;
        }
        nodes[i] = 0.5L * (1 - x);
        weights[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

Values integrate(const std::array<Point, 3>& triangle, int n_values, const Function& function, long double tolerance) {
    const Integrator integrator(n_values, function);
    const Values whole = integrator.once(triangle);
    // The norm of a first, coarse value sets the scale; near singularities it is refined once.
    const Values better = integrator.adaptive(triangle, whole, 1e-6L * norm(whole), 0);
    return integrator.adaptive(triangle, whole, tolerance * norm(better), 0);
}

}  // namespace elastolab::testing
