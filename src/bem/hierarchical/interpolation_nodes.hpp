#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace elastolab {

/// A tensor grid of Chebyshev points in a box and the polynomials that are one at one of them and zero at the others:
/// a function that is smooth in the box is nearly the sum of its values there times these. Immutable; any thread may
/// use it.
class InterpolationNodes {
public:
    /// As many points along each side as keep 1 / |x - y| to about `tolerance`, for y in the box and x at least
    /// `distance`, more than half the diagonal, from its middle. Mostly errors are smaller; at the corners of the box
    /// they are up to thirty times as large, or a hundred for a tolerance of 1e-12.
    InterpolationNodes(const Eigen::AlignedBox3d& box, double distance, double tolerance);

    int size() const { return static_cast<int>(offsets_.cols()); }
    const Eigen::Vector3d& middle() const { return middle_; }
    const Eigen::Matrix3Xd& offsets() const { return offsets_; }  ///< of the points from the middle
    /// The polynomial of each node (rows) at some places (columns).
    Eigen::MatrixXd polynomials(const Eigen::Matrix3Xd& places) const;

private:
    struct Axis {
        double half_length = 0.0;
        Eigen::VectorXd points;     ///< on [-1, 1]
        Eigen::MatrixXd chebyshev;  ///< weighted Chebyshev polynomials at the points: [point][degree]
        Eigen::VectorXd at(double x) const;
    };

    Eigen::Vector3d middle_;
    Axis axes_[3];
    Eigen::Matrix3Xd offsets_;
};

}  // namespace elastolab
