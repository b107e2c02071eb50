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
    bool finite = false;  ///< large deformations: tried by finite_trial_variants()
};

const std::vector<TrialGroup>& trial_groups(bool quick);

/// A method with its tractions, by the name that the tables use.
struct TrialVariant {
    std::string name;
    Method method;
};
std::vector<TrialVariant> trial_variants();
std::vector<TrialVariant> finite_trial_variants();

/// Largest error of a vertex, over the largest displacement, and of the reactions of the worst patch, over the largest,
/// up to which an answer counts as right: 10 %, and 25 % for constant BEM, whose elements are of first order.
double allowed_error(MethodKind kind);

/// Checks the mesh, precomputes, constrains, solves and collects whatever the program says, as `solve` does:
/// outcome (right | told | refused | silent), error, error_max, error_force, allowed, condition, residual, message.
///   right    displacements are within `allowed`, and so are reactions where the true ones are known
///   told     some are not, and a warning names what is wrong: displacements, forces, or a cause that spoils both
///   refused  an error message instead of a result
///   silent   wrong without a word: a defect of the program
Row attempt(const Problem& problem, const Method& method, Control& control);

}  // namespace elastolab
