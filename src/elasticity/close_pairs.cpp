#include "elasticity/close_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "elasticity/outer_cells.hpp"
#include "elasticity/triangle_rules.hpp"

namespace elastolab {

namespace {

using Vec = Eigen::Vector3d;

constexpr double kGrading = 0.17;  ///< ratio of successive pieces towards a singular end
constexpr int kMaxDepth = 40;

Vec corner(const TriangleGeometry& T, int i) { return Eigen::Map<const Vec>(T.corner[i % 3]); }

double distance_to_segment(const Vec& p, const Vec& a, const Vec& b) {
    const Vec ab = b - a;
    const double s = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    return (p - (a + s * ab)).norm();
}

/// Collects weighted points, as many as a kernel takes at once, and sums potentials of one triangle over them.
class PotentialSum {
public:
    /// plane_normal: nullptr, or the normal of the plane in which the points y lie; then the sum's normal numbers are
    /// those of the adjoint, phi_k(y) int (y - x) . n / r^3 dx, else those of the triangle's own hats (if `all`).
    PotentialSum(const TriangleGeometry& triangle, bool all, const double* plane_normal, PairNumbers& sum)
        : triangle_(triangle),
          wanted_(!all           ? Potential::tensor
                  : plane_normal ? Potential::with_gradient
                                 : Potential::with_normals),
          plane_normal_(plane_normal),
          sum_(sum) {}

    void add(const Vec& x, double weight, const Vec& phi) {
        points_.x[n_] = x[0], points_.y[n_] = x[1], points_.z[n_] = x[2];
        points_.own_triangle[n_] = -1.0;
        weights_[n_] = weight;
        phi_[n_] = phi;
        if (++n_ == kernels_.lanes) flush();
    }

    void flush() {
        if (n_ == 0) return;
        for (int i = n_; i < kernels_.lanes; ++i) {
            points_.x[i] = points_.x[0], points_.y[i] = points_.y[0], points_.z[i] = points_.z[0];
            points_.own_triangle[i] = -1.0;
        }
        double values[kPotentialNumbers * kMaxLanes] = {};
        kernels_.potential(triangle_, points_, wanted_, values);
        const int n_summed = wanted_ == Potential::with_normals ? kPairNumbers : kPairTensorNumbers;
        for (int k = 0; k < n_summed; ++k)
            for (int i = 0; i < n_; ++i)
                sum_[static_cast<std::size_t>(k)] += weights_[i] * values[k * kernels_.lanes + i];
        if (wanted_ == Potential::with_gradient) add_adjoint(values + kPairTensorNumbers * kernels_.lanes);
        n_ = 0;
    }

private:
    void add_adjoint(const double* gradient) {
        for (int i = 0; i < n_; ++i) {
            double along = 0.0;
            for (int c = 0; c < 3; ++c) along -= plane_normal_[c] * gradient[c * kernels_.lanes + i];
            for (int k = 0; k < 3; ++k)
                sum_[static_cast<std::size_t>(kPairTensorNumbers + k)] += weights_[i] * phi_[i][k] * along;
        }
    }

    const TriangleGeometry& triangle_;
    Potential wanted_;
    const double* plane_normal_;
    PairNumbers& sum_;
    const TriangleKernels& kernels_ = best_triangle_kernels();
    SourceLanes points_{};
    double weights_[kMaxLanes] = {};
    Vec phi_[kMaxLanes];
    int n_ = 0;
};

/// Points along the edge of `path` opposite its corner `apex`, for the potential of `other`; the edge may begin or end
/// at a corner of `other`.
class Path {
public:
    Path(const TriangleGeometry& path, int apex, const TriangleGeometry& other, double tolerance, bool all)
        : a_(corner(path, apex + 1)),
          b_(corner(path, apex + 2)),
          i_a_((apex + 1) % 3),
          i_b_((apex + 2) % 3),
          other_(other),
          tolerance_(tolerance),
          max_points_(std::min(kMaxLegendre, 2 + static_cast<int>(std::ceil(-std::log(tolerance) / 1.76)))) {
        levels_ = 1 + static_cast<int>(std::ceil(std::log(tolerance) / std::log(kGrading) / (all ? 1.2 : 2.0)));
        levels_ = std::min(levels_, 14);
        for (int i = 0; i < 3; ++i) {
            if (corner(other, i) == a_) singular_ = i, from_a_ = true;
            if (corner(other, i) == b_) singular_ = i, from_a_ = false;
        }
    }

    /// sum of f over the edge, times `factor`.
    void add_to(PotentialSum& sum, double factor) {
        const double scale = factor * (b_ - a_).norm();
        if (singular_ < 0) return add_piece(sum, scale, 0.0, 1.0, 0);
        double end = 1.0;
        for (int level = 0; level < levels_; ++level) {
            add_piece(sum, scale, kGrading * end, end, 0);
            end *= kGrading;
        }
        add_gauss(sum, scale, 0.0, end, max_points_);
    }

private:
    /// u = 0 at the singular end, if there is one.
    Vec point(double u) const { return from_a_ ? Vec(a_ + u * (b_ - a_)) : Vec(b_ + u * (a_ - b_)); }

    void add_piece(PotentialSum& sum, double scale, double from, double to, int depth) {
        const int n = gauss_points(ellipse(from, to), 0.1 * tolerance_);
        if (n <= max_points_ || depth > kMaxDepth) return add_gauss(sum, scale, from, to, std::min(n, max_points_));
        const double middle = 0.5 * (from + to);
        add_piece(sum, scale, from, middle, depth + 1);
        add_piece(sum, scale, middle, to, depth + 1);
    }

    void add_gauss(PotentialSum& sum, double scale, double from, double to, int n) {
        const LineRule& rule = legendre_rule(n);
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            const double u = from + rule.nodes[q] * (to - from), at_b = from_a_ ? u : 1.0 - u;
            Vec phi = Vec::Zero();
            phi[i_a_] = 1.0 - at_b;
            phi[i_b_] = at_b;
            sum.add(point(u), scale * (to - from) * rule.weights[q], phi);
        }
    }

    /// Parameter of the ellipse in which the potential is analytic. Along a ray from a corner it is A(u) + u log(u)
    /// B(u) with A and B singular at the opposite edge only.
    double ellipse(double from, double to) const {
        const Vec p = point(from), q = point(to);
        if (singular_ < 0) return analytic_ellipse(p, q, other_);
        const double to_end = (from + to) / (to - from);
        return std::min(to_end + std::sqrt(to_end * to_end - 1.0),
                        analytic_ellipse(p, q, other_, (singular_ + 1) % 3));
    }

    Vec a_, b_;
    int i_a_, i_b_;
    const TriangleGeometry& other_;
    double tolerance_;
    int max_points_, levels_ = 0, singular_ = -1;
    bool from_a_ = true;
};

/// int e e^T / r ds over the segment a-b, seen from p off its line.
Eigen::Matrix3d segment_tensor(const Vec& p, const Vec& a, const Vec& b) {
    const Vec da = a - p, db = b - p, t = (b - a).normalized();
    const double sa = da.dot(t), sb = db.dot(t), ra = da.norm(), rb = db.norm();
    const Vec off = da - sa * t;
    const double h = off.norm();
    const Vec m = off / h;
    const double L = std::asinh(sb / h) - std::asinh(sa / h);
    const double h2C = sb / rb - sa / ra, hD = h * (1.0 / ra - 1.0 / rb);
    return h2C * m * m.transpose() + hD * (m * t.transpose() + t * m.transpose()) + (L - h2C) * t * t.transpose();
}

Eigen::Matrix3d tensor_of(const double* values, int stride) {
    const auto v = [&](int k) { return values[k * stride]; };
    Eigen::Matrix3d M;
    M << v(0), v(3), v(4), v(3), v(1), v(5), v(4), v(5), v(2);
    return M;
}

PairNumbers identical_pair(const TriangleGeometry& T) {
    const Vec a = corner(T, 0), b = corner(T, 1), c = corner(T, 2);
    PairNumbers numbers{};
    PotentialSum potential(T, false, nullptr, numbers);
    potential.add(c, 1.0, Vec::Zero());
    potential.flush();
    const Eigen::Matrix3d at_c = tensor_of(numbers.data(), 1);
    const Eigen::Matrix3d lines = segment_tensor(b, c, a) / (a - c).norm() + segment_tensor(a, b, c) / (c - b).norm();
    const Eigen::Matrix3d M = (T.double_area / 3.0) * (at_c + T.double_area * lines);
    return {M(0, 0), M(1, 1), M(2, 2), M(0, 1), M(0, 2), M(1, 2)};
}

TriangleGeometry shifted(TriangleGeometry T, const Vec& origin) {
    for (auto& corner : T.corner) Eigen::Map<Vec>{corner} -= origin;
    Eigen::Map<Vec>{T.centroid} -= origin;
    return T;
}

/// The end of a path that is a corner of the other triangle, else its apex. Taken as the local origin, it keeps points
/// near it exact, however far the body lies from the global one.
Vec singular_corner(const TriangleGeometry& path, int apex, const TriangleGeometry& other) {
    for (int end = 1; end <= 2; ++end)
        for (int i = 0; i < 3; ++i)
            if (corner(path, apex + end) == corner(other, i)) return corner(other, i);
    return corner(path, apex);
}

PairNumbers touching_pair(const TriangleGeometry& t, int apex_t, const TriangleGeometry& s, int apex_s, bool all,
                          double tolerance) {
    const auto height = [](const TriangleGeometry& T, int apex) { return T.double_area / T.length[(apex + 1) % 3]; };
    PairNumbers sum{};
    {
        const Vec origin = singular_corner(t, apex_t, s);
        const TriangleGeometry path = shifted(t, origin), other = shifted(s, origin);
        PotentialSum potential(other, all, nullptr, sum);
        Path(path, apex_t, other, tolerance, all).add_to(potential, height(t, apex_t));
        potential.flush();
    }
    {
        const Vec origin = singular_corner(s, apex_s, t);
        const TriangleGeometry path = shifted(s, origin), other = shifted(t, origin);
        PotentialSum potential(other, all, s.n, sum);
        Path(path, apex_s, other, tolerance, all).add_to(potential, height(s, apex_s));
        potential.flush();
    }
    PairNumbers result{};
    for (std::size_t k = 0; k < kPairTensorNumbers; ++k) result[k] = sum[k] / 3.0;
    double whole = 0.0;
    for (std::size_t k = 0; k < 3; ++k) whole += 0.5 * sum[kPairTensorNumbers + k];
    for (int k = 0; k < 3; ++k)
        if (k != apex_s) {
            const auto i = static_cast<std::size_t>(kPairTensorNumbers + k);
            result[i] = sum[i] / 3.0;
            whole -= result[i];
        }
    result[static_cast<std::size_t>(kPairTensorNumbers + apex_s)] = whole;
    return result;
}

PairNumbers separate_pair(const TriangleGeometry& t, const TriangleGeometry& s, bool all, double tolerance) {
    PairNumbers result{};
    PotentialSum sum(s, all, nullptr, result);
    const OuterAccuracy accuracy{tolerance, !all, max_outer_points(tolerance)};
    for_each_outer_cell(t, s, accuracy, [&](const OuterPart& part, const OuterCell& cell) {
        const LineRule &rule_u = legendre_rule(cell.n_u), &rule_v = legendre_rule(cell.n_v);
        const double size_u = cell.u1 - cell.u0, size_v = cell.v1 - cell.v0;
        for (std::size_t i = 0; i < rule_u.nodes.size(); ++i)
            for (std::size_t j = 0; j < rule_v.nodes.size(); ++j) {
                const double u = cell.u0 + size_u * rule_u.nodes[i], v = cell.v0 + size_v * rule_v.nodes[j];
                const double weight = rule_u.weights[i] * rule_v.weights[j] * size_u * size_v;
                sum.add(part.a + u * (part.ab + v * part.bc), part.double_area * u * weight, Vec::Zero());
            }
    });
    sum.flush();
    return result;
}

}  // namespace

int outer_points(double ratio, double tolerance) {
    if (ratio <= 1.05) return kMaxLegendre + 1;
    const double rho = ratio + std::sqrt(ratio * ratio - 1.0);
    return std::max(2, 1 + static_cast<int>(std::ceil((-std::log(tolerance) - 3.0) / (2.0 * std::log(rho)))));
}

int max_outer_points(double tolerance) { return tolerance < 1e-9 ? 11 : 8; }

double outer_ratio(const double (&test_corners)[3][3], const TriangleGeometry& field) {
    const auto at = [&](int i) { return Eigen::Map<const Vec>(test_corners[i]); };
    const Vec centre = (at(0) + at(1) + at(2)) / 3.0;
    double radius = 0.0, distance = 1e300;
    for (int i = 0; i < 3; ++i) {
        radius = std::max(radius, (at(i) - centre).norm());
        distance = std::min(distance, distance_to_segment(centre, corner(field, i), corner(field, i + 1)));
    }
    return distance / radius;
}

PairNumbers close_pair(const TriangleGeometry& test, const TriangleGeometry& field, bool all, double tolerance) {
    int n_shared = 0, apex_t = 0, apex_s = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (corner(test, i) == corner(field, j)) ++n_shared, apex_t = i, apex_s = j;
    if (n_shared == 3) return identical_pair(test);
    if (n_shared > 0) return touching_pair(test, apex_t, field, apex_s, all, tolerance);
    return separate_pair(test, field, all, tolerance);
}

}  // namespace elastolab
