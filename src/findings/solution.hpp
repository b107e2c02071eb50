#pragma once

#include <optional>

#include "deform/deformer.hpp"
#include "deform/finding.hpp"

namespace elastolab {

// What the user should know of a model, a constrained set and an answer. The limits come from measurements that are
// named here; tests/findings/findings_test.cpp repeats them.

/// Of a material: linear tetrahedra lock as Poisson's ratio nears 1/2. From 0.48 on their error in the bending of a bar
/// is more than twice that at 0.3; 3 times at 0.49, 9 times at 0.499, 29 times (a tenth of the displacement) at 0.4999.
Findings findings_of_material(MethodKind method, double poisson_ratio);

/// Of a system with this condition number (1-norm): displacements may be off by condition * 2e-16 of their size,
/// which is reported above 1e-6. `object` names the system.
Findings findings_of_condition(std::string object, double condition);

/// All that is known before anything is constrained: of the surface, the material and the system.
Findings findings_of_model(const Model& model);

/// Of the constrained set: a free body, an ill-conditioned system, a solid held almost only along a line, and point
/// constraints. Microseconds.
Findings findings_of_set(const Deformer& deformer);

/// Constrained vertices without a triangle whose vertices are all constrained: their response depends on the size
/// of the triangles.
Findings findings_of_points(const SurfaceMesh& surface, const ConstrainedSet& set);

/// Of an answer: it changes the volume of an incompressible solid, the mesh is too coarse for its displacements or
/// its reactions (MethodTraits::reported_error), or it leaves a large residual.
Findings findings_of_answer(const Deformer& deformer, const Deformer::Answer& answer);

}  // namespace elastolab
