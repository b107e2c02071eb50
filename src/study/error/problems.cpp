#include "study/error/problems.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>
#include <set>

#include "deform/patch_reactions.hpp"
#include "elasticity/exact_fields.hpp"
#include "mesh/primitives.hpp"
#include "study/error/exact_reactions.hpp"
#include "study/error/finite_problems.hpp"
#include "study/error/loaded_problems.hpp"
#include "study/error/organic_body.hpp"
#include "study/error/organic_truth.hpp"
#include "study/error/study_bar.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

constexpr double kNear = 1e-9;

template <class Field, class Predicate>
Problem exact_problem(SurfaceMesh mesh, const Field& field, const Material& material, Predicate&& constrained) {
    Problem problem;
    problem.truth = displacements(field, mesh.vertices);
    problem.constrained = vertices_where(mesh, constrained);
    problem.reactions =
        exact_reactions(mesh, problem.constrained, [&](const Eigen::Vector3d& x) { return field.stress(x); });
    problem.body = study_body(std::move(mesh), material);
    return problem;
}

template <class Field>
Problem ends_of_bar(SurfaceMesh mesh, const Field& field, const Material& material) {
    return exact_problem(std::move(mesh), field, material,
                         [](const auto& x) { return x[0] < kNear || x[0] > 2.0 - kNear; });
}

Problem twist(int cells, double nu, bool irregular) {
    SurfaceMesh mesh = make_cylinder(cells);
    const double radius = 0.5, end = 1.0 - kNear, step = kJitter * radius * std::numbers::pi / 2.0 / cells;
    Jitter jitter;
    for (auto x : mesh.vertices.colwise()) {
        if (!irregular) break;
        const bool on_side = x.template head<2>().norm() > radius - kNear, on_cap = std::fabs(x[2]) > end;
        const double angle = on_side ? step / radius * jitter() : 0.0;
        x.template head<2>() = Eigen::Rotation2Dd(angle) * Eigen::Vector2d(x.template head<2>());
        if (on_side && !on_cap) x[2] += step * jitter();
        if (on_cap && !on_side) x.template head<2>() += 0.5 * step * Eigen::Vector2d(jitter(), jitter());
    }
    return exact_problem(std::move(mesh), Torsion{{1.0, nu}, 1.0}, {1.0, nu},
                         [=](const auto& x) { return std::fabs(x[2]) > end; });
}

Problem inflate(int cells, double nu) {
    return exact_problem(make_hollow_sphere(cells), HollowSphereField{.material = {1.0, nu}}, {1.0, nu},
                         [](const auto& x) { return x.norm() < 0.75; });
}

Problem moved(const OrganicBody& organic, const Positions& values, double nu) {
    const Material material{1.0, nu};
    Problem problem;
    problem.constrained = organic.constrained();
    const OrganicTruth truth = compute_truth(organic.surface, problem.constrained, values, material, {1});
    problem.truth = truth.displacements.reshaped();
    problem.truth_error = truth.relative_error;
    problem.reactions = truth.reactions;
    problem.truth_force_error = truth.relative_force_error;
    problem.body = study_body(organic.surface, material, organic.name);
    return problem;
}

Problem pull(const OrganicBody& organic, double nu) { return moved(organic, organic.values(0.2), nu); }
Problem turn(const OrganicBody& organic, double nu) { return moved(organic, organic.turned_values(0.35), nu); }

constexpr const char* kExact = "exact solution";
constexpr const char* kRadial = "exact solution, by an ordinary differential equation";
constexpr const char* kConverged = "quadratic finite elements graded towards the rims, extrapolated";

}  // namespace

Eigen::VectorXd Problem::values() const {
    Eigen::VectorXd values(3 * std::ssize(constrained) + factors.size());
    values << values_at(truth, constrained), factors;
    return values;
}

double Problem::error(const Eigen::VectorXd& u) const {
    const std::set<int> fixed(constrained.begin(), constrained.end());
    const double unit = truth.cwiseAbs().maxCoeff();  // keeps the squares of huge and tiny numbers in range
    double off = 0.0, size = 0.0;
    for (int v = 0; v < body.surface->n_vertices(); ++v) {
        if (fixed.contains(v)) continue;
        off += ((u - truth).segment<3>(3 * v) / unit).squaredNorm();
        size += (truth.segment<3>(3 * v) / unit).squaredNorm();
    }
    return std::sqrt(off / size);
}

double Problem::largest_error(const Eigen::VectorXd& u) const {
    return elastolab::largest_error(u / truth.cwiseAbs().maxCoeff(), truth / truth.cwiseAbs().maxCoeff());
}

std::optional<double> Problem::force_error(const Reactions& at_constrained) const {
    if (!reactions) return {};
    constexpr double kBalanced = 1e-9;
    const ConstrainedPatches patches = constrained_patches(*body.surface, {}, constrained);
    const double size = largest_patch_reaction(*body.surface, patches, *reactions);
    if (size <= kBalanced * reactions->forces.colwise().stableNorm().sum()) return {};
    return largest_patch_reaction(
               *body.surface, patches,
               {at_constrained.forces - reactions->forces, at_constrained.moments - reactions->moments}) /
           size;
}

const std::vector<ProblemFamily>& problem_families() {
    static const std::vector<ProblemFamily> families = {
        {"rotation", kExact, false, true,
         [](int size, double nu) {
             return ends_of_bar(study_bar(size, true), RigidMotionField{{0.1, 0.2, 0.3}, {0.3, -0.2, 0.1}}, {1.0, nu});
         }},
        {"stretch", kExact, false, true,
         [](int size, double nu) {
             return ends_of_bar(study_bar(size, true), UniaxialStretch{{1.0, nu}, 1.0}, {1.0, nu});
         }},
        {"bending", kExact, false, false,
         [](int size, double nu) {
             return ends_of_bar(study_bar(size, false), PureBending{{1.0, nu}, 1.0}, {1.0, nu});
         }},
        {"bending-irregular", kExact, false, false,
         [](int size, double nu) {
             return ends_of_bar(study_bar(size, true), PureBending{{1.0, nu}, 1.0}, {1.0, nu});
         }},
        {"torsion", kExact, false, false, [](int size, double nu) { return twist(size, nu, false); }},
        {"torsion-irregular", kExact, false, false, [](int size, double nu) { return twist(size, nu, true); }},
        {"hollow-sphere", kExact, false, false, [](int size, double nu) { return inflate(size, nu); }},
        {"hanging-bar", kExact, false, false, [](int size, double nu) { return hanging_bar(size, nu); }},
        {"pressed-sphere", kExact, false, false, [](int size, double nu) { return pressed_sphere(size, nu); }},
        {"pressed-bar", kExact, false, true, [](int size, double nu) { return pressed_bar(size, nu); }},
        {"finite-rotation", kExact, false, true, [](int size, double nu) { return finite_rotation(size, nu); }, true},
        {"finite-stretch", kExact, false, true, [](int size, double nu) { return finite_stretch(size, nu); }, true},
        {"finite-bending", kRadial, false, false, [](int size, double nu) { return finite_bending(size, nu); }, true},
        {"finite-torsion", kRadial, false, false, [](int size, double nu) { return finite_torsion(size, nu); }, true},
        {"finite-swelling", kRadial, false, false, [](int size, double nu) { return finite_swelling(size, nu); }, true},
        {"cantilever", kConverged, true, false, [](int size, double nu) { return cantilever(size, nu); }},
        {"rabbit", kConverged, true, false, [](int size, double nu) { return pull(make_rabbit(size), nu); }},
        {"potato", kConverged, true, false, [](int size, double nu) { return pull(make_potato(size), nu); }},
        {"cactus", kConverged, true, false, [](int size, double nu) { return pull(make_cactus(size), nu); }},
        {"rabbit-turned", kConverged, true, false, [](int size, double nu) { return turn(make_rabbit(size), nu); }},
        {"potato-turned", kConverged, true, false, [](int size, double nu) { return turn(make_potato(size), nu); }},
        {"cactus-turned", kConverged, true, false, [](int size, double nu) { return turn(make_cactus(size), nu); }},
    };
    return families;
}

const ProblemFamily& problem_family(const std::string& name) {
    const auto& all = problem_families();
    return *std::find_if(all.begin(), all.end(), [&](const ProblemFamily& family) { return family.name == name; });
}

}  // namespace elastolab
