#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/control.hpp"
#include "deform/method.hpp"
#include "study/error/problems.hpp"
#include "study/report/table.hpp"

namespace elastolab {

/// Something done to a scene, harder from level to level; the first is harmless.
struct TrialGroup {
    std::string name;
    std::string what;       ///< one line for the report
    std::string parameter;  ///< what the levels are
    std::vector<double> levels;
    /// The scene with its exact solution; problem.body is the mesh as a user would load it, not checked yet.
    std::function<Problem(double level)> make;
};

const std::vector<TrialGroup>& trial_groups(bool quick);

/// A method with its tractions, by the name that the tables use.
struct TrialVariant {
    std::string name;
    Method method;
};
std::vector<TrialVariant> trial_variants();

/// Largest error of a vertex, over the largest displacement, up to which an answer counts as right: 10 %, and 25 % for
/// constant BEM, whose elements are of first order. The eye would hardly notice less.
double allowed_error(MethodKind kind);

/// Checks the mesh, precomputes, constrains, solves and collects whatever the program says, as `solve` does:
/// outcome (right | told | refused | silent), error, error_max, allowed, condition, residual, message.
///   right    the error is within `allowed`
///   told     it is not, and a warning says so
///   refused  an error message instead of a result
///   silent   wrong without a word: a defect of the program
Row attempt(const Problem& problem, const Method& method, Control& control);

}  // namespace elastolab
