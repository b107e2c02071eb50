#pragma once

#include "base/control.hpp"
#include "deform/method.hpp"
#include "study/report/table.hpp"

namespace elastolab {

/// One deformer goes through `n_edits` random edits: vertices become constrained or free, fixed or handle, and get new
/// values. Every so often its displacements are compared with those of a new model and a new deformer with the direct
/// update, which shares nothing with it but the integrals. Sets that hold nothing are left out of the comparison.
/// edits, checks, error (worst relative difference), allowed, outcome, vertices, constrained (largest set).
Row random_edits(const Method& method, int n_edits, int n_checks, unsigned seed, Control& control);

/// A bar with one, two and `most` threads; error: largest relative difference from one thread.
Row thread_counts(const Method& method, int most, Control& control);

}  // namespace elastolab
