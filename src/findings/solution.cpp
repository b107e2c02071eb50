#include "findings/solution.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <limits>
#include <span>

#include "base/lapack.hpp"
#include "mesh/topology.hpp"
#include "mesh/triangles_across.hpp"

namespace elastolab {

namespace {

using Eigen::Vector3d;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kLocking = 0.48;
/// Poisson's ratio above which pressures of ten-node elements are uncertain, and of collocation where a closed surface
/// is wholly constrained. Stresses of bars in bending are off by less than a tenth at 0.49, and by a quarter to three
/// quarters at 0.499 (docs/results.md, "Stress inside").
constexpr double kUncertainPressure = 0.495;
constexpr double kLostDigits = 1e-6;     ///< relative error of displacements above which rounding is reported
constexpr double kWeakLever = 100.0;     ///< tolerated amplification of an error at a handle
constexpr double kLargeResidual = 1e-6;  ///< rounding leaves 1e-10 at most

void append(Findings& all, Findings more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<char> marked(const SurfaceMesh& surface, const ConstrainedSet& set) {
    std::vector<char> is_constrained(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const std::vector<int>* vertices : {&set.fixed, &set.handles})
        for (const int v : *vertices) is_constrained[static_cast<std::size_t>(v)] = 1;
    return is_constrained;
}

/// For one solid; `solid`: its vertices in the mesh.
Findings findings_of_hold(const SurfaceMesh& surface, std::span<const int> solid, std::span<const char> constrained) {
    std::vector<int> held;
    for (const int v : solid)
        if (constrained[static_cast<std::size_t>(v)]) held.push_back(v);
    if (held.size() < 3) return {};
    const auto n = static_cast<double>(held.size());
    Vector3d centre = Vector3d::Zero();
    for (const int v : held) centre += surface.vertices.col(v) / n;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const int v : held) {
        const Vector3d d = surface.vertices.col(v) - centre;
        spread += d * d.transpose() / n;
    }
    const SymmetricEigen axes = symmetric_eigen(spread);
    const Vector3d line = axes.vectors.col(2);
    double reach = 0.0;
    for (const int v : solid) reach = std::max(reach, (surface.vertices.col(v) - centre).cross(line).norm());
    const double off_line = std::sqrt(std::max(axes.values[0] + axes.values[1], 0.0));
    if (off_line * kWeakLever > reach || off_line < 1e-12 * reach) return {};  // the latter is not held at all
    return {{.kind = FindingKind::weak_hold, .value = reach / off_line, .place = centre}};
}

/// Collocation where a whole closed surface is prescribed: that a uniform pressure on it moves nothing is nearly true
/// of its equations, which leave that pressure open.
Findings findings_of_closed_surfaces(const Model& model, std::span<const char> constrained) {
    const MethodKind method = model.method().kind;
    const double poisson_ratio = model.body().material.poisson_ratio;
    if (method->balances_forces || poisson_ratio <= kUncertainPressure) return {};
    const SurfaceMesh& surface = *model.body().surface;
    for (const std::vector<int>& component : connected_components(surface, EdgeTable(surface)).triangles()) {
        const auto is_constrained = [&](int t) {
            const Eigen::Vector3i corners = surface.triangles.col(t);
            return std::all_of(corners.begin(), corners.end(),
                               [&](int v) { return constrained[static_cast<std::size_t>(v)] != 0; });
        };
        if (std::all_of(component.begin(), component.end(), is_constrained))
            return {{.kind = FindingKind::uncertain_pressure, .value = poisson_ratio, .method = method, .first = 1}};
    }
    return {};
}

/// Volume between the surface of a solid and the origin, and what displacements add to it, to first order.
struct VolumeChange {
    double volume = 0.0, change = 0.0;
};

VolumeChange volume_change(const SurfaceMesh& surface, std::span<const char> in_solid, const Eigen::VectorXd& u) {
    VolumeChange sum;
    for (const auto& t : surface.triangles.colwise()) {
        if (!in_solid[static_cast<std::size_t>(t[0])]) continue;
        const Vector3d a = surface.vertices.col(t[0]), b = surface.vertices.col(t[1]), c = surface.vertices.col(t[2]);
        const Vector3d area = 0.5 * (b - a).cross(c - a);
        sum.volume += area.dot(a) / 3.0;
        for (const int v : t) sum.change += area.dot(u.segment<3>(3 * v)) / 3.0;
    }
    return sum;
}

/// Incompressible solids whose vertices are all prescribed in a way that changes their volume.
Findings findings_of_volume(const Deformer& deformer, const Eigen::VectorXd& u) {
    constexpr double kIncompressible = 0.5 - 1e-9, kChange = 1e-6;
    const Body& body = deformer.model().body();
    Findings findings;
    if (body.material.poisson_ratio < kIncompressible || u.size() == 0) return findings;
    const std::vector<char> constrained = marked(*body.surface, deformer.set());
    for (const Model::Part& part : deformer.model().parts()) {
        std::vector<char> in_solid(constrained.size(), 0);
        bool all = true;
        for (const int v : part.vertices) {
            in_solid[static_cast<std::size_t>(v)] = 1;
            all = all && constrained[static_cast<std::size_t>(v)] != 0;
        }
        if (!all) continue;
        const VolumeChange sum = volume_change(*body.surface, in_solid, u);
        const double relative = std::abs(sum.change) / std::abs(sum.volume);
        // The change is linear in u: compared with how far u moves the surface, its scale does not matter.
        const double extent =
            (body.surface->vertices.rowwise().maxCoeff() - body.surface->vertices.rowwise().minCoeff()).norm();
        if (relative > kChange * u.cwiseAbs().maxCoeff() / extent)
            findings.push_back(
                {.kind = FindingKind::impossible_volume, .severity = Severity::error, .value = relative});
    }
    return findings;
}

}  // namespace

Findings findings_of_material(MethodKind method, double poisson_ratio) {
    if (method->locks && poisson_ratio > kLocking)
        return {{.kind = FindingKind::locking, .value = poisson_ratio, .method = method}};
    if (!method->takes_incompressible && poisson_ratio > kUncertainPressure)
        return {{.kind = FindingKind::uncertain_pressure, .value = poisson_ratio, .method = method, .first = 0}};
    return {};
}

Findings findings_of_condition(std::string object, double condition) {
    if (!(condition * kEps > kLostDigits)) return {};
    return {{.kind = FindingKind::lost_digits, .value = condition, .object = std::move(object)}};
}

Findings findings_of_model(const Model& model) {
    const MethodKind method = model.method().kind;
    Findings findings = findings_of_material(method, model.body().material.poisson_ratio);
    append(findings, model.facts().findings);
    append(findings, findings_of_condition(std::string(method->matrix), model.facts().condition_estimate));
    append(findings, model.facts().surface_findings);
    return findings;
}

Findings findings_of_set(const Deformer& deformer) {
    const SurfaceMesh& surface = *deformer.model().body().surface;
    const SolutionQuality& quality = deformer.quality();
    const std::vector<char> constrained = marked(surface, deformer.set());
    Findings findings;
    for (const Model::Part& part : deformer.model().parts())
        append(findings, findings_of_hold(surface, part.vertices, constrained));
    if (quality.held)
        append(findings, findings_of_condition("constraints", quality.condition_estimate));
    else
        findings.push_back({.kind = quality.free_to_move ? FindingKind::free_motion : FindingKind::singular_though_held,
                            .method = deformer.model().method().kind});
    append(findings, findings_of_points(surface, deformer.set()));
    append(findings, findings_of_closed_surfaces(deformer.model(), constrained));
    return findings;
}

Findings findings_of_points(const SurfaceMesh& surface, const ConstrainedSet& set) {
    const std::vector<char> constrained = marked(surface, set);
    const auto at = [](int v) { return static_cast<std::size_t>(v); };
    std::vector<char> in_patch(constrained.size(), 0);
    for (const auto& t : surface.triangles.colwise())
        if (constrained[at(t[0])] && constrained[at(t[1])] && constrained[at(t[2])])
            for (const int v : t) in_patch[at(v)] = 1;
    int count = 0, first = -1;
    for (const std::vector<int>* vertices : {&set.fixed, &set.handles})
        for (const int v : *vertices)
            if (!in_patch[at(v)] && count++ == 0) first = v;
    if (count == 0) return {};
    return {{.kind = FindingKind::point_constraint,
             .value = static_cast<double>(count),
             .place = surface.vertices.col(first),
             .first = first}};
}

Findings findings_of_answer(const Deformer& deformer, const Deformer::Answer& answer) {
    const MethodKind method = deformer.model().method().kind;
    Findings findings = findings_of_volume(deformer, answer.displacements);
    const bool has_limit = answer.check && method->reported_error;
    // Finer rims do not help where there are few triangles across, nor beyond the finest.
    const bool has_advice = has_limit && (!method->chooses_rims ||
                                          (deformer.model().method().rims < kMostRims &&
                                           triangles_across(*deformer.model().body().surface) >= kFewTrianglesAcross));
    const int n_advised =
        has_advice ? static_cast<int>(deformer.set().fixed.size() + deformer.set().handles.size()) : 0;
    if (!answer.check && method->reported_error) {
        const double across = method->integrates_boundary ? triangles_across(*deformer.model().body().surface) : 0.0;
        const bool is_bad = method->integrates_boundary && across < kFewTrianglesAcross;
        findings.push_back({.kind = FindingKind::no_estimate,
                            .severity = is_bad ? Severity::warning : Severity::note,
                            .value = is_bad ? across : 0.0,
                            .method = method});
    }
    if (has_limit && answer.check->relative_force_error > *method->reported_error)
        findings.push_back({.kind = FindingKind::coarse_forces,
                            .value = answer.check->relative_force_error,
                            .method = method,
                            .second = n_advised});
    if (has_limit && answer.check->relative_error > *method->reported_error) {
        const SurfaceMesh& surface = *deformer.model().body().surface;
        findings.push_back({.kind = FindingKind::coarse_mesh,
                            .value = answer.check->relative_error,
                            .method = method,
                            .place = surface.vertices.col(answer.check->vertex),
                            .first = answer.check->vertex,
                            .second = n_advised});
    }
    if (answer.residual && !(*answer.residual < kLargeResidual))
        findings.push_back(
            {.kind = FindingKind::large_residual, .value = *answer.residual, .object = deformer.model().body().name});
    return findings;
}

}  // namespace elastolab
