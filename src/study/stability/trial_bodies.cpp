#include "study/stability/trial_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <map>
#include <random>

#include "elasticity/exact_fields.hpp"
#include "elasticity/rigid_motion.hpp"
#include "mesh/primitives.hpp"
#include "study/error/exact_reactions.hpp"
#include "study/error/loaded_problems.hpp"
#include "study/setups.hpp"

namespace elastolab::trial {

namespace {

constexpr double kOnBoundary = 1e-9;
const Material kMaterial{1.0, 0.3};

/// Uniform in [-1, 1], the same on every machine.
double random_number(std::mt19937& random) {
    return 2.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1.0;
}

bool at_end(const Eigen::Vector3d& x, double length) { return x[0] < kOnBoundary || x[0] > length - kOnBoundary; }

template <class Field>
Problem ends_prescribed(SurfaceMesh mesh, const Field& field, double length) {
    Problem problem;
    problem.truth = displacements(field, mesh.vertices);
    problem.constrained = vertices_where(mesh, [=](const auto& x) { return at_end(x, length); });
    problem.reactions =
        exact_reactions(mesh, problem.constrained, [&](const Eigen::Vector3d& x) { return field.stress(x); });
    problem.body = study_body(std::move(mesh), field.material, "body on trial");
    return problem;
}

}  // namespace

Problem bending_bar(double nu) { return ends_prescribed(make_box(4, {2, 1, 1}), PureBending{{1.0, nu}, 1.0}, 2.0); }

Problem plate(double thickness) {
    SurfaceMesh mesh = make_box(1, {8, 8, 1});
    mesh.vertices = Eigen::Vector3d(0.125, 0.125, thickness).asDiagonal() * mesh.vertices;
    return ends_prescribed(std::move(mesh), PureBending{kMaterial, 1.0}, 1.0);
}

Problem needle(double thickness) {
    SurfaceMesh mesh = make_box(1, {8, 1, 1});
    mesh.vertices = Eigen::Vector3d(0.125, thickness, thickness).asDiagonal() * mesh.vertices;
    return ends_prescribed(std::move(mesh), PureBending{kMaterial, 1.0}, 1.0);
}

Problem long_bar(double length) {
    return ends_prescribed(make_box(2, {length, 1, 1}), PureBending{kMaterial, 1.0 / length}, length);
}

Problem slivers(double altitude) {
    constexpr int kCells = 5;
    SurfaceMesh mesh = make_box(kCells);
    int pushed = 0;
    for (auto x : mesh.vertices.colwise()) {
        int inside = 0, axis = -1;
        for (int i = 0; i < 3; ++i)
            if (x[i] > kOnBoundary && x[i] < 1.0 - kOnBoundary) {
                ++inside;
                axis = i;
            }
        // Every third inner vertex of a face goes towards the row of vertices beside it.
        if (inside == 2 && pushed++ % 3 == 0) x[axis] -= (1.0 - altitude) / kCells;
    }
    return ends_prescribed(std::move(mesh), UniaxialStretch{kMaterial, 1.0}, 1.0);
}

Problem irregular(double jitter) {
    constexpr int kCells = 5;
    const Eigen::Vector3d size(2, 1, 1);
    SurfaceMesh mesh = make_box(kCells, size);
    std::mt19937 random(5);
    for (auto x : mesh.vertices.colwise())
        for (int i = 0; i < 3; ++i)
            if (x[i] > kOnBoundary && x[i] < size[i] - kOnBoundary) x[i] += jitter / kCells * random_number(random);
    return ends_prescribed(std::move(mesh), PureBending{kMaterial, 1.0}, 2.0);
}

Problem graded(double halvings) {
    constexpr int kCells = 4;
    const int n = static_cast<int>(halvings);
    SurfaceMesh mesh = make_box(kCells + n);
    const auto place = [&](double x) {
        const auto line = static_cast<int>(std::lround(x * (kCells + n)));  // the first n + 1 cells share one cell
        if (line == 0) return 0.0;
        return line > n ? static_cast<double>(line - n) / kCells : std::ldexp(1.0 / kCells, line - n - 1);
    };
    for (double& x : mesh.vertices.reshaped()) x = place(x);
    return ends_prescribed(std::move(mesh), PureBending{kMaterial, 1.0}, 1.0);
}

Problem scaled(double scale) {
    Problem problem = bending_bar(0.3);
    SurfaceMesh mesh = *problem.body.surface;
    mesh.vertices *= scale;
    problem.truth *= scale;
    problem.reactions->forces *= scale * scale;  // the strain stays
    problem.reactions->moments *= scale * scale * scale;
    problem.body = study_body(std::move(mesh), kMaterial, problem.body.name);
    return problem;
}

Problem far_away(double distance) {
    SurfaceMesh mesh = make_box(4, {2, 1, 1});
    const Eigen::Vector3d offset = distance * Eigen::Vector3d(1.0, -0.7, 0.4);
    mesh.vertices.colwise() += offset;
    SurfaceMesh near = mesh;
    near.vertices.colwise() -= offset;
    Problem problem;
    problem.truth = displacements(PureBending{kMaterial, 1.0}, near.vertices);
    problem.constrained = vertices_where(near, [](const auto& x) { return x[0] < 0.1 || x[0] > 1.9; });
    problem.body = study_body(std::move(mesh), kMaterial, "body on trial");
    return problem;
}

Problem close_handles(double distance) {
    constexpr int kCells = 4;
    Problem problem = ends_prescribed(make_box(kCells), UniaxialStretch{kMaterial, 1.0}, 1.0);
    SurfaceMesh mesh = *problem.body.surface;
    const auto nearest = [&](const Eigen::Vector3d& place) {
        Eigen::Index v = 0;
        (mesh.vertices.colwise() - place).colwise().squaredNorm().minCoeff(&v);
        return static_cast<int>(v);
    };
    const int a = nearest({0.25, 0.5, 1.0}), b = nearest({0.5, 0.5, 1.0});
    mesh.vertices.col(b) = mesh.vertices.col(a) + Eigen::Vector3d(distance, 0, 0);
    problem.truth = displacements(UniaxialStretch{kMaterial, 1.0}, mesh.vertices);
    problem.constrained.insert(problem.constrained.end(), {a, b});
    problem.reactions = exact_reactions(mesh, problem.constrained, [](const Eigen::Vector3d& x) {
        return UniaxialStretch{kMaterial, 1.0}.stress(x);
    });
    problem.body = study_body(std::move(mesh), kMaterial, "body on trial");
    return problem;
}

Problem barely_held(double distance) {
    SurfaceMesh mesh = make_box(4);
    const auto nearest = [&](const Eigen::Vector3d& place) {
        Eigen::Index v = 0;
        (mesh.vertices.colwise() - place).colwise().squaredNorm().minCoeff(&v);
        return static_cast<int>(v);
    };
    const std::vector<int> held = {nearest({0.25, 0.5, 1.0}), nearest({0.75, 0.5, 1.0}), nearest({0.5, 0.75, 1.0})};
    mesh.vertices.col(held[2]) = Eigen::Vector3d(0.5, 0.5 + distance, 1.0);
    mesh.vertices.col(nearest({0.5, 0.5, 1.0})) = Eigen::Vector3d(0.5, 0.375, 1.0);
    Problem problem;
    problem.truth = rigid_motion(mesh.vertices, {0.1, 0.0, 0.2}, {0.3, -0.2, 0.5});
    problem.constrained = held;
    problem.body = study_body(std::move(mesh), kMaterial, "body on trial");
    return problem;
}

Problem few_held(double n) {
    const SurfaceMesh mesh = make_box(4);
    const std::vector<Eigen::Vector3d> places = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Problem problem;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        Eigen::Index v = 0;
        (mesh.vertices.colwise() - places[i]).colwise().squaredNorm().minCoeff(&v);
        problem.constrained.push_back(static_cast<int>(v));
    }
    problem.truth = rigid_motion(mesh.vertices, {0.1, 0.0, 0.2}, {0.3, -0.2, 0.5});
    problem.body = study_body(mesh, kMaterial, "body on trial");
    return problem;
}

Problem share(double part) {
    Problem problem = bending_bar(0.3);
    const int n = problem.body.surface->n_vertices();
    for (const int v : choose_numbers(n, static_cast<int>(part * n), 3))
        if (std::find(problem.constrained.begin(), problem.constrained.end(), v) == problem.constrained.end())
            problem.constrained.push_back(v);
    if (problem.reactions) {  // those at the random ones are none: they are held where they would be by themselves
        const auto widen = [&](Eigen::Matrix3Xd& columns) {
            const Eigen::Index before = columns.cols();
            columns.conservativeResize(3, std::ssize(problem.constrained));
            columns.rightCols(columns.cols() - before).setZero();
        };
        widen(problem.reactions->forces);
        widen(problem.reactions->moments);
    }
    return problem;
}

namespace {

void append(SurfaceMesh& mesh, const SurfaceMesh& other) {
    SurfaceMesh sum;
    sum.vertices.resize(3, mesh.vertices.cols() + other.vertices.cols());
    sum.vertices << mesh.vertices, other.vertices;
    sum.triangles.resize(3, mesh.triangles.cols() + other.triangles.cols());
    sum.triangles << mesh.triangles, (other.triangles.array() + mesh.n_vertices()).matrix();
    mesh = std::move(sum);
}

}  // namespace

Problem two_bodies(double gap) {
    SurfaceMesh mesh = make_box(4), other = make_box(4);
    other.vertices.colwise() += Eigen::Vector3d(0.1, 1.0 + gap, 0.05);
    append(mesh, other);
    Problem problem;
    problem.truth.resize(3 * mesh.n_vertices());
    const UniaxialStretch field{kMaterial, 1.0};
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        Eigen::Vector3d x = mesh.vertices.col(v);
        if (2 * v >= mesh.n_vertices()) x -= Eigen::Vector3d(0.1, 1.0 + gap, 0.05);
        problem.truth.segment<3>(3 * v) = field.displacement(x);
        if (at_end(x, 1.0)) problem.constrained.push_back(v);
    }
    problem.body = study_body(std::move(mesh), kMaterial, "body on trial");
    return problem;
}

Problem nested(double radius) {
    SurfaceMesh mesh = make_hollow_sphere(4);
    const int n_shell = mesh.n_vertices();
    append(mesh, make_sphere(3, radius));
    Problem problem;
    problem.truth = Eigen::VectorXd::Zero(3 * mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        const bool in_shell = v < n_shell;
        problem.truth.segment<3>(3 * v) = in_shell ? Eigen::Vector3d(0.1, 0, 0) : Eigen::Vector3d(0, 0.2, 0);
        if (mesh.vertices(0, v) < (in_shell ? -0.5 : -0.5 * radius)) problem.constrained.push_back(v);
    }
    problem.body = study_body(std::move(mesh), kMaterial, "body on trial");
    return problem;
}

Problem large_values(double factor) {
    Problem problem = bending_bar(0.3);
    problem.truth *= factor;
    problem.reactions->forces *= factor;
    problem.reactions->moments *= factor;
    return problem;
}

Problem stiff(double young_modulus) {
    Problem problem = bending_bar(0.3);
    const double factor = young_modulus / problem.body.material.young_modulus;
    problem.reactions->forces *= factor;
    problem.reactions->moments *= factor;
    problem.body.material.young_modulus = young_modulus;
    return problem;
}

Problem weight(double factor) {
    Problem problem = hanging_bar(4, 0.3);
    problem.factors *= factor;
    problem.truth *= factor;
    problem.reactions->forces *= factor;
    problem.reactions->moments *= factor;
    return problem;
}

Problem pressed_wall(double thickness) { return pressed_sphere(5, 0.3, 1.0 - thickness); }

}  // namespace elastolab::trial
