#include "study/stability/trials.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "mesh/checks/check.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

void append(std::vector<std::string>& all, const Findings& findings) {
    for (const Finding& finding : findings) all.push_back(words(finding));
}

/// The mesh as the program takes it. Throws MeshError.
Body checked_body(const Problem& problem, MethodKind kind, std::vector<std::string>& warnings) {
    const CheckedMesh checked = check_and_repair(*problem.body.surface);
    require_usable(checked.report, problem.body.name, kind->has_inside);
    for (const Defect& defect : checked.report.defects) warnings.push_back(defect.text);
    return study_body(checked.mesh, problem.body.material, problem.body.name);
}

std::string outcome(double error, double allowed, const std::vector<std::string>& warnings) {
    if (error <= allowed) return "right";
    return warnings.empty() ? "silent" : "told";
}

}  // namespace

std::vector<TrialVariant> trial_variants() {
    const auto linear = [](Tractions tractions) { return Method{.kind = kLinearBem, .tractions = tractions}; };
    return {{"fem", {.kind = kFem}},
            {"constant-bem", {.kind = kConstantBem}},
            {"linear-bem", linear(Tractions::discontinuous)},
            {"linear-bem restricted", linear(Tractions::restricted)},
            {"linear-bem continuous", linear(Tractions::continuous)}};
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
        append(warnings, findings_of_model(deformer.model()));
        deformer.constrain({{}, problem.constrained}, control);
        append(warnings, findings_of_set(deformer));
        const Deformer::Answer answer = deformer.answer(problem.values(), {.residual = true, .check = true}, control);
        append(warnings, findings_of_answer(deformer, answer));
        const double error = problem.largest_error(answer.displacements);
        return row.set("error", problem.error(answer.displacements))
            .set("error_max", error)
            .set("condition",
                 std::max(deformer.model().facts().condition_estimate, deformer.quality().condition_estimate))
            .set("residual", answer.residual.value_or(std::nan("")))
            .set("outcome", outcome(error, allowed, warnings))
            .set("message", joined(warnings));
    } catch (const Error& error) {
        control.checkpoint();
        return row.set("outcome", std::string("refused")).set("message", std::string(error.what()));
    }
}

}  // namespace elastolab
