#include "study/stability/trials.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "mesh/checks/check.hpp"
#include "methods/precompute.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

/// What may be wrong with an answer.
enum class Wrong { displacements, forces };

/// Whether a finding says that these are wrong. One that is only good to know, or true of the mesh but no cause of an
/// error, does not count.
bool tells_of(const Finding& finding, Wrong what) {
    switch (finding.kind) {
        case FindingKind::coarse_mesh:
            return what == Wrong::displacements;
        case FindingKind::coarse_forces:
        case FindingKind::force_imbalance:
        case FindingKind::moment_imbalance:
            return what == Wrong::forces;
        case FindingKind::uncertain_pressure:  // of ten-node elements: of stresses, which are not judged
            return finding.first == 1;
        case FindingKind::locking:
        case FindingKind::lost_digits:
        case FindingKind::singular_stiffness:
        case FindingKind::thin_triangle:
        case FindingKind::slender_body:
        case FindingKind::thin_wall:
        case FindingKind::point_constraint:
        case FindingKind::weak_hold:
        case FindingKind::free_motion:
        case FindingKind::singular_though_held:
        case FindingKind::impossible_volume:
        case FindingKind::large_residual:
        case FindingKind::unstable_equilibrium:
        case FindingKind::idle_handle:
            return true;
        case FindingKind::linear_theory:  // of the theory; answers are judged within it
        case FindingKind::no_estimate:
        case FindingKind::contact:
        case FindingKind::nothing_constrained:
        case FindingKind::choice_left_aside:
        case FindingKind::proxy:
        case FindingKind::chosen_proxy:
        case FindingKind::capped_holes:
        case FindingKind::filled_holes:
        case FindingKind::thin_sheets:
        case FindingKind::narrow_openings:
            return false;
    }
    return false;
}

bool told(const Findings& findings, Wrong what) {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const Finding& finding) { return tells_of(finding, what); });
}

/// The mesh as the program takes it. Throws MeshError.
Body checked_body(const Problem& problem, MethodKind kind, std::vector<std::string>& warnings) {
    const CheckedMesh checked = check_and_repair(*problem.body.surface);
    require_usable(checked.report, problem.body.name, kind->has_inside);
    for (const Defect& defect : checked.report.defects) warnings.push_back(defect.text);
    return study_body(checked.mesh, problem.body.material, problem.body.name);
}

std::string outcome(double error, double force_error, double allowed, const Findings& findings) {
    const bool wrong = !(error <= allowed), wrong_forces = !(force_error <= allowed);
    if (!wrong && !wrong_forces) return "right";
    return (wrong && !told(findings, Wrong::displacements)) || (wrong_forces && !told(findings, Wrong::forces))
               ? "silent"
               : "told";
}

}  // namespace

std::vector<TrialVariant> trial_variants() {
    const auto linear = [](Tractions tractions) { return Method{.kind = kLinearBem, .tractions = tractions}; };
    return {{"fem", {.kind = kFem}},
            {"constant-bem", {.kind = kConstantBem}},
            {"galerkin-bem", {.kind = kGalerkinBem}},
            {"quadratic-fem", {.kind = kQuadraticFem}},
            {"linear-bem", linear(Tractions::discontinuous)},
            {"linear-bem restricted", linear(Tractions::restricted)},
            {"linear-bem continuous", linear(Tractions::continuous)}};
}

std::vector<TrialVariant> finite_trial_variants() {
    return {{"nonlinear-fem", nonlinear_method(ElementDegree::quadratic)},
            {"nonlinear-fem of four nodes", nonlinear_method(ElementDegree::linear)}};
}

double allowed_error(MethodKind kind) { return kind == kConstantBem ? 0.25 : 0.1; }

Row attempt(const Problem& problem, const Method& method, Control& control) {
    Row row;
    const double allowed = allowed_error(method.kind);
    row.set("vertices", problem.body.surface->n_vertices()).set("constrained", std::ssize(problem.constrained));
    row.set("allowed", allowed);
    std::vector<std::string> warnings;
    try {
        Deformer deformer(precompute(checked_body(problem, method.kind, warnings), method, control));
        Findings findings = findings_of_model(deformer.model());
        const auto append = [&](const Findings& more) { findings.insert(findings.end(), more.begin(), more.end()); };
        deformer.constrain(problem.set(), control);
        append(findings_of_set(deformer));
        const Deformer::Answer answer = deformer.answer(problem.values(), {.residual = true, .check = true}, control);
        append(findings_of_answer(deformer, answer));
        for (const Finding& finding : findings) warnings.push_back(words(finding));
        const double error = problem.largest_error(answer.displacements);
        const std::optional<double> force_error = problem.force_error(answer.reactions);
        return row.set("error", problem.error(answer.displacements))
            .set("error_max", error)
            .set("condition",
                 std::max(deformer.model().facts().condition_estimate, deformer.quality().condition_estimate))
            .set("residual", answer.residual.value_or(std::nan("")))
            .set("error_force", force_error.value_or(std::nan("")))
            .set("outcome", outcome(error, force_error.value_or(0.0), allowed, findings))
            .set("message", joined(warnings));
    } catch (const Error& error) {
        control.checkpoint();
        return row.set("outcome", std::string("refused")).set("message", std::string(error.what()));
    }
}

}  // namespace elastolab
