#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/QR>
#include <functional>
#include <numeric>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "elasticity/exact_fields.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

std::vector<int> triangles_where(const SurfaceMesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& inside) {
    std::vector<int> triangles;
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const TrianglePoints p = triangle_points(mesh, t);
        if (inside(p.a) && inside(p.b) && inside(p.c)) triangles.push_back(t);
    }
    return triangles;
}

std::vector<int> all_triangles(const SurfaceMesh& mesh) {
    return triangles_where(mesh, [](const auto&) { return true; });
}

/// The larger of both, relative.
double relative_difference(const Eigen::VectorXd& u, const Eigen::VectorXd& exact) {
    return (u - exact).norm() / exact.norm();
}

/// Without the rigid motion that fits it best.
Eigen::VectorXd deformation(const SurfaceMesh& mesh, const Eigen::VectorXd& u) {
    const Eigen::MatrixXd modes = rigid_modes(mesh.vertices);
    return u - modes * (modes.transpose() * u);
}

/// What Galerkin BEM's integrals allow where other methods are exact.
double allowed_error(const Method& method, double of_the_others) {
    return method.kind == kGalerkinBem ? std::max(of_the_others, 10.0 * method.kind->integral_tolerance)
                                       : of_the_others;
}

/// Methods whose elements contain linear fields.
std::vector<Method> exact_methods() {
    std::vector<Method> methods = method_variants();
    std::erase_if(methods, [](const Method& method) {
        return method.kind == kConstantBem ||
               (method.kind == kLinearBem && method.tractions == Tractions::continuous) || !method.kind->linear;
    });
    return methods;
}

std::vector<Method> all_linear(Mode mode = Mode::on_demand, Update update = Update::reduced) {
    std::vector<Method> methods = method_variants(mode, update);
    std::erase_if(methods, [](const Method& method) { return !method.kind->linear; });
    return methods;
}

/// A bar along z, [0, 1]^2 x [0, 1], held at its top against its weight (Timoshenko and Goodier, section 100), free at
/// its sides and at the bottom. weight: density times gravity, which points down.
struct HangingBar {
    Material material;
    double weight = 1.0, length = 1.0;

    Eigen::Vector3d displacement(const Eigen::Vector3d& at) const {
        const double x = at.x() - 0.5, y = at.y() - 0.5, z = at.z(), nu = material.poisson_ratio;
        return weight / material.young_modulus *
               Eigen::Vector3d(-nu * x * z, -nu * y * z, 0.5 * (z * z + nu * (x * x + y * y) - length * length));
    }
};

/// A body with a fixed patch, one that is moved, weight, pressure on a patch and a force on another.
struct Loaded {
    Body body;
    ConstrainedSet set;
    Eigen::VectorXd values;
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;  ///< of the loads

    explicit Loaded(SurfaceMesh mesh, const Material& material = {3.0, 0.3})
        : body(make_body(std::move(mesh), material)) {
        const SurfaceMesh& surface = *body.surface;
        const Eigen::Vector3d low = surface.vertices.rowwise().minCoeff(), high = surface.vertices.rowwise().maxCoeff();
        const Eigen::Vector3d size = high - low;
        const auto height = [=](const Eigen::Vector3d& x) { return (x.z() - low.z()) / size.z(); };
        const auto across = [=](const Eigen::Vector3d& x) { return (x.x() - low.x()) / size.x(); };
        set.fixed = vertices_where(surface, [&](const auto& x) { return height(x) < 0.2; });
        set.handles = vertices_where(surface, [&](const auto& x) { return height(x) > 0.85; });
        const auto between = [&](const Eigen::Vector3d& x) { return height(x) > 0.25 && height(x) < 0.8; };
        set.loads = {
            body_force_along(0), body_force_along(1), body_force_along(2),
            unit_pressure(surface,
                          triangles_where(surface, [&](const auto& x) { return between(x) && across(x) < 0.55; })),
            unit_force(surface, triangles_where(surface, [&](const auto& x) { return between(x) && across(x) > 0.45; }),
                       {0.3, -0.2, 0.9})};
        for (const UnitLoad& load : {set.loads[3], set.loads[4]}) EXPECT_FALSE(load.triangles.empty());
        values.resize(set.n_values());
        for (Eigen::Index i = 0; i < values.size(); ++i)
            values[i] = 0.05 * size.norm() * std::sin(1.0 + 0.01 * static_cast<double>(i));
        values.tail<5>() << 0.2, -0.1, -0.4, 0.15, 0.05;
        for (std::size_t i = 0; i < set.loads.size(); ++i) {
            const Resultant sum = resultant(surface, set.loads[i]);
            const double factor = values[3 * std::ssize(set.handles) + static_cast<Eigen::Index>(i)];
            force += factor * sum.force;
            moment += factor * sum.moment;
        }
    }
    Deformer constrained(const Method& method) const {
        Control control;
        Deformer deformer(precomputed(body, method));
        deformer.constrain(set, control);
        return deformer;
    }
};

TEST(Loads, ATractionThatStretchesABarUniformlyIsReproducedWhereElementsContainLinearFields) {
    const SurfaceMesh mesh = make_box(4, {1.0, 1.0, 1.5});
    for (const double nu : {0.0, 0.3, 0.45}) {
        const Material material{2.0, nu};
        const UniaxialStretch stretch{material, 0.1};
        const Eigen::VectorXd exact = exact_displacements(mesh, stretch);
        const auto end = vertices_where(mesh, [](const auto& x) { return x[0] < kEdge; });
        const auto other = triangles_where(mesh, [](const auto& x) { return x[0] > 1.0 - kEdge; });
        for (const Method& method : exact_methods()) {
            ConstrainedSet set{{}, end, {unit_traction(other, Eigen::Vector3d::UnitX())}};
            Eigen::VectorXd values(set.n_values());
            values << at(exact, end), 0.1 * material.young_modulus;
            EXPECT_LT(
                relative_difference(displaced(precomputed(make_body(mesh, material), method), set, values), exact),
                allowed_error(method, 1e-11))
                << describe(method) << ", nu " << nu;
        }
    }
}

TEST(Loads, PressureAllAroundShrinksABodyWithoutSupports) {
    const SurfaceMesh mesh = make_box(3);
    for (const double nu : {0.3, 0.5})
        for (const Method& method : exact_methods()) {
            if (nu == 0.5 && !method.kind->takes_incompressible) continue;
            const Material material{4.0, nu};
            const ConstrainedSet set{{}, {}, {unit_pressure(mesh, all_triangles(mesh))}};
            const Eigen::VectorXd u =
                displaced(precomputed(make_body(mesh, material), method), set, Eigen::VectorXd::Constant(1, 0.2));
            const Eigen::VectorXd exact = deformation(mesh, -0.2 * (1.0 - 2.0 * nu) / 4.0 * mesh.vertices.reshaped());
            EXPECT_LT((deformation(mesh, u) - exact).norm(), allowed_error(method, 1e-11) * mesh.vertices.norm())
                << describe(method) << ", nu " << nu;
            EXPECT_LT((deformation(mesh, u) - u).norm(), 1e-9 * mesh.vertices.norm()) << describe(method);
        }
}

TEST(Loads, WeightThatATractionHoldsIsReproducedByQuadraticElements) {
    const SurfaceMesh mesh = make_box(2);
    const HangingBar bar{{2.0, 0.3}, 0.7};
    const auto top = triangles_where(mesh, [](const auto& x) { return x.z() > 1.0 - kEdge; });
    const ConstrainedSet set{{}, {}, {body_force_along(2), unit_traction(top, Eigen::Vector3d::UnitZ())}};
    const Eigen::VectorXd u = displaced(precomputed(make_body(mesh, bar.material), make_method(kQuadraticFem)), set,
                                        Eigen::Vector2d(-0.7, 0.7));
    const Eigen::VectorXd exact = deformation(mesh, exact_displacements(mesh, bar));
    EXPECT_LT(relative_difference(deformation(mesh, u), exact), 1e-11);
}

TEST(Loads, AHangingBarConvergesByEveryMethod) {
    for (const double nu : {0.3, 0.5})
        for (const Method& method : all_linear()) {
            if (nu == 0.5 && !method.kind->takes_incompressible) continue;
            const HangingBar bar{{2.0, nu}, 0.7};
            std::vector<double> errors;
            for (const int cells : {3, 6}) {
                const SurfaceMesh mesh = make_box(cells);
                const Eigen::VectorXd exact = exact_displacements(mesh, bar);
                ConstrainedSet set{
                    {}, vertices_where(mesh, [](const auto& x) { return x.z() > 1.0 - kEdge; }), {body_force_along(2)}};
                Eigen::VectorXd values(set.n_values());
                values << at(exact, set.handles), -bar.weight;
                errors.push_back(relative_difference(
                    displaced(precomputed(make_body(mesh, bar.material), method), set, values), exact));
            }
            print_measured("hanging bar, " + describe(method) + ", nu " + std::to_string(nu), errors.back());
            EXPECT_LT(errors.back(), method.kind == kConstantBem ? 0.09 : 0.02) << describe(method) << ", nu " << nu;
            EXPECT_LT(errors.back(), 0.7 * errors.front()) << describe(method) << ", nu " << nu;
        }
}

/// Of the coarse sphere below, whose wall one layer of tetrahedra spans.
double largest_error(MethodKind kind) {
    if (kind == kGalerkinBem) return 0.03;
    if (kind == kConstantBem) return 0.05;
    return kind == kFem ? 0.45 : 0.15;
}

TEST(Loads, AHollowSphereUnderInnerPressureWidensByEveryMethod) {
    const SurfaceMesh mesh = make_hollow_sphere(4);
    std::vector<int> inner;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        if (centroid(mesh, t).norm() < 0.75) inner.push_back(t);
    for (const double nu : {0.3, 0.5})
        for (const Method& method : all_linear()) {
            if (nu == 0.5 && !method.kind->takes_incompressible) continue;
            const ConstrainedSet set{{}, {}, {unit_pressure(mesh, inner)}};
            if (nu == 0.5 && method.kind != kGalerkinBem) {
                // The single layer of a pressure in a closed cavity vanishes: collocation cannot see it.
                EXPECT_THROW(displaced(precomputed(make_body(mesh, {1.0, nu}), method), set, Eigen::VectorXd::Ones(1)),
                             SolveError);
                continue;
            }
            const Eigen::VectorXd u =
                displaced(precomputed(make_body(mesh, {1.0, nu}), method), set, Eigen::VectorXd::Ones(1));
            // Lame: u_r = p a^3 / (E (b^3 - a^3)) [(1 - 2 nu) r + (1 + nu) b^3 / (2 r^2)]
            Eigen::VectorXd exact(u.size());
            for (int v = 0; v < mesh.n_vertices(); ++v) {
                const Eigen::Vector3d x = mesh.vertices.col(v);
                const double r = x.norm(), a3 = 0.125;
                exact.segment<3>(3 * v) = a3 / (1.0 - a3) * ((1.0 - 2.0 * nu) * r + 0.5 * (1.0 + nu) / (r * r)) * x / r;
            }
            const double error = relative_difference(deformation(mesh, u), deformation(mesh, exact));
            print_measured("hollow sphere, " + describe(method) + ", nu " + std::to_string(nu), error);
            EXPECT_LT(error, largest_error(method.kind)) << describe(method) << ", nu " << nu;
        }
}

TEST(Loads, BalanceTheReactionsOfFemAndGalerkin) {
    for (const SurfaceMesh& mesh : {make_box(4), make_rabbit(300).surface}) {
        const Loaded problem(mesh);
        for (const MethodKind kind : {kFem, kQuadraticFem, kGalerkinBem}) {
            const Reactions reactions = problem.constrained(make_method(kind)).reactions(problem.values);
            const Eigen::Vector3d force = reactions.forces.rowwise().sum(), moment = reactions.moments.rowwise().sum();
            EXPECT_LT((force + problem.force).norm(), 1e-8 * reactions.forces.norm()) << name(kind);
            EXPECT_LT((moment + problem.moment).norm(), 1e-8 * reactions.moments.norm()) << name(kind);
        }
    }
}

/// Of large deformations, about present positions: of a box away from the origin, so that scales and places matter.
TEST(Loads, BalanceTheReactionsOfNonlinearFem) {
    SurfaceMesh mesh = make_box(3, {2.0, 2.0, 5.0});
    mesh.vertices.colwise() += Eigen::Vector3d(30.0, -20.0, 10.0);
    const Loaded problem(mesh);
    Control control;
    const Deformer deformer = problem.constrained(make_method(kNonlinearFem));
    const Deformer::Answer answer = deformer.answer(problem.values, {.residual = true}, control);
    Resultant loads;
    for (const Resultant& load : answer.loads) {
        loads.force += load.force;
        loads.moment += load.moment;
    }
    const Reactions& reactions = answer.reactions;
    EXPECT_LT((reactions.forces.rowwise().sum() + loads.force).norm(), 1e-8 * reactions.forces.norm());
    EXPECT_LT((reactions.moments.rowwise().sum() + loads.moment).norm(), 1e-8 * reactions.moments.norm());
    EXPECT_LT(*answer.residual, 1e-8);
    // Weight and the total force are dead, the pressure is not.
    const Eigen::VectorXd factors = problem.values.tail<5>();
    for (const std::size_t i : {0u, 1u, 2u, 4u}) {
        const Eigen::Vector3d given =
            factors[static_cast<Eigen::Index>(i)] * resultant(*problem.body.surface, problem.set.loads[i]).force;
        EXPECT_LT((answer.loads[i].force - given).norm(), 1e-10 * given.norm()) << i;
    }
    EXPECT_GT(
        (answer.loads[3].force - factors[3] * resultant(*problem.body.surface, problem.set.loads[3]).force).norm(),
        0.01 * answer.loads[3].force.norm());
    EXPECT_NE(answer.facts->work_of_loads, 0.0);
}

TEST(Loads, SmallOnesDoTheSameByNonlinearFemAsByQuadraticFem) {
    const Loaded problem(make_box(3));
    std::vector<double> off;
    for (const double size : {1e-2, 0.5e-2}) {
        const Eigen::VectorXd values = size * problem.values;
        const Eigen::VectorXd linear = problem.constrained(make_method(kQuadraticFem)).displace(values);
        off.push_back(relative_difference(problem.constrained(make_method(kNonlinearFem)).displace(values), linear));
    }
    EXPECT_LT(off[0], 0.02);
    EXPECT_NEAR(off[0] / off[1], 2.0, 0.1) << "of first order in the loads";
}

TEST(Loads, ReciprocityHoldsBetweenLoadsAndHandlesByFem) {
    const Loaded problem(make_rabbit(300).surface);
    const Deformer deformer = problem.constrained(make_method(kFem));
    const SurfaceMesh& mesh = *problem.body.surface;
    const Eigen::Index n_handles = 3 * std::ssize(problem.set.handles);
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(problem.values.size());
    for (Eigen::Index i = 0; i < n_handles; i += 3) moved.segment<3>(i) = Eigen::Vector3d(0.3, -0.1, 0.2);
    const Eigen::VectorXd u = deformer.displace(moved);
    for (const Eigen::Index l : {3, 4}) {
        Eigen::VectorXd loaded = Eigen::VectorXd::Zero(problem.values.size());
        loaded[n_handles + l] = 1.0;
        const Eigen::Vector3d at_handle =
            deformer.reactions(loaded).forces.rightCols(std::ssize(problem.set.handles)).rowwise().sum();
        const UnitLoad& load = problem.set.loads[static_cast<std::size_t>(l)];
        double work = 0.0;
        for (std::size_t k = 0; k < load.triangles.size(); ++k) {
            const double area = 0.5 * area_vector(triangle_points(mesh, load.triangles[k])).norm();
            for (const int v : mesh.triangles.col(load.triangles[k]))
                work += area / 3.0 * load.tractions.col(static_cast<Eigen::Index>(k)).dot(u.segment<3>(3 * v));
        }
        EXPECT_NEAR(at_handle.dot(Eigen::Vector3d(0.3, -0.1, 0.2)), -work, 1e-9 * std::abs(work));
    }
}

TEST(Loads, EveryModeAndUpdateGivesTheSameAnswerWithASmallResidual) {
    const Loaded problem(make_box(3));
    Control control;
    for (const Method& method : all_linear()) {
        const Deformer::Answer expected =
            problem.constrained(method).answer(problem.values, {.residual = true}, control);
        EXPECT_LT(*expected.residual, method.kind == kGalerkinBem ? 1e-7 : 1e-10) << describe(method);
        for (const Mode mode : method.kind->modes)
            for (const Update update : method.kind->updates) {
                Method other = method;
                other.mode = mode;
                other.update = update;
                if (!refusal(other, 0.3).empty()) continue;
                const Deformer::Answer answer = problem.constrained(other).answer(problem.values, {}, control);
                EXPECT_LT(relative_difference(answer.displacements, expected.displacements), 1e-8) << describe(other);
                EXPECT_LT((answer.reactions.forces - expected.reactions.forces).norm(),
                          1e-7 * expected.reactions.forces.norm())
                    << describe(other);
            }
    }
}

TEST(Loads, ColumnsOfLoadsAddUpToTheirAnswer) {
    const Loaded problem(make_box(3));
    Control control;
    for (const Method& method : all_linear()) {
        const Deformer deformer = problem.constrained(method);
        Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(problem.values.size(), 5);
        columns.bottomRows<5>().setIdentity();
        const DragResponse response = deformer.drag_response(problem.values, columns, control);
        Eigen::VectorXd changed = problem.values, u;
        const Eigen::VectorXd change = Eigen::VectorXd::LinSpaced(5, -0.3, 0.4);
        changed.tail<5>() += change;
        response.displace(change, u);
        EXPECT_LT(relative_difference(u, deformer.displace(changed)), 1e-10) << describe(method);
    }
}

TEST(Loads, DoNotDependOnUnits) {
    const Loaded problem(make_box(3));
    // Metres to millimetres: stresses in N/mm^2 are a millionth, forces per volume a billionth.
    SurfaceMesh large = *problem.body.surface;
    large.vertices *= 1000.0;
    for (const MethodKind kind : {kFem, kLinearBem, kGalerkinBem, kNonlinearFem}) {
        const Method method = make_method(kind);
        const Eigen::VectorXd u = problem.constrained(method).displace(problem.values);
        Control control;
        Deformer scaled(precomputed(make_body(large, {3.0e-6, 0.3}), method));
        ConstrainedSet set = problem.set;
        set.loads[4].tractions *= 1e-6;
        scaled.constrain(set, control);
        Eigen::VectorXd values = problem.values;
        values.head(3 * std::ssize(set.handles)) *= 1000.0;
        values.segment<3>(3 * std::ssize(set.handles)) *= 1e-9;
        values[values.size() - 2] *= 1e-6;
        const double allowed = kind->linear ? 1e-10 : 1e-7;  // of equilibria to 1e-8 of the forces
        EXPECT_LT(relative_difference(scaled.displace(values) / 1000.0, u), allowed) << describe(method);
        const Eigen::VectorXd forces = scaled.reactions(values).forces.reshaped();
        EXPECT_LT(relative_difference(forces, problem.constrained(method).reactions(problem.values).forces.reshaped()),
                  10.0 * allowed);
    }
}

TEST(Loads, ThatDoNotBalanceOnAFreeBodyAreRefused) {
    const SurfaceMesh mesh = make_box(2);
    for (const MethodKind kind : {kFem, kLinearBem, kGalerkinBem}) {
        Control control;
        Deformer deformer(precomputed(make_body(mesh), make_method(kind)));
        deformer.constrain({{}, {}, {body_force_along(2)}}, control);
        EXPECT_THROW(deformer.displace(Eigen::VectorXd::Ones(1)), SolveError);
        EXPECT_TRUE(deformer.displace(Eigen::VectorXd::Zero(1)).isZero(0.0));
        deformer.constrain({{0}, {}, {body_force_along(2)}}, control);  // a hinge
        EXPECT_THROW(deformer.displace(Eigen::VectorXd::Ones(1)), SolveError);
    }
}

TEST(Loads, StressInsideABodyUnderPressureAndWeightIsRight) {
    const SurfaceMesh mesh = make_box(5);
    const HangingBar bar{{2.0, 0.3}, 0.7};
    const Eigen::VectorXd exact = exact_displacements(mesh, bar);
    ConstrainedSet set{
        {}, vertices_where(mesh, [](const auto& x) { return x.z() > 1.0 - kEdge; }), {body_force_along(2)}};
    Eigen::VectorXd values(set.n_values());
    values << at(exact, set.handles), -bar.weight;
    const Eigen::Vector3d point(0.45, 0.55, 0.5);
    for (const MethodKind kind : {kFem, kQuadraticFem, kConstantBem, kLinearBem, kGalerkinBem}) {
        Control control;
        Deformer deformer(precomputed(make_body(mesh, bar.material), make_method(kind)));
        deformer.constrain(set, control);
        const InteriorValues inside = deformer.interior_field(values, control)->at(point, control);
        EXPECT_NEAR(inside.stresses(2, 0), bar.weight * point.z(), 0.06 * bar.weight) << name(kind);
        EXPECT_NEAR(inside.displacements(2, 0), bar.displacement(point).z(), 0.03 * bar.weight) << name(kind);
    }
}

TEST(Loads, GalerkinAgreesWithQuadraticFemOnAnOrganicBodyAndEstimatesItsError) {
    Loaded problem(make_rabbit(300).surface, {1.0, 0.3});
    problem.values.head(3 * std::ssize(problem.set.handles)).setZero();
    Control control;
    const auto answer_by = [&](MethodKind kind, Deformer::Wanted wanted) {
        return problem.constrained(make_method(kind)).answer(problem.values, wanted, control);
    };
    const Deformer::Answer fem = answer_by(kQuadraticFem, {}), galerkin = answer_by(kGalerkinBem, {.check = true});
    const Eigen::VectorXd difference = galerkin.displacements - fem.displacements;
    const auto lengths = [](const Eigen::VectorXd& u) -> Eigen::RowVectorXd {
        return Eigen::Map<const Eigen::Matrix3Xd>(u.data(), 3, u.size() / 3).colwise().norm();
    };
    const double size = lengths(fem.displacements).maxCoeff();
    const double rms = difference.norm() / std::sqrt(static_cast<double>(difference.size()) / 3.0) / size;
    print_measured("rabbit under weight and pressure, Galerkin beside quadratic FEM, rms", rms);
    EXPECT_LT(rms, 0.05);  // both on 300 vertices
    ASSERT_TRUE(galerkin.check.has_value());
    const double worst = lengths(difference).maxCoeff() / size;
    print_measured("the estimate over the difference", galerkin.check->relative_error / worst);
    EXPECT_GT(galerkin.check->relative_error, worst / 5.0);
    EXPECT_LT(galerkin.check->relative_error, worst * 5.0);
}

}  // namespace
}  // namespace elastolab::test
