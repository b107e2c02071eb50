#pragma once

#include <Eigen/Core>

namespace elastolab {

/// What is prescribed of a rigid grip instead of its motion: force and moment about its middle, the mean of its
/// vertices. By methods that are not linear it is the middle where it is by then.
struct GripForce {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [force]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< [force * L]
    /// While a person pulls through a spring: the force is less by this times the shift of the middle [force / L]. Not
    /// part of scene files.
    double spring = 0.0;
    bool operator==(const GripForce&) const = default;
};

}  // namespace elastolab
