#include "study/report/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/timer.hpp"

namespace elastolab {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Point {
    double x, y;
};

std::vector<Point> logarithms(std::span<const double> x, std::span<const double> y) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
        if (x[i] > 0.0 && y[i] > 0.0 && std::isfinite(x[i]) && std::isfinite(y[i]))
            points.push_back({std::log(x[i]), std::log(y[i])});
    return points;
}

}  // namespace

double median(std::vector<double> values) {
    if (values.empty()) return kNone;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double fitted_exponent(std::span<const double> x, std::span<const double> y) {
    const std::vector<Point> points = logarithms(x, y);
    const auto n = static_cast<double>(points.size());
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (const Point& p : points) {
        sx += p.x;
        sy += p.y;
        sxx += p.x * p.x;
        sxy += p.x * p.y;
    }
    const double denominator = n * sxx - sx * sx;
    return points.size() < 2 || denominator <= 0.0 ? kNone : (n * sxy - sx * sy) / denominator;
}

double interpolate_log(std::span<const double> x, std::span<const double> y, double at) {
    std::vector<Point> points = logarithms(x, y);
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    const double target = std::log(at);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Point &a = points[i], &b = points[i + 1];
        if (a.x <= target && target <= b.x)
            return std::exp(b.x > a.x ? a.y + (b.y - a.y) * (target - a.x) / (b.x - a.x) : a.y);
    }
    return kNone;
}

double median_seconds(const std::function<void()>& work, double budget, int most) {
    std::vector<double> seconds;
    const Stopwatch all;
    do {
        const Stopwatch watch;
        work();
        seconds.push_back(watch.seconds());
    } while (all.seconds() < budget && static_cast<int>(seconds.size()) < most);
    return median(seconds);
}

double median_seconds_of_short(const std::function<void()>& work, double budget) {
    // A batch is long compared with the resolution of the clock; a single run may have been interrupted.
    int runs = 1;
    for (double seconds = 0.0; seconds < 1e-3 && runs < 16384; runs *= 2) {
        const Stopwatch watch;
        for (int i = 0; i < runs; ++i) work();
        seconds = watch.seconds();
    }
    return median_seconds(
               [&] {
                   for (int i = 0; i < runs; ++i) work();
               },
               budget) /
           runs;
}

}  // namespace elastolab
