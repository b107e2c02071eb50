#pragma once

#include <Eigen/Core>
#include <vector>

namespace elastolab {

/// Where a rigid grip stands: x goes to middle + shift + R (x - middle), middle being the mean of its vertices at rest.
struct GripPlace {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< [L]
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();   ///< rotation vector of R, whole turns included [radians]
};
/// `place`, moved by a small rigid motion about its present middle: a translation over a rotation vector.
GripPlace moved(const GripPlace& place, const Eigen::Matrix<double, 6, 1>& by);

/// The longest step of grips at these places (6 k motions as `moved` takes them) for which a tangent says anything,
/// over the given one: rotations of half a radian, shifts of a third of the body's size. Infinite for a step of zero.
double longest_step(const std::vector<GripPlace>& places, double length, const Eigen::VectorXd& step);

/// How the forces that hold some grips change with their motions, at an equilibrium: 6 k x 6 k, force over moment about
/// its present middle, per translation [L] over rotation [radian] of each grip. Forces in `answered` and out of it are
/// in units in which moments are forces: times 1 / length.
class GripTangent {
public:
    /// length, young_modulus: of the body; held: what else is constrained holds it, so that whatever stiffness is not
    /// rounding counts.
    GripTangent(const Eigen::MatrixXd& stiffness, double length, double young_modulus, bool held);
    /// The same where springs hold the grips, too: one a grip [force / L].
    GripTangent with_springs(const Eigen::VectorXd& springs) const;

    double length() const { return length_; }
    const Eigen::MatrixXd& stiffness() const { return stiffness_; }
    /// False: there is a motion along which the forces drive it on, whatever the mass of the grips.
    bool stable() const;
    /// Those of the forces that some motion answers.
    Eigen::VectorXd answered(const Eigen::VectorXd& forces) const;
    /// Whether the energy falls along some motion: `step` goes downhill then and `newton_step` need not. Moments that
    /// keep their direction have no energy; with them a state can be stable nevertheless.
    bool has_falling_motion() const;
    /// The shortest motion that answers them by this tangent, downhill or not.
    Eigen::VectorXd newton_step(const Eigen::VectorXd& answered) const;
    /// The motion that answers them; where it would lead uphill, the signs of the stiffness along the motions that are
    /// not stable are changed.
    Eigen::VectorXd step(const Eigen::VectorXd& answered) const;
    /// The motion of least stiffness.
    Eigen::VectorXd softest() const;

private:
    Eigen::VectorXd units() const;
    Eigen::MatrixXd stiffness_;
    double length_, young_modulus_;
    bool held_;
    Eigen::MatrixXd scaled_;
    Eigen::VectorXd values_;  ///< eigenvalues of its symmetric part,
    Eigen::MatrixXd modes_;   ///< and eigenvectors
    double none_ = 0.0;       ///< a stiffness up to this is none
};

}  // namespace elastolab
