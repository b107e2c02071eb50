#include "study/measure.hpp"

#include <limits>
#include <optional>

#include "deform/node_solver.hpp"
#include "fem/assembly.hpp"
#include "fem/prescribed.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "methods/precompute.hpp"
#include "study/report/statistics.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

void set_errors(Row& row, const Problem& problem, const Eigen::VectorXd& u) {
    row.set("error", problem.error(u)).set("error_max", problem.largest_error(u));
}

/// Not a number, which leaves a cell empty, where there is no value.
double or_nothing(const std::optional<double>& value) {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Mesh to displacements with one factorisation, as `solve` does it: by the direct update, or as the method says where
/// that finds that nothing holds the body.
double once_seconds(const Problem& problem, const Method& method, const Repeats& repeats, Control& control) {
    const auto median = [&](Update update) {
        Method chosen = method;
        chosen.update = update;
        return median_seconds(
            [&] {
                Deformer deformer(precompute(problem.body, chosen, control));
                deformer.constrain(problem.set(), control);
                deformer.displace(problem.values());
            },
            repeats.budget_seconds, repeats.most);
    };
    if (problem.constrained.empty()) return median(method.update);
    try {
        return median(Update::direct);
    } catch (const NotHeldError&) {
        return median(method.update);
    }
}

double frame_seconds(const Deformer& deformer, const Problem& problem) {
    const auto n_loads = std::ssize(problem.loads);
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(problem.values().size(), n_loads > 0 ? n_loads : 3);
    if (n_loads > 0)
        basis.bottomRows(n_loads).setIdentity();  // the sizes of loads change
    else
        basis = translation_basis(problem.constrained.size());
    const DragResponse drag = deformer.drag_response(problem.values(), basis);
    Eigen::VectorXd u;
    const Eigen::VectorXd shift = Eigen::VectorXd::LinSpaced(basis.cols(), 0.1, 0.3);
    return median_seconds_of_short([&] { drag.displace(shift, u); }, 0.02);
}

}  // namespace

Row measure(const Problem& problem, const Method& method, const Repeats& repeats, Control& control) {
    std::vector<double> precomputed, set_change, ready;
    std::optional<Deformer> deformer;
    median_seconds(
        [&] {
            const Stopwatch watch;
            deformer.emplace(precompute(problem.body, method, control));
            precomputed.push_back(watch.seconds());
            deformer->constrain(problem.set(), control);
            ready.push_back(watch.seconds());
            set_change.push_back(ready.back() - precomputed.back());
        },
        repeats.budget_seconds, repeats.most);
    const Stopwatch watch;
    const Deformer::Answer answer = deformer->answer(problem.values(), {.check = true}, control);
    const double check_seconds = watch.seconds();
    const ModelFacts& facts = deformer->model().facts();
    std::vector<std::string> warnings = words(findings_of_model(deformer->model()));
    for (const Finding& finding : findings_of_set(*deformer)) warnings.push_back(words(finding));
    Row row;
    row.set("vertices", facts.n_vertices)
        .set("unknowns", facts.n_degrees_of_freedom)
        .set("constrained", std::ssize(problem.constrained))
        .set("precompute_s", median(precomputed))
        .set("set_change_s", median(set_change))
        .set("ready_s", median(ready))
        .set("once_s", once_seconds(problem, method, repeats, control))
        .set("frame_s", frame_seconds(*deformer, problem));
    set_errors(row, problem, answer.displacements);
    row.set("error_force", or_nothing(problem.force_error(answer.reactions)));
    if (answer.check)
        row.set("estimate", answer.check->relative_error)
            .set("estimate_force", answer.check->relative_force_error)
            .set("check_s", check_seconds);
    return row.set("condition", std::max(facts.condition_estimate, deformer->quality().condition_estimate))
        .set("residual", deformer->residual(problem.values(), control))
        .set("warnings", joined(warnings));
}

Row measure_tetrahedra(const Problem& problem, const TetOptions& tetrahedra, const Repeats& repeats, Control& control) {
    TetMesh mesh;
    std::optional<PrescribedSolution> solution;
    const double once = median_seconds(
        [&] {
            mesh = tetrahedralize(*problem.body.surface, problem.body.name, tetrahedra, control);
            const SparseMatrix K = stiffness(assemble_stiffness_parts(mesh, control), problem.body.material);
            solution = solve_prescribed(K, CholeskyAnalysis(K), problem.constrained, problem.values(), control);
        },
        repeats.budget_seconds, repeats.most);
    Row row;
    row.set("vertices", mesh.n_surface_vertices)
        .set("unknowns", 3 * mesh.n_vertices())
        .set("constrained", std::ssize(problem.constrained))
        .set("once_s", once);
    set_errors(row, problem, solution->displacements.topRows(3 * mesh.n_surface_vertices));
    return row.set("condition", 1.0 / solution->reciprocal_condition);
}

}  // namespace elastolab
