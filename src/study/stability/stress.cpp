#include "study/stability/stress.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "mesh/checks/check.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

/// The mesh as the program takes it. Throws MeshError.
Body checked_body(const Problem& problem, MethodKind kind, std::vector<std::string>& warnings) {
    const CheckedMesh checked = check_and_repair(*problem.body.surface);
    require_usable(checked.report, problem.body.name, kind == MethodKind::fem);
    for (const Defect& defect : checked.report.defects) warnings.push_back(defect.text);
    return study_body(checked.mesh, problem.body.material, problem.body.name);
}

std::string outcome(double error, double allowed, const std::vector<std::string>& warnings) {
    if (error <= allowed) return "right";
    return warnings.empty() ? "silent" : "told";
}

}  // namespace

std::vector<StressVariant> stress_variants() {
    const auto linear = [](Tractions tractions) {
        Method method;
        method.tractions = tractions;
        return method;
    };
    return {{"fem", {.kind = MethodKind::fem}},
            {"constant-bem", {.kind = MethodKind::constant_bem}},
            {"linear-bem", linear(Tractions::discontinuous)},
            {"linear-bem restricted", linear(Tractions::restricted)},
            {"linear-bem continuous", linear(Tractions::continuous)}};
}

double allowed_error(MethodKind kind) { return kind == MethodKind::constant_bem ? 0.25 : 0.1; }

Row attempt(const Problem& problem, const Method& method, Control& control) {
    Row row;
    const double allowed = allowed_error(method.kind);
    row.set("vertices", problem.body.surface->n_vertices()).set("constrained", std::ssize(problem.constrained));
    row.set("allowed", allowed);
    std::vector<std::string> warnings;
    try {
        Deformer deformer(precompute(checked_body(problem, method.kind, warnings), method, control));
        append(warnings, deformer.model().facts().warnings);
        deformer.constrain({{}, problem.constrained}, control);
        append(warnings, deformer.quality().warnings);
        const Deformer::Answer answer = deformer.answer(problem.values(), true, true, control);
        if (answer.check && !answer.check->warning.empty()) warnings.push_back(answer.check->warning);
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
