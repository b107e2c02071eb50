#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A motion of the constrained nodes from one place to another, by a screw for every patch (a rotation about an axis
/// and a shift, the shortest that fits), with what is not rigid in it growing along.
class MotionPath {
public:
    /// rest: 3 x n positions; from, to: displacements, 3n; patch: number of each node's patch, -1 for nodes that move
    /// along straight lines.
    MotionPath(const Positions& rest, const std::vector<int>& patch, const Eigen::VectorXd& from,
               const Eigen::VectorXd& to);

    /// Displacements at a part of the way, 0 to 1.
    Eigen::VectorXd at(double part) const;
    /// Largest angle of a patch's rotation, 0 to pi.
    double largest_angle() const { return largest_angle_; }
    /// The velocity field whose flow is the motion, at the nodes' start: w x x + v, and what is not rigid [L].
    Eigen::VectorXd logarithm() const;

private:
    struct Screw {
        Eigen::Vector3d turn = Eigen::Vector3d::Zero();   ///< rotation vector
        Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< v of the logarithm
    };
    Screw fit(const std::vector<int>& nodes) const;

    Eigen::VectorXd to_;
    Positions rest_, start_, end_;
    std::vector<int> patch_;
    std::vector<Screw> screws_;
    Eigen::Matrix3Xd growth_;  ///< of each node, in the frame of the start
    double largest_angle_ = 0.0;
};

/// Patches of constrained nodes: numbers of those that edges of elements connect, among the nodes from n_fixed on; -1
/// for the fixed set.
std::vector<int> patches_of_nodes(const Eigen::MatrixXi& elements, int n_nodes, const std::vector<int>& constrained,
                                  int n_fixed);

}  // namespace elastolab
