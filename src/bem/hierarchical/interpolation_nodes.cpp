#include "bem/hierarchical/interpolation_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elastolab {

namespace {

/// Interpolation at n Chebyshev points is off by about rho^-n, where the ellipse with foci at the ends of the interval
/// and half-axes that add up to rho times its half-length holds no singularity. Source: Trefethen, Approximation Theory
/// and Approximation Practice (2013), theorem 8.2.
int points_for(double half_length, double distance, double tolerance) {
    const double ratio = distance / half_length, rho = ratio + std::sqrt(ratio * ratio - 1.0);
    return std::max(1, static_cast<int>(std::ceil(-std::log(tolerance) / std::log(rho))));
}

}  // namespace

InterpolationNodes::InterpolationNodes(const Eigen::AlignedBox3d& box, double distance, double tolerance)
    : middle_(box.center()) {
    for (int i = 0; i < 3; ++i) {
        Axis& axis = axes_[i];
        axis.half_length = 0.5 * box.sizes()[i];
        const int n = axis.half_length > 0.0 ? points_for(axis.half_length, distance, tolerance) : 1;
        axis.points.resize(n);
        axis.chebyshev.resize(n, n);
        for (int j = 0; j < n; ++j) {
            const double angle = std::numbers::pi * (j + 0.5) / n;
            axis.points[j] = std::cos(angle);
            for (int degree = 0; degree < n; ++degree)
                axis.chebyshev(j, degree) = (degree == 0 ? 1.0 : 2.0) * std::cos(degree * angle) / n;
        }
    }
    const auto &x = axes_[0].points, &y = axes_[1].points, &z = axes_[2].points;
    offsets_.resize(3, x.size() * y.size() * z.size());
    Eigen::Index at = 0;
    for (const double c : z)
        for (const double b : y)
            for (const double a : x)
                offsets_.col(at++) << a * axes_[0].half_length, b * axes_[1].half_length, c * axes_[2].half_length;
}

/// The polynomials of one axis, by the discrete orthogonality of Chebyshev polynomials.
Eigen::VectorXd InterpolationNodes::Axis::at(double x) const {
    const double t = half_length > 0.0 ? x / half_length : 0.0;
    Eigen::VectorXd of_degree(points.size());
    for (Eigen::Index degree = 0; degree < points.size(); ++degree)
        of_degree[degree] = degree == 0   ? 1.0
                            : degree == 1 ? t
                                          : 2.0 * t * of_degree[degree - 1] - of_degree[degree - 2];
    return chebyshev * of_degree;
}

Eigen::MatrixXd InterpolationNodes::polynomials(const Eigen::Matrix3Xd& places) const {
    Eigen::MatrixXd values(size(), places.cols());
    for (Eigen::Index p = 0; p < places.cols(); ++p) {
        const Eigen::Vector3d offset = places.col(p) - middle_;
        const Eigen::VectorXd x = axes_[0].at(offset[0]), y = axes_[1].at(offset[1]), z = axes_[2].at(offset[2]);
        Eigen::Index at = 0;
        for (const double c : z)
            for (const double b : y) {
                values.col(p).segment(at, x.size()) = b * c * x;
                at += x.size();
            }
    }
    return values;
}

}  // namespace elastolab
