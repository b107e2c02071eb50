// What holds for loads on any body: balance, reciprocity, units, and that modes and methods agree.
#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Core>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/load_cases.hpp"
#include "methods/registry.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

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
