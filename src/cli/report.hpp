#pragma once

#include <ostream>

#include "scene/solve.hpp"

namespace elastolab {

/// The report as JSON, with the keys that docs/reference.md lists. A number that is not finite becomes null.
void write_report(std::ostream& out, const Solution& solution);

/// A compact summary for people.
void print_summary(std::ostream& out, const SolveRequest& request, const Solution& solution);

}  // namespace elastolab
