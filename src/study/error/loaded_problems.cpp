#include "study/error/loaded_problems.hpp"

#include <cmath>

#include "elasticity/exact_fields.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "study/error/exact_reactions.hpp"
#include "study/error/organic_truth.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

constexpr double kAtEnd = 1e-9;

/// Hanging along z from z = 1; weight: force per volume, downwards.
struct HangingField {
    Material material;
    double weight = 1.0;

    Eigen::Vector3d displacement(const Eigen::Vector3d& at) const {
        const double x = at.x() - 0.5, y = at.y() - 0.5, z = at.z(), nu = material.poisson_ratio;
        return weight / material.young_modulus *
               Eigen::Vector3d(-nu * x * z, -nu * y * z, 0.5 * (z * z + nu * (x * x + y * y) - 1.0));
    }
    Eigen::Matrix3d stress(const Eigen::Vector3d& at) const {
        return Eigen::Vector3d(0.0, 0.0, weight * at.z()).asDiagonal();
    }
};

/// A stretch along x by 1 under a unit pressure across.
struct PressedField {
    Material material;

    Eigen::Vector3d displacement(const Eigen::Vector3d& at) const {
        const double along = 1.0 + 2.0 * material.poisson_ratio, across = -1.0;
        return Eigen::Vector3d(along * at.x(), across * at.y(), across * at.z()) / material.young_modulus;
    }
    Eigen::Matrix3d stress(const Eigen::Vector3d&) const { return Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal(); }
};

std::vector<int> triangles_inside(const SurfaceMesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& wanted) {
    std::vector<int> triangles;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (wanted(centroid(mesh, t))) triangles.push_back(t);
    return triangles;
}

template <class Field, class Predicate>
Problem exact_loaded(SurfaceMesh mesh, const Field& field, std::vector<UnitLoad> loads, Eigen::VectorXd factors,
                     const Predicate& constrained) {
    Problem problem;
    problem.truth = displacements(field, mesh.vertices);
    problem.constrained = vertices_where(mesh, constrained);
    if (!problem.constrained.empty())
        problem.reactions =
            exact_reactions(mesh, problem.constrained, [&](const Eigen::Vector3d& x) { return field.stress(x); });
    problem.loads = std::move(loads);
    problem.factors = std::move(factors);
    problem.body = study_body(std::move(mesh), field.material, "loaded body");
    return problem;
}

}  // namespace

Problem hanging_bar(int cells, double poisson_ratio, double weight) {
    return exact_loaded(make_box(cells), HangingField{{1.0, poisson_ratio}, weight}, {body_force_along(2)},
                        Eigen::VectorXd::Constant(1, -weight), [](const auto& x) { return x.z() > 1.0 - kAtEnd; });
}

Problem pressed_sphere(int cells, double poisson_ratio, double inner_radius) {
    HollowSphereField field{.material = {1.0, poisson_ratio}, .inner_radius = inner_radius};
    const Eigen::Vector3d inside = inner_radius * Eigen::Vector3d::UnitX();
    field.inner_displacement = -1.0 / field.stress(inside)(0, 0);  // linear in it
    SurfaceMesh mesh = make_hollow_sphere(cells, 1.0, inner_radius);
    std::vector<int> inner;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (mesh.vertices.col(mesh.triangles(0, t)).norm() < 0.5 * (1.0 + inner_radius)) inner.push_back(t);
    UnitLoad pressure = unit_pressure(mesh, inner);
    return exact_loaded(std::move(mesh), field, {std::move(pressure)}, Eigen::VectorXd::Ones(1),
                        [](const auto&) { return false; });
}

Problem pressed_bar(int cells, double poisson_ratio) {
    SurfaceMesh mesh = make_box(cells, {2.0, 1.0, 1.0});
    UnitLoad pressure = unit_pressure(
        mesh, triangles_inside(mesh, [](const auto& x) { return x.x() > kAtEnd && x.x() < 2.0 - kAtEnd; }));
    return exact_loaded(std::move(mesh), PressedField{{1.0, poisson_ratio}}, {std::move(pressure)},
                        Eigen::VectorXd::Ones(1), [](const auto& x) { return x.x() < kAtEnd || x.x() > 2.0 - kAtEnd; });
}

Problem cantilever(int cells, double poisson_ratio, double length) {
    SurfaceMesh mesh = make_box(cells, {length, 1.0, 1.0});
    Problem problem;
    problem.constrained = vertices_where(mesh, [](const auto& x) { return x.x() < kAtEnd; });
    problem.loads = {body_force_along(2)};
    problem.factors = Eigen::VectorXd::Constant(1, -1.0);
    const Material material{1.0, poisson_ratio};
    const OrganicTruth truth =
        compute_truth(mesh, problem.constrained, Positions::Zero(3, std::ssize(problem.constrained)), material, {1},
                      {problem.loads, problem.factors});
    problem.truth = truth.displacements.reshaped();
    problem.truth_error = truth.relative_error;
    problem.reactions = truth.reactions;
    problem.truth_force_error = truth.relative_force_error;
    problem.body = study_body(std::move(mesh), material, "cantilever");
    return problem;
}

}  // namespace elastolab
