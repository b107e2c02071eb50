#include "render/colour_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.hpp"

namespace elastolab {

namespace {

/// Samples of a curve on the way to its even reparametrisation.
constexpr int kFine = 4000;

Colour opaque(const Eigen::Vector3d& srgb) {
    const Eigen::Vector3f shown = srgb.cwiseMax(0.0).cwiseMin(1.0).cast<float>();
    return {shown.x(), shown.y(), shown.z(), 1.0f};
}

/// The Catmull-Rom spline through `points` at s in [0, 1].
Eigen::Vector2d spline(std::span<const Eigen::Vector2d> points, double s) {
    const int last = static_cast<int>(points.size()) - 1;
    const int i = std::min(static_cast<int>(s * last), last - 1);
    const double t = s * last - i;
    const auto at = [&](int k) -> Eigen::Vector2d {
        if (k < 0) return 2.0 * points[0] - points[1];
        if (k > last) return 2.0 * points[points.size() - 1] - points[points.size() - 2];
        return points[static_cast<std::size_t>(k)];
    };
    const Eigen::Vector2d p0 = at(i - 1), p1 = at(i), p2 = at(i + 1), p3 = at(i + 2);
    return p1 + 0.5 * t * ((p2 - p0) + t * ((2 * p0 - 5 * p1 + 4 * p2 - p3) + t * (3 * (p1 - p2) + p3 - p0)));
}

/// Points of the spline at even arc length.
std::vector<Eigen::Vector2d> even_points(std::span<const Eigen::Vector2d> controls, int n) {
    std::vector<Eigen::Vector2d> curve(kFine + 1);
    std::vector<double> length(kFine + 1, 0.0);
    for (std::size_t i = 0; i <= kFine; ++i) {
        curve[i] = spline(controls, static_cast<double>(i) / kFine);
        if (i > 0) length[i] = length[i - 1] + (curve[i] - curve[i - 1]).norm();
    }
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k < n; ++k) {
        const double wanted = length.back() * k / (n - 1);
        const auto after = std::lower_bound(length.begin() + 1, length.end() - 1, wanted);
        const auto i = static_cast<std::size_t>(after - length.begin());
        const double t = (wanted - length[i - 1]) / std::max(length[i] - length[i - 1], 1e-12);
        points.push_back((1.0 - t) * curve[i - 1] + t * curve[i]);
    }
    return points;
}

std::vector<ColourMap> make_maps() {
    const std::vector<Eigen::Vector2d> lagoon = {{0.070, -0.125}, {-0.010, -0.105}, {-0.075, -0.035},
                                                 {-0.115, 0.055}, {-0.085, 0.150},  {-0.025, 0.170}};
    const std::vector<Eigen::Vector2d> ember = {{0.040, -0.075}, {0.125, -0.030}, {0.165, 0.065},
                                                {0.100, 0.125},  {0.020, 0.130},  {-0.020, 0.075}};
    const std::vector<Eigen::Vector2d> slate = {{0.000, -0.020}, {0.000, -0.004}};
    return {ColourMap::sequential("lagoon", 0.30, 0.905, lagoon), ColourMap::sequential("ember", 0.25, 0.95, ember),
            ColourMap::sequential("slate", 0.25, 0.95, slate),
            ColourMap::diverging("balance", 0.49, 0.95, {-0.032, -0.150}, {0.136, 0.071})};
}

}  // namespace

ColourMap ColourMap::sequential(std::string name, double dark, double light, std::span<const Eigen::Vector2d> hues) {
    assert(hues.size() >= 2);
    ColourMap map;
    map.name_ = std::move(name);
    const std::vector<Eigen::Vector2d> path = even_points(hues, kEntries);
    for (std::size_t i = 0; i < kEntries; ++i) {
        const double lightness = dark + (light - dark) * static_cast<double>(i) / (kEntries - 1);
        map.table_[i] = opaque(oklab_to_srgb({lightness, path[i].x(), path[i].y()}));
    }
    return map;
}

ColourMap ColourMap::diverging(std::string name, double dark, double light, const Eigen::Vector2d& low,
                               const Eigen::Vector2d& high) {
    ColourMap map;
    map.name_ = std::move(name);
    map.is_diverging_ = true;
    for (std::size_t i = 0; i < kEntries; ++i) {
        const double signed_t = 2.0 * static_cast<double>(i) / (kEntries - 1) - 1.0, amount = std::abs(signed_t);
        const Eigen::Vector2d hue = amount * (signed_t < 0.0 ? low : high);
        map.table_[i] = opaque(oklab_to_srgb({light + (dark - light) * amount, hue.x(), hue.y()}));
    }
    return map;
}

Colour ColourMap::sample(double t) const {
    const double place = std::clamp(t, 0.0, 1.0) * (kEntries - 1);
    const auto i = std::min(static_cast<std::size_t>(place), std::size_t{kEntries - 2});
    const float s = static_cast<float>(place - static_cast<double>(i));
    const Colour &a = table_[i], &b = table_[i + 1];
    return {a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b), 1.0f};
}

std::span<const ColourMap> colour_maps() {
    static const std::vector<ColourMap> maps = make_maps();
    return maps;
}

const ColourMap& colour_map(std::string_view name) {
    std::string names;
    for (const ColourMap& map : colour_maps()) {
        if (map.name() == name) return map;
        names += (names.empty() ? "" : ", ") + map.name();
    }
    throw Error("colour map \"" + std::string(name) + "\" does not exist. Use one of " + names + ".");
}

}  // namespace elastolab
