#include "cli/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/blas.hpp"
#include "base/machine.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/json_parts.hpp"

namespace elastolab {

namespace {

using Json = nlohmann::ordered_json;

/// One time for each stage, those that ran for several solids summed, and "total" at the end.
StageTimes summed(const StageTimes& stages) {
    StageTimes sums;
    StageTime total{"total", 0.0};
    for (const StageTime& stage : stages) {
        const auto same = [&](const StageTime& other) { return other.name == stage.name; };
        const auto found = std::find_if(sums.begin(), sums.end(), same);
        if (found == sums.end())
            sums.push_back(stage);
        else
            found->seconds += stage.seconds;
        total.seconds += stage.seconds;
    }
    sums.push_back(total);
    return sums;
}

Json seconds(const StageTimes& stages) {
    Json json = Json::object();
    for (const StageTime& stage : summed(stages)) json[stage.name] = stage.seconds;
    return json;
}

Json machine() {
    const Machine machine = this_machine();
    return {{"cpu", machine.cpu}, {"cores", machine.cores}, {"memory_bytes", machine.memory_bytes}};
}

Json named_forces(const std::vector<GroupReaction>& reactions) {
    Json list = Json::array();
    for (const GroupReaction& reaction : reactions)
        list.push_back({{"name", reaction.name},
                        {"force", vector_json(reaction.force)},
                        {"moment", vector_json(reaction.moment)}});
    return list;
}

Json tractions(const Method& method) {
    if (!method.kind->chooses_tractions) return nullptr;
    return std::string(name(method.tractions));
}

void print_heading(std::ostream& out, const SolveRequest& request, const Method& method) {
    out << request.scene_file.string() << ": " << name(method.kind) << ", " << name(method.mode) << ", ";
    if (method.kind->chooses_tractions) out << name(method.tractions) << " tractions, ";
    if (method.kind->chooses_elements) out << name(method.elements) << " elements, ";
    if (method.rims > 0) out << method.rims << (method.rims == 1 ? " thin row" : " thin rows") << " along rims, ";
    out << name(method.update) << " update\n";
}

void print_sizes(std::ostream& out, const Solution& solution) {
    const ModelFacts& facts = solution.model->facts();
    out << "  sizes         " << solution.surface->n_vertices() << " vertices, " << solution.surface->n_triangles()
        << " faces, ";
    if (solution.proxy)
        out << (solution.proxy->is_filled() ? "with its holes filled " : "proxy of ")
            << solution.proxy->surface->n_vertices() << " vertices, ";
    if (facts.n_tetrahedra > 0) out << facts.n_tetrahedra << " tetrahedra, ";
    out << facts.n_degrees_of_freedom << " degrees of freedom, " << solution.n_constrained << " constrained vertices\n";
}

void print_seconds(std::ostream& out, const StageTimes& stages) {
    const char* separator = "";
    out << "  time          ";
    for (const StageTime& stage : summed(stages)) {
        out << separator << stage.name << " " << readable_seconds(stage.seconds);
        separator = ", ";
    }
    out << "\n";
}

void print_memory(std::ostream& out, const Solution& solution) {
    out << "  memory        peak " << readable_bytes(static_cast<double>(peak_memory_bytes())) << ", predicted "
        << readable_bytes(static_cast<double>(solution.predicted.memory_bytes)) << " beyond the program itself\n";
}

void print_accuracy(std::ostream& out, const Solution& solution) {
    const bool has_condition = solution.condition_estimate > 1.0;  // else it was not estimated
    if (!solution.residual && !has_condition) return;
    out << "  accuracy      ";
    if (solution.residual)
        out << "relative residual " << readable_number(*solution.residual, 4) << (has_condition ? ", " : "");
    if (has_condition) out << "condition about " << readable_number(solution.condition_estimate, 4);
    out << "\n";
}

void print_equilibrium(std::ostream& out, const EquilibriumFacts& facts) {
    out << "  equilibrium   " << facts.iterations << " iterations, energy " << readable_number(facts.energy, 4)
        << ", largest stretch " << readable_number(facts.largest_stretch, 4) << "\n";
}

void print_displacement(std::ostream& out, const Eigen::Matrix3Xd& displacement) {
    if (displacement.cols() == 0) return;
    Eigen::Index vertex = 0;
    const double largest = displacement.colwise().stableNorm().maxCoeff(&vertex);
    out << "  displacement  at most " << readable_number(largest, 4) << ", at vertex " << vertex << "\n";
}

/// A name as the summary has it: names come from scene files and may have any length.
std::string label_of(const GroupReaction& reaction) {
    constexpr std::size_t kLongest = 60;
    return shortened(one_line(reaction.name), kLongest);
}

/// The sum over all fixed sets, what each of several has of it, each handle and each load.
void print_reactions(std::ostream& out, const Solution& solution) {
    std::vector<std::pair<std::string, const GroupReaction*>> lines;
    for (const GroupReaction& reaction : solution.reactions) {
        lines.emplace_back(label_of(reaction), &reaction);
        if (lines.size() > 1 || solution.fixed_reactions.size() < 2) continue;
        for (const GroupReaction& part : solution.fixed_reactions) lines.emplace_back("  of " + label_of(part), &part);
    }
    for (const GroupReaction& load : solution.loads) lines.emplace_back(label_of(load), &load);
    std::size_t width = 12;
    for (const auto& line : lines) width = std::max(width, line.first.size());
    for (auto& [label, reaction] : lines) {
        label.resize(width, ' ');
        out << "  " << label << "  force " << readable_point(reaction->force) << ", moment "
            << readable_point(reaction->moment) << "\n";
    }
}

}  // namespace

void write_report(std::ostream& out, const Solution& solution) {
    const Method& method = solution.model->method();
    const ModelFacts& facts = solution.model->facts();
    const Json json = {
        {"version", version()},
        {"machine", machine()},
        {"blas_kernels", blas_kernels()},
        {"threads", thread_count()},
        {"method", std::string(name(method.kind))},
        {"mode", std::string(name(method.mode))},
        {"tractions", tractions(method)},
        {"elements", method.kind->chooses_elements ? Json(std::string(name(method.elements))) : Json(nullptr)},
        {"rims", method.kind->chooses_rims ? Json(method.rims) : Json(nullptr)},
        {"update", std::string(name(method.update))},
        {"vertices", solution.surface->n_vertices()},
        {"faces", solution.surface->n_triangles()},
        {"proxy", proxy_json(solution.proxy.get())},
        {"tetrahedra", facts.n_tetrahedra},
        {"degrees_of_freedom", facts.n_degrees_of_freedom},
        {"constrained_vertices", solution.n_constrained},
        {"seconds", seconds(solution.stages)},
        {"peak_memory_bytes", peak_memory_bytes()},
        {"predicted_memory_bytes", solution.predicted.memory_bytes},
        {"residual", solution.residual ? finite_or_null(*solution.residual) : Json(nullptr)},
        {"condition_estimate", finite_or_null(solution.condition_estimate)},
        {"fixed_sets", named_forces(solution.fixed_reactions)},
        {"loads", named_forces(solution.loads)},
        {"compliance", solution.compliance ? finite_or_null(*solution.compliance) : Json(nullptr)},
        {"force_imbalance", finite_or_null(solution.imbalance.force)},
        {"moment_imbalance", finite_or_null(solution.imbalance.moment)},
        {"error_estimate",
         {{"displacement", solution.error_estimate ? finite_or_null(*solution.error_estimate) : Json(nullptr)},
          {"force", solution.force_error_estimate ? finite_or_null(*solution.force_error_estimate) : Json(nullptr)}}},
        {"iterations", solution.facts ? Json(solution.facts->iterations) : Json(nullptr)},
        {"energy", solution.facts ? finite_or_null(solution.facts->energy) : Json(nullptr)},
        {"largest_stretch", solution.facts ? finite_or_null(solution.facts->largest_stretch) : Json(nullptr)},
        {"linear_theory_error",
         solution.linear_theory_error ? finite_or_null(*solution.linear_theory_error) : Json(nullptr)},
        {"warnings", solution.warnings()},
    };
    out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

void print_summary(std::ostream& out, const SolveRequest& request, const Solution& solution) {
    print_heading(out, request, solution.model->method());
    print_sizes(out, solution);
    print_seconds(out, solution.stages);
    print_memory(out, solution);
    print_accuracy(out, solution);
    if (solution.facts) print_equilibrium(out, *solution.facts);
    print_displacement(out, solution.displacement);
    print_reactions(out, solution);
    for (const std::string& warning : solution.warnings()) out << "  warning       " << warning << "\n";
    out << "  kernels       BLAS " << blas_kernels() << ", " << thread_count() << " threads\n";
}

}  // namespace elastolab
