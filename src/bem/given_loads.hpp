#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "bem/boundary.hpp"
#include "bem/boundary_field.hpp"
#include "deform/solid_model.hpp"
#include "deform/unit_load.hpp"

namespace elastolab {

/// Given loads in boundary elements (docs/formulation.md section 13), for unit Young's modulus. Tractions add to the
/// unknown ones. A body force b needs no volume: u = u_p + u_h with
///   u_p = -(1 - 2 nu) [(b . x) x - |x|^2 b / 2],   sigma_p = -(b . x) I,   x from the middle of the body,
/// and u_h free of body forces. On the whole surface u_h has the tractions (b . x) n beside those of the supports, so
/// that what is unknown at a support is its reaction itself, and what a load adds does not depend on the supports.
struct BodyForceField {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double poisson_ratio = 0.0;

    BodyForceField(const SurfaceMesh& mesh, double nu);
    Eigen::Vector3d displacement(const Eigen::Vector3d& at, const Eigen::Vector3d& body_force) const;
    /// (b . x), minus the pressure of sigma_p.
    double potential(const Eigen::Vector3d& at, const Eigen::Vector3d& body_force) const;
};

/// u_p of each load at the constrained nodes and at the vertices; empty when no load is a body force, or nu = 1/2.
/// prescribed: positions of the constrained nodes.
ParticularField particular_field(const SurfaceMesh& mesh, double poisson_ratio, const Positions& prescribed,
                                 std::span<const UnitLoad> loads);

/// The tractions of some loads, body forces' or others': shape functions on the loaded triangles, and coefficients.
struct GivenTractions {
    Elements elements;
    Eigen::MatrixXd coefficients;       ///< 3*elements.n_slots x columns.size()
    std::vector<Eigen::Index> columns;  ///< which of all the loads these are
};
/// At most two: body forces' (b . x) n, linear on every triangle, and those constant on the triangles that carry them.
std::vector<GivenTractions> given_tractions(const Boundary& boundary, std::span<const UnitLoad> loads);

/// The tractions of the loads with these factors (loads.size() x m).
void add_given(const Boundary& boundary, std::span<const UnitLoad> loads, const Eigen::MatrixXd& factors,
               SurfaceTractions& tractions);

/// The inside of a solution: that of u_h, and what the body forces' u_p and sigma_p add. field: of u_h.
std::shared_ptr<const InteriorField> with_body_forces(std::shared_ptr<const InteriorField> field,
                                                      const SurfaceMesh& mesh, double poisson_ratio,
                                                      std::span<const UnitLoad> loads, const Eigen::MatrixXd& factors);

}  // namespace elastolab
