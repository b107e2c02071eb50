#pragma once

#include <Eigen/Core>
#include <vector>

#include "deform/deformer.hpp"
#include "deform/grip.hpp"
#include "deform/grip_force.hpp"
#include "deform/grip_tangent.hpp"

namespace elastolab {

/// Rigid grips of a body that have moved far: what prescribes their places, and the forces and moments there. Moments
/// of a grip are about its present middle. Refers to what it is made of.
class MovedGrips {
public:
    MovedGrips(const Deformer& deformer, const std::vector<Grip>& grips, const std::vector<GripForce>& forces);

    Eigen::Index n() const { return 6 * std::ssize(grips_); }
    double length() const { return rest_.length; }
    /// GripArms::units.
    Eigen::VectorXd units() const { return rest_.units(); }

    /// Places -> their rows of a Deformer's values.
    void put(const std::vector<GripPlace>& places, Eigen::VectorXd& values) const;
    /// Changes of the values with the small motions of each grip (`moved`): n_values x 6 k.
    Eigen::MatrixXd basis(const std::vector<GripPlace>& places, Eigen::Index n_values) const;
    /// Force over moment of each grip (6 k), of the forces at all constrained vertices.
    Eigen::VectorXd resultants(const std::vector<GripPlace>& places, const Eigen::Matrix3Xd& forces) const;
    /// Their derivatives along small motions, springs included: forces change (answer.force_changes along basis()), and
    /// act at arms that turn.
    Eigen::MatrixXd stiffness(const std::vector<GripPlace>& places, const Deformer::Answer& answer) const;
    /// Force over moment of each grip that is prescribed at these places.
    Eigen::VectorXd wanted(const std::vector<GripPlace>& places) const;
    /// Whether what else is constrained holds every solid that has a grip.
    bool body_is_held() const { return body_is_held_; }

private:
    Eigen::Matrix3Xd present(const std::vector<GripPlace>& places, std::size_t grip) const;
    Eigen::Matrix3Xd own(std::size_t grip, const Eigen::Matrix3Xd& all) const;

    const Deformer& deformer_;
    const std::vector<Grip>& grips_;
    const std::vector<GripForce>& wanted_;
    Eigen::Index n_fixed_;
    GripArms rest_;
    bool body_is_held_ = true;
    /// Translations of all grips together that nothing resists: 6 k orthonormal rows. Iterated columns resist a little,
    /// by as much as a free body under small forces resists being turned.
    Eigen::MatrixXd free_translations_;
};

}  // namespace elastolab
