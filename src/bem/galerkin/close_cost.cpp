#include "bem/galerkin/close_cost.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "elasticity/close_pairs.hpp"
#include "elasticity/outer_cells.hpp"
#include "elasticity/triangle_geometry.hpp"

namespace elastolab {

namespace {

/// Triangles whose pairs are counted, and pairs whose points are.
constexpr int kTrianglesLookedAt = 48, kPairsLookedAt = 48;
/// Integrals per point; of slivers, in extended precision, so many times as much.
constexpr double kIntegralsPerOuterPoint = 3.6, kTimesOfSlivers = 12.0;
/// Points around a triangle that the other constants of the prediction contain: a ball, a bracket and organic bodies
/// have 4 to 120, cubes, bars and a plate with thin triangles along rims up to 2200. And those of a pair with common
/// corners.
constexpr double kUsualPoints = 2500.0, kTouchingPoints = 150.0;
constexpr double kPricedTolerance = 1e-8;
/// Distance of the centroids, in units of the sum of both radii, from which rules for pairs of points take over.
constexpr double kClosedFormsWithin = 1.9;

class SampledSurface {
public:
    explicit SampledSurface(const SurfaceMesh& surface) : surface_(surface), centroids_(3, surface.n_triangles()) {
        for (int t = 0; t < surface.n_triangles(); ++t) {
            const Eigen::Matrix3d corners = surface.vertices(Eigen::all, surface.triangles.col(t));
            centroids_.col(t) = corners.rowwise().mean();
            radii_.push_back((corners.colwise() - centroids_.col(t)).colwise().norm().maxCoeff());
            is_sliver_.push_back(has_sliver_potential(geometry(t)) ? 1 : 0);
        }
    }
    int size() const { return surface_.n_triangles(); }

    /// Whether a pair may take more than what the other constants contain: without a common corner and nearer than
    /// rules for pairs of points reach, or with a sliver.
    bool counts(int t, int s) const {
        const double of_slivers = is_sliver_[at(t)] || is_sliver_[at(s)] ? kClosedFormsWithin : 1.0;
        const double reach = of_slivers * (radii_[at(t)] + radii_[at(s)]);
        if (t == s || (centroids_.col(t) - centroids_.col(s)).squaredNorm() > reach * reach) return false;
        return of_slivers > 1.0 || !touch(t, s);
    }

    /// What it takes, in points of triangles that are no slivers; of a pair that touches, beyond these constants.
    double points(int t, int s) const {
        const double times = 1.0 + 0.5 * (kTimesOfSlivers - 1.0) * (is_sliver_[at(t)] + is_sliver_[at(s)]);
        if (touch(t, s)) return (times - 1.0) * kTouchingPoints;
        return times * outer_points_of(geometry(t), geometry(s));
    }

private:
    static std::size_t at(int t) { return static_cast<std::size_t>(t); }
    TriangleGeometry geometry(int t) const {
        const auto corner = [&](int k) { return surface_.vertices.col(surface_.triangles(k, t)); };
        return make_triangle_geometry(corner(0), corner(1), corner(2), t);
    }
    bool touch(int t, int s) const {
        for (const int a : surface_.triangles.col(t))
            for (const int b : surface_.triangles.col(s))
                if (a == b) return true;
        return false;
    }
    static double outer_points_of(const TriangleGeometry& t, const TriangleGeometry& s) {
        const int n = outer_points(outer_ratio(t.corner, s), kPricedTolerance);
        const int most = max_outer_points(kPricedTolerance);
        if (n <= most) return n * n;
        double points = 0.0;
        for_each_outer_cell(t, s, {kPricedTolerance, true, most},
                            [&](const OuterPart&, const OuterCell& cell) { points += cell.n_u * cell.n_v; });
        return points;
    }

    const SurfaceMesh& surface_;
    Eigen::Matrix3Xd centroids_;
    std::vector<double> radii_;
    std::vector<char> is_sliver_;
};

}  // namespace

double costly_pair_integrals(const SurfaceMesh& surface) {
    const SampledSurface triangles(surface);
    const int n_sample = std::min(triangles.size(), kTrianglesLookedAt);
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i < n_sample; ++i) {
        const int t = static_cast<int>(static_cast<std::int64_t>(i) * triangles.size() / n_sample);
        for (int s = 0; s < triangles.size(); ++s)
            if (triangles.counts(t, s)) pairs.emplace_back(t, s);
    }
    if (pairs.empty()) return 0.0;
    const std::size_t n_pairs = std::min<std::size_t>(pairs.size(), kPairsLookedAt);
    double points = 0.0;
    for (std::size_t i = 0; i < n_pairs; ++i) {
        const auto& [t, s] = pairs[i * pairs.size() / n_pairs];
        points += triangles.points(t, s);
    }
    const double per_triangle = points / static_cast<double>(n_pairs) * static_cast<double>(pairs.size()) / n_sample;
    // Each pair is integrated once.
    return 0.5 * kIntegralsPerOuterPoint * std::max(0.0, per_triangle - kUsualPoints) * triangles.size();
}

}  // namespace elastolab
