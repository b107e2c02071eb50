#pragma once

#include <span>
#include <vector>

#include "elasticity/close_pairs.hpp"
#include "elasticity/pair_rules.hpp"

namespace elastolab {

/// Integrals over pairs of triangles (PairNumbers in elasticity/close_pairs.hpp), several test triangles at once, each
/// to a stated relative tolerance:
///   far      the cheapest PairRule that keeps it, vectorised over the test triangles
///   medium   the closed form over the field triangle, a Gauss rule over the test triangles, vectorised over them
///   close    close_pair, one by one
/// The triangles must outlive this object and not intersect each other.
class PairIntegrals {
public:
    PairIntegrals(std::span<const TriangleGeometry> triangles, double tolerance);

    /// Number of test triangles that are integrated at once, one per lane. They should lie close together: the most
    /// demanding of them decides for all.
    int lanes() const { return kernels_.lanes; }

    /// Belongs to one thread.
    struct Pack {
        std::vector<int> triangles;
        mutable std::vector<std::vector<double>> points;  ///< of each far rule: [point][axis][lane]; made on first use
        std::vector<double> corners;                      ///< [corner][axis][lane]
        double radius[kMaxLanes];                         ///< largest distance of a corner from the centroid
        double area[kMaxLanes];
        double centroid[3][kMaxLanes];
        double centre[3], extent, largest_radius;  ///< all centroids lie within `extent` of the centre
    };
    Pack pack(std::span<const int> tests) const;

    /// out [kPairNumbers][lanes] <- the numbers of each test triangle of the pack with this field triangle; without
    /// `all` the normal numbers are not written. Lanes beyond the pack's triangles repeat its last one.
    void integrate(const Pack& pack, int field, bool all, double* out) const;
    /// The same for the test triangles that are far enough for a PairRule, as cheaply as these allow; returns the
    /// others as a mask, one bit per lane: their numbers must not be used. For callers that keep the numbers of close
    /// pairs.
    unsigned integrate_far(const Pack& pack, int field, bool all, double* out) const;
    /// Whether a pair is too close for every PairRule.
    bool is_close(int test, int field) const;
    /// Largest distance of the centroids of close pairs, in units of the sum of both radii.
    double close_distance() const { return far_rules_.back().from; }
    double radius(int triangle) const { return radius_[static_cast<std::size_t>(triangle)]; }

private:
    struct FarRule {
        const PairRule* rule;
        double from;                 ///< least distance of the centroids in units of the sum of both radii
        std::vector<double> phi;     ///< [point][shape]
        std::vector<double> points;  ///< of every triangle: [triangle][point][axis]; of rules of few points only
    };
    const FarRule* far_rule(const Pack& pack, int field) const;
    const double* points_of(const FarRule& far, const Pack& pack) const;
    /// The points of a field triangle: those kept, or written to `memory`.
    const double* points_of(const FarRule& far, int field, double* memory) const;
    /// Squared distance of the centroids in units of the sum of both radii.
    double distance_square(const Pack& pack, int lane, int field) const;
    void integrate(const FarRule& far, const Pack& pack, int field, bool all, double* out) const;
    void integrate_close(const Pack& pack, int field, bool all, double* out) const;
    void add_medium(const Pack& pack, const TriangleGeometry& field, int n, bool all, double* out) const;

    std::span<const TriangleGeometry> triangles_;
    double tolerance_;
    const PairKernels& kernels_ = best_pair_kernels();
    const TriangleKernels& closed_forms_ = best_triangle_kernels();
    std::vector<double> radius_;
    std::vector<FarRule> far_rules_;  ///< cheapest first
};

}  // namespace elastolab
