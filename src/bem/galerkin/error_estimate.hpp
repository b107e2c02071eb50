#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <optional>
#include <span>

#include "base/control.hpp"
#include "deform/solid_model.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// The answer that boundary elements are judged by: symmetric Galerkin on the same surface, with a row of thin
/// triangles along the rims of the constrained patches and along re-entrant edges, and those around lone constrained
/// vertices halved. Galerkin itself is 2 to 14 times more accurate than collocation on organic bodies, and most of what
/// is left comes from where tractions and stresses are singular: refining there gains nearly what refining everywhere
/// does. Where the surface has few triangles across (mesh/triangles_across.hpp) and that is affordable, all triangles
/// are halved: Galerkin on the same ones would be as stiff as what it judges. Solved afresh each time, large surfaces
/// by hierarchical matrices. A body that is not held is pinned (deform/pinned_body.hpp). Collocation is judged where
/// there is nothing to refine, too, on the same triangles.
/// Nothing where it would take too much memory, more than ten times as long as the answer (and two seconds), or
/// cannot be solved.
/// answer    the method that is judged
/// vertices  constrained, all different
/// loads     given ones, on triangles of the surface
/// values    the vertices' displacements, 3*vertices.size(), then a factor for each load
/// first     what that method answered: displacements [L] that begin with those of the surface's vertices
/// Throws Cancelled.
std::optional<ReferenceAnswer> galerkin_reference(const SurfaceMesh& surface, const Method& answer,
                                                  double poisson_ratio, std::span<const int> vertices,
                                                  std::span<const UnitLoad> loads, const Eigen::VectorXd& values,
                                                  const Eigen::VectorXd& first, Control& control);

/// Bytes that it takes; nothing where it would not be computed. Milliseconds.
std::uint64_t galerkin_reference_memory(const SurfaceMesh& surface, const Method& answer,
                                        std::span<const int> vertices);

/// The same for an answer by Galerkin on the surface as it is, of whose error a row along the rims shows most. Where
/// the answer has such rows already (Method::rims), the second answer is the worse one, with rims as given. Where the
/// surface has few triangles across (mesh/triangles_across.hpp), or a closed surface bears loads all over, all are
/// halved besides, if that is affordable.
std::optional<ReferenceAnswer> galerkin_self_reference(const SurfaceMesh& surface, const Method& answer,
                                                       double poisson_ratio, std::span<const int> vertices,
                                                       std::span<const UnitLoad> loads, const Eigen::VectorXd& values,
                                                       const Eigen::VectorXd& first, Control& control);

/// Bytes of a second answer on such a halved surface; nothing where there is none. Milliseconds.
std::uint64_t galerkin_halved_memory(const SurfaceMesh& surface, const Method& answer, std::span<const int> vertices);

}  // namespace elastolab
