#pragma once

#include <string>
#include <vector>

#include "study/report/table.hpp"

namespace elastolab {

/// What a variant needs for a given error on one problem.
struct FrontierPoint {
    std::string problem, nu, variant;
    double target = 0.0;
    double seconds = 0.0, vertices = 0.0;  ///< interpolated between the sizes measured
};

/// For every problem and ratio of the part "refinement", every target error and every variant that reaches it. `time`:
/// the column that counts; `error`: that of displacements ("error") or of reactions ("error_force"). Sizes between the
/// measured ones are interpolated in logarithms; a coarsest mesh that is already better counts as it is.
std::vector<FrontierPoint> frontier(const Table& table, const std::string& time, const std::string& error = "error");

/// The fastest at each target, in the order of problem, ratio and target.
std::vector<FrontierPoint> fastest(const std::vector<FrontierPoint>& points);

/// The points of the methods with default choices: variants that have a method's name.
std::vector<FrontierPoint> defaults_of(const std::vector<FrontierPoint>& points);

/// The errors that the frontier is asked for.
const std::vector<double>& target_errors();

/// error (which), problem, nu, time (ready_s, once_s), target, variant, seconds, vertices, whether it is the fastest of
/// all variants, and whether of the defaults: what the plot is drawn from.
Table frontier_table(const Table& table);

}  // namespace elastolab
