#include "methods/precompute.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "base/error.hpp"
#include "deform/solid_model.hpp"
#include "findings/cost.hpp"
#include "findings/surface.hpp"
#include "mesh/solids.hpp"

namespace elastolab {

namespace {

void require_possible(const Method& method, const Material& material) {
    if (const std::string why = refusal(method, material.poisson_ratio); !why.empty()) throw SolveError(why);
}

void add_stage(const StageTime& stage, StageTimes& stages) {
    const auto same =
        std::find_if(stages.begin(), stages.end(), [&](const StageTime& other) { return other.name == stage.name; });
    if (same == stages.end())
        stages.push_back(stage);
    else
        same->seconds += stage.seconds;
}

/// Of solids of which the same is found: the worst, each once, and how many others there are.
Findings worst_of(const Findings& all) {
    constexpr std::size_t kMost = 3;
    const auto at = [](const Finding& finding) {
        const Eigen::Vector3d place = finding.place.value_or(Eigen::Vector3d::Zero());
        return std::tuple(place.x(), place.y(), place.z());
    };
    const auto is_worse = [&](const Finding& a, const Finding& b) {
        const bool small_is_bad = a.kind == FindingKind::thin_triangle || a.kind == FindingKind::thin_wall;
        if (a.value != b.value) return small_is_bad ? a.value < b.value : a.value > b.value;
        return at(a) < at(b);
    };
    const auto is_same = [](const Finding& a, const Finding& b) { return a.value == b.value && a.place == b.place; };
    Findings kept;
    for (const Finding& finding : all) {
        if (std::ranges::any_of(kept, [&](const Finding& other) { return other.kind == finding.kind; })) continue;
        Findings same;
        std::ranges::copy_if(all, std::back_inserter(same),
                             [&](const Finding& other) { return other.kind == finding.kind; });
        std::ranges::sort(same, is_worse);
        same.erase(std::unique(same.begin(), same.end(), is_same), same.end());
        if (same.size() > kMost) {
            same[kMost - 1].n_more = static_cast<int>(same.size() - kMost);
            same.resize(kMost);
        }
        kept.insert(kept.end(), same.begin(), same.end());
    }
    return kept;
}

/// Sums the facts of the solids; the condition is that of the worst.
ModelFacts summed(const std::vector<Model::Part>& parts) {
    ModelFacts sum;
    for (const Model::Part& part : parts) {
        const ModelFacts& facts = part.solid->facts();
        sum.n_vertices += facts.n_vertices;
        sum.n_triangles += facts.n_triangles;
        sum.n_tetrahedra += facts.n_tetrahedra;
        sum.n_degrees_of_freedom += facts.n_degrees_of_freedom;
        sum.memory_bytes += facts.memory_bytes;
        sum.condition_estimate = std::max(sum.condition_estimate, facts.condition_estimate);
        sum.findings.insert(sum.findings.end(), facts.findings.begin(), facts.findings.end());
        for (const StageTime& stage : facts.stages) add_stage(stage, sum.stages);
    }
    sum.findings = worst_of(sum.findings);
    return sum;
}

Findings findings_of(const SurfaceMesh& surface, const std::vector<Solid>& solids, MethodKind method,
                     Control& control) {
    std::vector<std::vector<int>> vertices;
    for (const Solid& solid : solids) vertices.push_back(solid.vertices);
    Findings findings = findings_of_contact(surface, vertices);
    for (const Solid& solid : solids) {
        const Findings its = findings_of_surface(solid.surface, method, control);
        findings.insert(findings.end(), its.begin(), its.end());
    }
    return worst_of(findings);
}

/// Whether both methods find the same in a surface: what those of boundary elements find has their names.
bool same_findings(MethodKind a, MethodKind b) {
    return a == b || (!a->integrates_boundary && !b->integrates_boundary && a->shows_averages == b->shows_averages);
}

/// Whether a model takes over all that takes memory from the one before, which has it.
bool takes_over(const Model& before, const Method& method, const Material& material) {
    const Method& its = before.method();
    return method.kind == its.kind && method.mode == its.mode && method.growth == its.growth &&
           method.elements == its.elements && method.rims == its.rims &&
           (factorises_ahead(its) || !factorises_ahead(method)) && method.hierarchical_from == its.hierarchical_from &&
           integral_tolerance(method) == integral_tolerance(its) &&
           material.poisson_ratio == before.body().material.poisson_ratio;
}

/// before: a model of the same surface, or null. It lives on beside the new one.
std::shared_ptr<const Model> precompute(const Body& body, const Method& method, const Model* before, Control& control) {
    require_possible(method, body.material);
    const std::vector<Solid> solids = split_solids(*body.surface);
    if (before == nullptr || !takes_over(*before, method, body.material))
        require_memory(predict_cost(solids, method), method);
    const bool same_inside = before != nullptr && before->method().growth == method.growth;
    std::vector<Model::Part> parts;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const SolidModel* old = same_inside ? before->parts()[i].solid.get() : nullptr;
        SurfaceMesh local = solids[i].surface;
        const Eigen::Vector3d origin = computing_origin(local);
        const double scale = computing_scale(local);
        local.vertices = (local.vertices.colwise() - origin) * scale;
        parts.push_back({method.kind->precompute(local, body.name, body.material.poisson_ratio, method, old, control),
                         solids[i].vertices, origin, scale});
    }
    ModelFacts facts = summed(parts);
    facts.surface_findings = before != nullptr && same_findings(method.kind, before->method().kind)
                                 ? before->facts().surface_findings
                                 : findings_of(*body.surface, solids, method.kind, control);
    return std::make_shared<const Model>(body, method, std::move(parts), std::move(facts));
}

}  // namespace

std::shared_ptr<const Model> precompute(const Body& body, const Method& method, Control& control) {
    return precompute(body, method, nullptr, control);
}

std::shared_ptr<const Model> precompute_again(const Model& before, const Material& material, const Method& method,
                                              Control& control) {
    Body body = before.body();
    body.material = material;
    return precompute(body, method, &before, control);
}

}  // namespace elastolab
