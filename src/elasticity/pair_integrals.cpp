#include "elasticity/pair_integrals.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "elasticity/triangle_rules.hpp"

namespace elastolab {

namespace {

/// Bound factor * distance^-exponent on the relative error of a rule, the distance of the centroids in units of the sum
/// of the radii; measured in tests/elasticity/pair_integrals_test.cpp.
struct RuleBound {
    const PairRule* rule;
    double factor, exponent;
};

std::vector<RuleBound> rule_bounds() {
    return {{&pair_rule_5(), 6e-3, 6.0},
            {&pair_rule_7(), 1e-3, 8.0},
            {&pair_rule_9(), 3.5e-4, 11.0},
            {&pair_rule_11(), 4e-5, 13.0}};
}

double radius_of(const TriangleGeometry& T) {
    double square = 0.0;
    for (const auto& corner : T.corner) {
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) sum += (corner[k] - T.centroid[k]) * (corner[k] - T.centroid[k]);
        square = std::max(square, sum);
    }
    return std::sqrt(square);
}

/// Most points of a rule whose points are kept for every triangle, and of any rule.
constexpr std::size_t kMostKeptPoints = 32, kMostPoints = 256;

/// [point][axis]
void write_points(const TriangleGeometry& T, const PairRule& rule, double* out) {
    for (const auto& point : rule.points)
        for (int axis = 0; axis < 3; ++axis)
            *out++ = point[0] * T.corner[0][axis] + point[1] * T.corner[1][axis] + point[2] * T.corner[2][axis];
}

double distance(const double (&a)[3], double x, double y, double z) {
    return std::sqrt((a[0] - x) * (a[0] - x) + (a[1] - y) * (a[1] - y) + (a[2] - z) * (a[2] - z));
}

void bound(PairIntegrals::Pack& pack, int lanes) {
    for (int axis = 0; axis < 3; ++axis)
        pack.centre[axis] = std::accumulate(pack.centroid[axis], pack.centroid[axis] + lanes, 0.0) / lanes;
    pack.extent = 0.0;
    for (int lane = 0; lane < lanes; ++lane)
        pack.extent = std::max(
            pack.extent, distance(pack.centre, pack.centroid[0][lane], pack.centroid[1][lane], pack.centroid[2][lane]));
    pack.largest_radius = *std::max_element(pack.radius, pack.radius + lanes);
}

}  // namespace

PairIntegrals::PairIntegrals(std::span<const TriangleGeometry> triangles, double tolerance)
    : triangles_(triangles), tolerance_(tolerance) {
    for (const TriangleGeometry& T : triangles) radius_.push_back(radius_of(T));
    for (const RuleBound& bound : rule_bounds()) {
        FarRule far{bound.rule, std::max(1.5, std::pow(bound.factor / tolerance, 1.0 / bound.exponent)), {}, {}};
        for (const auto& point : bound.rule->points) far.phi.insert(far.phi.end(), point.begin(), point.end());
        const std::size_t n_points = bound.rule->points.size();
        assert(n_points <= kMostPoints);
        if (n_points <= kMostKeptPoints) {
            far.points.resize(3 * n_points * triangles.size());
            for (std::size_t t = 0; t < triangles.size(); ++t)
                write_points(triangles[t], *bound.rule, far.points.data() + 3 * n_points * t);
        }
        far_rules_.push_back(std::move(far));
    }
}

PairIntegrals::Pack PairIntegrals::pack(std::span<const int> tests) const {
    Pack pack{};
    pack.triangles.assign(tests.begin(), tests.end());
    pack.triangles.resize(static_cast<std::size_t>(lanes()), tests.back());
    pack.points.resize(far_rules_.size());
    for (int corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis)
            for (const int t : pack.triangles)
                pack.corners.push_back(triangles_[static_cast<std::size_t>(t)].corner[corner][axis]);
    for (int lane = 0; lane < lanes(); ++lane) {
        const auto t = static_cast<std::size_t>(pack.triangles[static_cast<std::size_t>(lane)]);
        pack.radius[lane] = radius_[t];
        pack.area[lane] = 0.5 * triangles_[t].double_area;
        for (int axis = 0; axis < 3; ++axis) pack.centroid[axis][lane] = triangles_[t].centroid[axis];
    }
    bound(pack, lanes());
    return pack;
}

const double* PairIntegrals::points_of(const FarRule& far, const Pack& pack) const {
    std::vector<double>& points = pack.points[static_cast<std::size_t>(&far - far_rules_.data())];
    const std::size_t n_lanes = static_cast<std::size_t>(lanes()), n_numbers = 3 * far.rule->points.size();
    if (points.empty()) {
        points.resize(n_numbers * n_lanes);
        double memory[3 * kMostPoints];
        for (std::size_t lane = 0; lane < n_lanes; ++lane) {
            const double* own = points_of(far, pack.triangles[lane], memory);
            for (std::size_t i = 0; i < n_numbers; ++i) points[i * n_lanes + lane] = own[i];
        }
    }
    return points.data();
}

const double* PairIntegrals::points_of(const FarRule& far, int field, double* memory) const {
    const auto t = static_cast<std::size_t>(field);
    if (!far.points.empty()) return far.points.data() + 3 * far.rule->points.size() * t;
    write_points(triangles_[t], *far.rule, memory);
    return memory;
}

double PairIntegrals::distance_square(const Pack& pack, int lane, int field) const {
    const TriangleGeometry& s = triangles_[static_cast<std::size_t>(field)];
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = pack.centroid[axis][lane] - s.centroid[axis];
        square += d * d;
    }
    const double radii = pack.radius[lane] + radius_[static_cast<std::size_t>(field)];
    return square / (radii * radii);
}

const PairIntegrals::FarRule* PairIntegrals::far_rule(const Pack& pack, int field) const {
    // Most field triangles are far from the whole pack.
    const double(&c)[3] = triangles_[static_cast<std::size_t>(field)].centroid;
    const double radii = pack.largest_radius + radius_[static_cast<std::size_t>(field)];
    if (distance(pack.centre, c[0], c[1], c[2]) - pack.extent >= far_rules_.front().from * radii)
        return &far_rules_.front();
    double least = 1e300;
    for (int lane = 0; lane < lanes(); ++lane) least = std::min(least, distance_square(pack, lane, field));
    for (const FarRule& far : far_rules_)
        if (least >= far.from * far.from) return &far;
    return nullptr;
}

bool PairIntegrals::is_close(int test, int field) const {
    const TriangleGeometry &t = triangles_[static_cast<std::size_t>(test)],
                           &s = triangles_[static_cast<std::size_t>(field)];
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        square += (t.centroid[axis] - s.centroid[axis]) * (t.centroid[axis] - s.centroid[axis]);
    const double reach = close_distance() * (radius(test) + radius(field));
    return square < reach * reach;
}

unsigned PairIntegrals::integrate_far(const Pack& pack, int field, bool all, double* out) const {
    const double close = close_distance() * close_distance();
    double least = 1e300;
    unsigned others = 0;
    for (int lane = 0; lane < lanes(); ++lane) {
        const double square = distance_square(pack, lane, field);
        if (square < close)
            others |= 1u << lane;
        else
            least = std::min(least, square);
    }
    if (least == 1e300) return others;
    for (const FarRule& far : far_rules_)
        if (least >= far.from * far.from) {
            integrate(far, pack, field, all, out);
            break;
        }
    return others;
}

void PairIntegrals::integrate(const Pack& pack, int field, bool all, double* out) const {
    if (const FarRule* far = far_rule(pack, field))
        integrate(*far, pack, field, all, out);
    else
        integrate_close(pack, field, all, out);
}

void PairIntegrals::integrate(const FarRule& far, const Pack& pack, int field, bool all, double* out) const {
    const TriangleGeometry& s = triangles_[static_cast<std::size_t>(field)];
    double memory[3 * kMostPoints];
    const double *x = points_of(far, pack), *y = points_of(far, field, memory);
    const auto& terms = far.rule->terms;
    const int n_terms = static_cast<int>(terms.size()), n_numbers = all ? kPairNumbers : kPairTensorNumbers;
    if (all)
        kernels_.all(x, y, far.phi.data(), s.n, terms.data(), n_terms, out);
    else
        kernels_.tensor(x, y, terms.data(), n_terms, out);
    for (int lane = 0; lane < lanes(); ++lane) {
        const double areas = pack.area[lane] * 0.5 * s.double_area;
        for (int k = 0; k < n_numbers; ++k) out[k * lanes() + lane] *= areas;
    }
}

void PairIntegrals::integrate_close(const Pack& pack, int field, bool all, double* out) const {
    const TriangleGeometry& s = triangles_[static_cast<std::size_t>(field)];
    bool one_by_one[kMaxLanes];
    int n_medium = 0;
    for (int lane = 0; lane < lanes(); ++lane) {
        const auto t = static_cast<std::size_t>(pack.triangles[static_cast<std::size_t>(lane)]);
        const int n = outer_points(outer_ratio(triangles_[t].corner, s), tolerance_);
        one_by_one[lane] = n > max_outer_points(tolerance_);
        if (!one_by_one[lane]) n_medium = std::max(n_medium, n);
    }
    if (n_medium > 0) add_medium(pack, s, n_medium, all, out);
    for (int lane = 0; lane < lanes(); ++lane) {
        if (!one_by_one[lane]) continue;
        const auto t = static_cast<std::size_t>(pack.triangles[static_cast<std::size_t>(lane)]);
        const PairNumbers numbers = close_pair(triangles_[t], s, all, tolerance_);
        for (int k = 0; k < (all ? kPairNumbers : kPairTensorNumbers); ++k)
            out[k * lanes() + lane] = numbers[static_cast<std::size_t>(k)];
    }
}

void PairIntegrals::add_medium(const Pack& pack, const TriangleGeometry& s, int n, bool all, double* out) const {
    const int n_numbers = all ? kPairNumbers : kPairTensorNumbers;
    std::fill(out, out + n_numbers * lanes(), 0.0);
    const TriangleRule& rule = triangle_rule(n);
    SourceLanes points{};
    std::fill(points.own_triangle, points.own_triangle + kMaxLanes, -1.0);
    double* const coordinates[3] = {points.x, points.y, points.z};
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const auto& b = rule.points[q];
        for (int axis = 0; axis < 3; ++axis)
            for (int lane = 0; lane < lanes(); ++lane) {
                const double* c = pack.corners.data() + axis * lanes() + lane;
                coordinates[axis][lane] = b[0] * c[0] + b[1] * c[3 * lanes()] + b[2] * c[6 * lanes()];
            }
        double values[kPotentialNumbers * kMaxLanes] = {};
        closed_forms_.potential(s, points, all ? Potential::with_normals : Potential::tensor, values);
        for (int i = 0; i < n_numbers * lanes(); ++i) out[i] += rule.weights[q] * values[i];
    }
    for (int lane = 0; lane < lanes(); ++lane)
        for (int k = 0; k < n_numbers; ++k) out[k * lanes() + lane] *= pack.area[lane];
}

}  // namespace elastolab
