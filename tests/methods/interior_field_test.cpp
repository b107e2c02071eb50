#include "deform/interior_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "elasticity/exact_fields.hpp"
#include "elasticity/rigid_motion.hpp"
#include "elasticity/stress.hpp"
#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"

namespace elastolab::test {
namespace {

constexpr double kNu = 0.3;
const Material kMaterial{2.0, kNu};

/// An exact field on a body whose constrained vertices follow it.
struct Problem {
    std::string name;
    std::function<SurfaceMesh(int cells)> mesh;
    std::function<bool(const Eigen::Vector3d&)> constrained;
    std::function<Eigen::Vector3d(const Eigen::Vector3d&)> displacement;
    std::function<Eigen::Matrix3d(const Eigen::Vector3d&)> stress;
    Positions deep;    ///< points inside, far from the surface in edges
    Positions spread;  ///< points almost up to the surface
};

template <class Field>
Problem problem(std::string name, Field field, std::function<SurfaceMesh(int)> mesh,
                std::function<bool(const Eigen::Vector3d&)> constrained, Positions deep, Positions spread) {
    return {std::move(name),
            std::move(mesh),
            std::move(constrained),
            [field](const Eigen::Vector3d& x) { return field.displacement(x); },
            [field](const Eigen::Vector3d& x) { return field.stress(x); },
            std::move(deep),
            std::move(spread)};
}

/// A few points in a box, the same for every mesh and on no plane of its cells.
Positions scattered(const Eigen::Vector3d& low, const Eigen::Vector3d& high, int n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    Positions points(3, n);
    for (auto x : points.colwise())
        for (int axis = 0; axis < 3; ++axis) x[axis] = low[axis] + share(random) * (high[axis] - low[axis]);
    return points;
}

Problem bending() {
    return problem(
        "bending", PureBending{kMaterial},
        [](int cells) {
            return make_box(cells, {2.0, 1.0, 1.0});
        },
        [](const Eigen::Vector3d& x) { return x[0] < kEdge || x[0] > 2.0 - kEdge; },
        scattered({0.6, 0.3, 0.3}, {1.4, 0.7, 0.7}, 40), scattered({0.1, 0.1, 0.1}, {1.9, 0.9, 0.9}, 400));
}

Problem torsion() {
    return problem(
        "torsion", Torsion{kMaterial}, [](int cells) { return make_cylinder(cells); },
        [](const Eigen::Vector3d& x) { return std::fabs(x[2]) > 1.0 - kEdge; },
        scattered({-0.2, -0.2, -0.6}, {0.2, 0.2, 0.6}, 40), scattered({-0.3, -0.3, -0.9}, {0.3, 0.3, 0.9}, 400));
}

Problem hollow_sphere() {
    HollowSphereField field;
    field.material = kMaterial;
    const Positions shell = scattered({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}, 400).colwise().normalized();
    Positions spread = shell;
    for (Eigen::Index i = 0; i < spread.cols(); ++i) spread.col(i) *= 0.6 + 0.3 * static_cast<double>(i) / 400.0;
    return problem(
        "hollow sphere", field, [](int cells) { return make_hollow_sphere(cells); },
        [](const Eigen::Vector3d& x) { return x.norm() < 0.75; }, 0.75 * shell.leftCols(40), spread);
}

struct FieldErrors {
    double displacement, stress;  ///< relative, L2 over the points
    double worst_stress;          ///< over the largest of them
};

std::shared_ptr<const InteriorField> field_inside(const Problem& problem, const SurfaceMesh& mesh,
                                                  const Method& method) {
    Control control;
    Deformer deformer(precomputed(make_body(mesh, kMaterial), method));
    const std::vector<int> constrained = vertices_where(mesh, problem.constrained);
    deformer.constrain({{}, constrained}, control);
    Eigen::VectorXd values(3 * std::ssize(constrained));
    for (std::size_t i = 0; i < constrained.size(); ++i)
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) = problem.displacement(mesh.vertices.col(constrained[i]));
    return deformer.interior_field(values, control);
}

InteriorValues solved_inside(const Problem& problem, const SurfaceMesh& mesh, const Method& method,
                             const Positions& points) {
    Control control;
    return field_inside(problem, mesh, method)->at(points, control);
}

FieldErrors errors_of(const Problem& problem, const InteriorValues& values, const Positions& points) {
    FieldErrors errors{0.0, 0.0, 0.0};
    double u_size = 0.0, s_size = 0.0, s_largest = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
        const Eigen::Vector3d u = problem.displacement(points.col(i));
        const StressNumbers s = stress_numbers(problem.stress(points.col(i)));
        const double off = (values.stresses.col(0).segment<6>(6 * i) - s).norm();
        errors.displacement += (values.displacements.col(0).segment<3>(3 * i) - u).squaredNorm();
        errors.stress += off * off;
        errors.worst_stress = std::max(errors.worst_stress, off);
        u_size += u.squaredNorm();
        s_size += s.squaredNorm();
        s_largest = std::max(s_largest, s.norm());
    }
    return {std::sqrt(errors.displacement / u_size), std::sqrt(errors.stress / s_size),
            errors.worst_stress / s_largest};
}

/// Points this far below triangles, in their longest edges: below their middles, edges and corners by turns.
Positions below_surface(const SurfaceMesh& mesh, double depth) {
    std::vector<Eigen::Vector3d> points;
    for (int t = 0; t < mesh.n_triangles(); t += 5) {
        const TrianglePoints p = triangle_points(mesh, t);
        const double edge = std::max({(p.a - p.b).norm(), (p.b - p.c).norm(), (p.c - p.a).norm()});
        const double s = t % 3 == 0 ? 0.33 : t % 3 == 1 ? 0.5 : 0.98, r = t % 3 == 0 ? 0.33 : 0.01;
        const Eigen::Vector3d x = s * p.a + (1.0 - s - r) * p.b + r * p.c;
        points.push_back(x - depth * edge * area_vector(p).normalized());
    }
    Positions all(3, std::ssize(points));
    for (std::size_t i = 0; i < points.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = points[i];
    return all;
}

FieldErrors errors_on(const Problem& problem, MethodKind kind, int cells) {
    // Tetrahedra are coarser far from the surface than near it: all of them tell the order.
    const Positions& points = kind->has_inside ? problem.spread : problem.deep;
    return errors_of(
        problem, solved_inside(problem, problem.mesh(cells), {.kind = kind, .update = Update::direct}, points), points);
}

/// Of displacements and stresses away from the surface, when cells are divided by `factor`.
void expect_orders(const std::vector<Problem>& problems, MethodKind kind, int cells, int factor, double of_displacement,
                   double of_stress) {
    for (const Problem& p : problems) {
        const FieldErrors coarse = errors_on(p, kind, cells), fine = errors_on(p, kind, factor * cells);
        const std::string what = p.name + ", " + std::string(name(kind)) + ", inside";
        const auto order = [&](double a, double b) { return std::log(a / b) / std::log(factor); };
        print_measured(what + ", relative L2 error of stress", fine.stress);
        print_measured(what + ", observed order of displacement", order(coarse.displacement, fine.displacement));
        print_measured(what + ", observed order of stress", order(coarse.stress, fine.stress));
        EXPECT_GT(order(coarse.displacement, fine.displacement), of_displacement) << what;
        EXPECT_GT(order(coarse.stress, fine.stress), of_stress) << what;
    }
}

TEST(InteriorField, OfLinearBoundaryElementsConvergesWithSecondOrder) {
    const std::vector<Problem> all = {bending(), torsion(), hollow_sphere()};
    // Of displacements in bending it rises slowly to 2, as on the surface.
    expect_orders(all, kLinearBem, 3, 2, 0.8 * 2.0, 0.9 * 2.0);
    expect_orders(all, kGalerkinBem, 3, 2, 0.9 * 2.0, 0.9 * 2.0);
}

TEST(InteriorField, OfConstantBoundaryElementsConvergesWithFirstOrder) {
    expect_orders({bending(), torsion(), hollow_sphere()}, kConstantBem, 3, 2, 1.0, 1.0);
}

TEST(InteriorField, OfFemConvergesWithItsElements) {
    expect_orders({bending(), torsion()}, kFem, 3, 2, 0.9, 0.9);
    expect_orders({bending(), torsion()}, kQuadraticFem, 3, 2, 1.5, 1.5);
    // Tetrahedra do not halve as evenly as triangles do. The facets of a sphere are what is left with quadratic ones.
    expect_orders({hollow_sphere()}, kFem, 4, 2, 0.9, 0.9);
    expect_orders({hollow_sphere()}, kQuadraticFem, 4, 2, 1.5, 1.5);
}

TEST(InteriorField, OfBoundaryElementsDoesNotBlowUpTowardsTheSurface) {
    Control control;
    for (const Problem& p : {bending(), hollow_sphere()})
        for (const MethodKind kind : {kLinearBem, kGalerkinBem}) {
            const SurfaceMesh mesh = p.mesh(5);
            const auto field = field_inside(p, mesh, {.kind = kind, .update = Update::direct});
            std::vector<FieldErrors> errors;
            for (const double depth : {0.3, 0.1, 0.02, 0.0}) {
                const Positions near = below_surface(mesh, depth);
                errors.push_back(errors_of(p, field->at(near, control), near));
                print_measured(p.name + ", " + std::string(name(kind)) + ", at " + std::to_string(depth) +
                                   " of an edge, worst stress error",
                               errors.back().worst_stress);
            }
            // Jumps of the tangential strain and of tractions over edges: a logarithm of the distance.
            EXPECT_LT(errors[1].stress, 2.5 * errors[0].stress) << p.name << " " << name(kind);
            for (std::size_t i = 2; i < errors.size(); ++i) {
                EXPECT_LT(errors[i].stress, 2.0 * errors[1].stress) << p.name << " " << name(kind);
                EXPECT_LT(errors[i].displacement, 2.0 * errors[0].displacement) << p.name << " " << name(kind);
            }
        }
}

/// Linear fields are in every space: what is left is the tolerance of the rules far from a point.
TEST(InteriorField, IsExactForLinearFieldsUpToTheSurface) {
    const SurfaceMesh mesh = make_box(3, {2.0, 1.0, 1.0});
    const UniaxialStretch stretch{kMaterial, 0.7};
    const Problem p = problem(
        "stretch", stretch, [&](int) { return mesh; },
        [](const Eigen::Vector3d& x) { return x[0] < kEdge || x[0] > 2.0 - kEdge; }, {}, {});
    Control control;
    for (const MethodKind kind : {kFem, kQuadraticFem, kLinearBem, kGalerkinBem}) {
        const auto field = field_inside(p, mesh, make_method(kind));
        for (const double depth : {0.5, 0.1, 0.0}) {
            const Positions points = below_surface(mesh, depth);
            const FieldErrors e = errors_of(p, field->at(points, control), points);
            EXPECT_LT(e.displacement, 1e-6) << name(kind) << " " << depth;
            EXPECT_LT(e.worst_stress, 2e-5) << name(kind) << " " << depth;
        }
    }
}

/// Points that are farther away than a product of numbers reaches.
TEST(InteriorField, EndsForPointsOutOfReach) {
    const SurfaceMesh mesh = make_box(2);
    const UniaxialStretch stretch{kMaterial, 0.7};
    const Problem p = problem(
        "stretch", stretch, [&](int) { return mesh; }, [](const Eigen::Vector3d& x) { return x[0] < kEdge; }, {}, {});
    Positions far(3, 4);
    far << 1e308, 0, -1e300, 1e154, 0, 1e308, 1e300, 0, 0, 0, 1e300, -1e154;
    Control control;
    for (const MethodKind kind : {kFem, kQuadraticFem})
        EXPECT_EQ(field_inside(p, mesh, make_method(kind))->at(far, control).displacements.rows(), far.size())
            << name(kind);
}

/// Two solids, far from the origin and in another unit of length, of which only the second is pulled.
TEST(InteriorField, FollowsEachSolidByItself) {
    const SurfaceMesh one = make_box(2);
    SurfaceMesh both{Positions(3, 2 * one.n_vertices()), Triangles(3, 2 * one.n_triangles())};
    const double unit = 1000.0;
    const Eigen::Vector3d place(1e5, -2e5, 3e4), gap(2.0, 0.0, 0.0);
    both.vertices << (unit * one.vertices).colwise() + place, (unit * (one.vertices.colwise() + gap)).colwise() + place;
    both.triangles << one.triangles, one.triangles.array() + one.n_vertices();
    const auto ends = vertices_where(both, [&](const Eigen::Vector3d& x) {
        const double along = (x - place)[0] / unit;
        return std::fabs(along - 2.0) < kEdge || std::fabs(along - 3.0) < kEdge;
    });
    const UniaxialStretch stretch{kMaterial, 0.01};
    Eigen::VectorXd values(3 * std::ssize(ends));
    for (std::size_t i = 0; i < ends.size(); ++i)
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) =
            stretch.displacement(both.vertices.col(ends[i]) - place - unit * gap);
    Positions points(3, 2);
    points.col(0) = place + unit * Eigen::Vector3d(0.5, 0.4, 0.6);
    points.col(1) = place + unit * Eigen::Vector3d(2.4, 0.4, 0.6);
    for (const MethodKind kind : {kFem, kLinearBem, kGalerkinBem}) {
        Control control;
        Deformer deformer(precomputed(make_body(both, kMaterial), make_method(kind)));
        deformer.constrain({{}, ends}, control);
        const InteriorValues inside = deformer.interior_field(values, control)->at(points, control);
        EXPECT_EQ(inside.displacements.topRows(3).norm(), 0.0);
        EXPECT_EQ(inside.stresses.topRows(6).norm(), 0.0);
        const Eigen::Vector3d u = stretch.displacement(points.col(1) - place - unit * gap);
        EXPECT_LT((inside.displacements.bottomRows(3) - u).norm(), 1e-5 * u.norm()) << name(kind);
        EXPECT_LT((inside.stresses.bottomRows(6) - stress_numbers(stretch.stress(u))).norm(), 2e-5 * 0.02)
            << name(kind);
    }
}

TEST(InteriorField, IsTheSameInEveryModeOfFem) {
    const Problem p = bending();
    const SurfaceMesh mesh = p.mesh(3);
    const InteriorValues first = solved_inside(p, mesh, make_method(kFem), p.deep);
    for (const Mode mode : {Mode::on_demand, Mode::full, Mode::full_volume})
        for (const Update update : {Update::direct, Update::reduced}) {
            const Method method = make_method(kFem, Tractions::discontinuous, mode, update);
            const InteriorValues values = solved_inside(p, mesh, method, p.deep);
            EXPECT_LT((values.stresses - first.stresses).norm(), 1e-9 * first.stresses.norm()) << describe(method);
            EXPECT_LT((values.displacements - first.displacements).norm(), 1e-9 * first.displacements.norm());
        }
}

}  // namespace
}  // namespace elastolab::test
