#pragma once

#include "base/control.hpp"
#include "deform/method.hpp"
#include "mesh/tets/tetrahedralize.hpp"
#include "study/error/problems.hpp"
#include "study/report/table.hpp"

namespace elastolab {

/// How often and how long something is repeated for its median.
struct Repeats {
    double budget_seconds = 0.4;
    int most = 5;
};

/// Cells of one method on one problem:
///   vertices, unknowns, constrained
///   precompute_s   precomputation, no set known
///   set_change_s   first constrained set: columns and capacitance system
///   ready_s        both: from the mesh to a set that can be dragged
///   once_s         a single solve and nothing kept (the program's `solve`)
///   frame_s        a frame of a drag
///   error, error_max, error_force, condition, residual, warnings
///   estimate, estimate_force   the program's own estimates of the largest error of displacements and of reactions
///   check_s        an answer with these estimates
Row measure(const Problem& problem, const Method& method, const Repeats& repeats, Control& control);

/// The same for FEM on tetrahedra of another size or quality, which the program does not offer: a single solve only.
Row measure_tetrahedra(const Problem& problem, const TetOptions& tetrahedra, const Repeats& repeats, Control& control);

}  // namespace elastolab
