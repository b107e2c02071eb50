#pragma once

#include <string>
#include <vector>

#include "study/report/plot.hpp"
#include "study/study.hpp"

namespace elastolab {

/// Bars of one cell to four across, by elements of four and of ten nodes, against one of twice as many cells with ten:
/// part "refinement" of the study, and what it says.
void add_large_refinements(bool quick, std::vector<Case>& cases);
std::string refinement_table(const Table& table);
Plot refinement_plot();

}  // namespace elastolab
