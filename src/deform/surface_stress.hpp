#pragma once

#include <Eigen/Core>
#include <span>

#include "deform/unit_load.hpp"
#include "elasticity/material.hpp"
#include "elasticity/stress.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Traction at every vertex, 3 x n_vertices [force / L^2]: the force at a constrained vertex (one column of `forces`
/// for each of `constrained`) over a third of the area of the triangles around it that have only constrained vertices;
/// of all triangles around it when there is none. Zero elsewhere.
Eigen::Matrix3Xd vertex_tractions(const SurfaceMesh& surface, std::span<const int> constrained,
                                  const Eigen::Matrix3Xd& forces);

/// The tractions of loads with these factors on every triangle, 3 x n_triangles [force / L^2]; no columns without
/// loads. u (3*n_vertices [L]), of large deformations: pressures act on the present triangles, and are given per rest
/// area as all tractions are.
Eigen::Matrix3Xd load_tractions(const SurfaceMesh& surface, std::span<const UnitLoad> loads,
                                const Eigen::VectorXd& factors, const Eigen::VectorXd& u = {});

/// A measure of the stress on the surface, at every vertex the mean over its triangles by area [force / L^2]. In a
/// triangle the strain within its plane comes from the displacements u (3*n_vertices [L]) of its corners, the stress on
/// its plane from its traction (triangle_tractions) and from what acts on the triangle (`of_loads`, as from
/// load_tractions; zero on the free surface), and Hooke's law gives the rest; so it means the same for all methods.
/// First order in the mesh size. With large deformations it is the Cauchy stress of the neo-Hookean material on the
/// present triangle; tractions are still per rest area.
Eigen::VectorXd surface_stress_measure(StressMeasure which, const SurfaceMesh& surface, const Material& material,
                                       const Eigen::VectorXd& u, const Eigen::Matrix3Xd& tractions,
                                       bool large_deformations = false, const Eigen::Matrix3Xd& of_loads = {});

/// The same stress itself, in world axes: 6 x n_vertices [force / L^2], a column of StressNumbers for each vertex.
Eigen::MatrixXd surface_stress(const SurfaceMesh& surface, const Material& material, const Eigen::VectorXd& u,
                               const Eigen::Matrix3Xd& tractions, bool large_deformations = false,
                               const Eigen::Matrix3Xd& of_loads = {});

}  // namespace elastolab
