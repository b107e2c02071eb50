#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/control.hpp"
#include "deform/deformer.hpp"

namespace elastolab {

/// A patch of handle vertices that moves as one rigid piece: places [begin, end) in ConstrainedSet::handles.
struct Grip {
    int begin = 0, end = 0;
    bool operator==(const Grip&) const = default;
};

/// Where the vertices of some grips are at rest [L]: of each, its middle and, 3 x n, the vertices from there.
struct GripArms {
    GripArms() = default;
    GripArms(const Deformer& deformer, const std::vector<Grip>& grips);

    /// Of each grip's motion or force, 6 k: in these units rotations and moments are lengths and forces.
    Eigen::VectorXd units() const;
    /// Forces over moments (6 k rows) without what does no work, as the moment about the only vertex of a grip, or
    /// about the line of its vertices. By collocation there is one, of the tractions around the vertices.
    Eigen::MatrixXd working(const Eigen::MatrixXd& forces) const;

    std::vector<Eigen::Vector3d> middles;
    std::vector<Eigen::Matrix3Xd> arms;
    double length = 1.0;    ///< of the body, from corner to corner of its box
    Eigen::MatrixXd inert;  ///< motions in these units that move no vertex: orthonormal columns, 6 k rows
};

/// Said where forces would move handles without end.
inline constexpr const char* kUnbalancedGrips =
    "handles under a force: no motion of theirs balances it. Fix a part of the body, give a handle with a moment three "
    "vertices that are not on one line, or let forces and moments sum to zero.";
/// The same by constant elements, whose nodes are triangles.
inline constexpr const char* kUnbalancedTriangles =
    "handles under a force: no motion of theirs balances it. By constant elements a handle is its triangles: give it "
    "three or more whose middles are not on one line, fix a part of the body, let forces and moments sum to zero, or "
    "choose another method.";
/// Below this part of Young's modulus times the size of the body all stiffness of grips is rounding, and what the
/// integrals leave of a rigid motion: nothing but the grips holds the body. A thread of 1 : 1000 resists a pull by 1e-6
/// of it.
inline constexpr double kNothingHolds = 1e-7;

/// Forces and moments that some rigid grips exert on a body, as a linear function of their motions (of small ones:
/// u = t + theta x (x - middle)), everything else prescribed and loaded as it is. Everything about a grip is about its
/// middle, the mean of its vertices at rest.
///
/// A product of columns that a Deformer gives: after that a force is 6 k multiplications of 6 k numbers for k grips, no
/// allocation but the result. By symmetric methods (FEM, Galerkin BEM) the stiffness is symmetric to rounding, so that
/// the work around a closed path is zero; by collocation it is not, and a grip led around a loop gains or loses the
/// energy that the discretisation errs by.
class GripStiffness {
public:
    /// values: as Deformer::displace takes them; those of the grips are left out. The method is linear. Takes 6 k + 1
    /// solves with reactions. Throws SolveError, Cancelled.
    GripStiffness(const Deformer& deformer, const Eigen::VectorXd& values, std::vector<Grip> grips, Control& control);

    /// Everything else prescribed and loaded by other values: one solve with reactions. deformer: that of the
    /// constructor. Throws SolveError, Cancelled.
    void set_others(const Deformer& deformer, const Eigen::VectorXd& values, Control& control);
    /// Whether these values, but for those of the grips, are the ones that it was made or set for last.
    bool is_for(const Eigen::VectorXd& values) const;

    const std::vector<Grip>& grips() const { return grips_; }
    int n_grips() const { return static_cast<int>(grips_.size()); }
    const Eigen::Vector3d& middle(int grip) const { return arms_.middles[static_cast<std::size_t>(grip)]; }
    /// 6 k x 6 k: force over moment of each grip, per translation [L] over rotation [rad] of each. Zero where nothing
    /// but one grip holds the body.
    const Eigen::MatrixXd& matrix() const { return matrix_; }
    /// Force over moment of each grip (6 k), for the motions (6 k) of all.
    Eigen::VectorXd forces(const Eigen::VectorXd& motions) const { return rest_ + matrix_ * motions; }
    /// The motions at which the grips exert these forces (6 k). Where the body is free to move with the grips, those
    /// without the motion that no force resists. Throws SolveError where no motion does: forces do not balance on a
    /// body that nothing else holds, or a grip of one vertex, or of some on a line, is to carry a moment.
    /// Whether they balance is judged by the loads themselves. By collocation, whose reactions to these do not balance,
    /// a body that nothing else holds answers them up to a resultant, which is an error of the method.
    /// springs: one a grip [force / L], or none at all: a force is less by this times the shift of the grip's middle.
    Eigen::VectorXd motions(const Eigen::VectorXd& forces, const Eigen::VectorXd& springs = {}) const;
    /// Puts motions (6 k) into the grips' rows of a Deformer's values.
    void move(const Eigen::VectorXd& motions, Eigen::VectorXd& values) const;

private:
    Eigen::VectorXd others_of(const Eigen::VectorXd& values) const;
    Eigen::VectorXd resultants(const Deformer& deformer, const Eigen::VectorXd& values, Control& control) const;

    std::vector<Grip> grips_;
    GripArms arms_;
    Eigen::MatrixXd loose_;                      ///< motions that nothing but the grips holds
    Eigen::MatrixXd load_work_;                  ///< of loads of size one in these
    Eigen::VectorXd load_size_;                  ///< gross forces of these loads
    Eigen::VectorXd others_;                     ///< the last values, zero for the grips
    Eigen::VectorXd rest_;                       ///< forces without motion
    const char* unbalanced_ = kUnbalancedGrips;  ///< what is said where no motion answers
    Eigen::MatrixXd matrix_;
};

}  // namespace elastolab
