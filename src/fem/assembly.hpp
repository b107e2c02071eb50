#pragma once

#include "base/control.hpp"
#include "elasticity/material.hpp"
#include "fem/quadratic_mesh.hpp"
#include "fem/sparse_matrix.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// Stiffness of tetrahedra with the material taken out: K = lame_lambda * lambda + shear_modulus * mu.
/// For nodes a, b of a tetrahedron whose shape functions have the gradients g_a, g_b:
///   lambda_ab = int g_a g_b^T dV,    mu_ab = int g_b g_a^T + (g_a . g_b) I dV
/// Both are 3*n_nodes square [L], exactly symmetric, both triangles stored, with the same pattern: a 3 x 3 block
/// for every pair of nodes that share a tetrahedron, blocks with zeros included.
struct StiffnessParts {
    SparseMatrix lambda;
    SparseMatrix mu;
};

/// Integrates once per mesh, exactly; in parallel over nodes, with the same result for every number of threads.
/// Throws MeshError when a tetrahedron has no positive volume, SolveError when the pattern is too large, Cancelled.
StiffnessParts assemble_stiffness_parts(const TetMesh& mesh, Control& control);
StiffnessParts assemble_stiffness_parts(const QuadraticMesh& mesh, Control& control);
/// Of elements of 4 or 10 nodes a column: corners, positively oriented, then midpoints by kTetEdges.
StiffnessParts assemble_stiffness_parts(const Positions& nodes, const Eigen::MatrixXi& elements, Control& control);

/// K for a material, poisson_ratio < 1/2 (asserted): force = K * displacement [force / L]. Has the pattern of the
/// parts.
SparseMatrix stiffness(const StiffnessParts& parts, const Material& material);

}  // namespace elastolab
