// Handles that move by a force, in scenes.
#include <gmock/gmock.h>

#include <iostream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/loaded_cube.hpp"
#include "scene/selectors.hpp"
#include "scene/solved_scene.hpp"

namespace elastolab {
namespace {

using test::named;
using test::refusal_of;
using test::solved;
using testing::AllOf;
using testing::HasSubstr;

/// The handle ends where prescribing its motion takes its force, on the surface itself and on a proxy.
TEST(SceneLoads, AHandleUnderAForceGivesWayByNonlinearFem) {
    Document document = loaded_cube();
    document.material.young_modulus = 100.0;
    const GripForce asked{{-1, 2, 6}, {0.3, 0, 0}};
    document.handles[0].force = asked;
    for (const bool proxied : {false, true}) {
        document.proxy.use = proxied ? ProxyUse::always : ProxyUse::never;
        document.proxy.n_vertices = 200;
        const Solution moved = solved(document, kNonlinearFem);
        ASSERT_EQ(moved.proxy != nullptr, proxied);
        const GroupReaction& held = named(moved.reactions, "held");
        EXPECT_LT((held.force - asked.force).norm(), 1e-6 * asked.force.norm());
        EXPECT_LT(moved.imbalance.force, 1e-8);
        EXPECT_LT(moved.imbalance.moment, 1e-8);
        EXPECT_LT(*moved.residual, 1e-7);
        EXPECT_GT(moved.displacement.colwise().norm().maxCoeff(), 0.1) << "far beyond linear theory";
    }
}

/// One vertex, and two and three on a line: collocation has moments there that do no work and that nobody asks for.
TEST(SceneLoads, AHandleOfAFewVerticesTakesAForceByAllMethods) {
    Document document = loaded_cube();
    document.loads.clear();
    document.gravity.reset();
    for (const MethodKind kind : all_methods())
        for (const double length : {0.1, 0.3, 0.6}) {
            document.handles[0].select = {BoxSelector{{0.9, 0.9, -0.1}, {1.1, 1.1, length}}};
            document.handles[0].force = GripForce{{0, 0.2, 0.1}, {0, 0, 0}};
            const Solution pushed = solved(document, kind, false);
            EXPECT_LT((named(pushed.reactions, "held").force - Eigen::Vector3d(0, 0.2, 0.1)).norm(), 1e-6)
                << name(kind);
            EXPECT_GT(pushed.displacement.row(1).maxCoeff(), 0.0) << name(kind);
            document.handles[0].force->moment = {0, 0, 0.1};
            EXPECT_THROW(solved(document, kind, false), SolveError) << name(kind) << " about the line";
        }
}

TEST(SceneLoads, AHandleUnderAForceMovesRigidlyToWhereItIsHeld) {
    Document document = loaded_cube();
    document.handles[0].force = GripForce{{1.0, -2.0, 3.0}, {0.1, 0.2, -0.1}};
    for (const MethodKind kind : {kFem, kQuadraticFem, kLinearBem, kGalerkinBem}) {
        const Solution solution = solved(document, kind);
        const GroupReaction& held = named(solution.reactions, "held");
        EXPECT_LT((held.force - Eigen::Vector3d(1, -2, 3)).norm(), 1e-9 * 4.0) << name(kind);
        const std::vector<int> patch = select_vertices(*solution.surface, document.handles[0].select, "");
        const Eigen::Vector3d middle = solution.surface->vertices(Eigen::all, patch).rowwise().mean();
        EXPECT_LT((held.moment - middle.cross(held.force) - Eigen::Vector3d(0.1, 0.2, -0.1)).norm(), 1e-9 * 4.0);
        // Rigid: distances change in second order only.
        for (const int v : patch) {
            const Eigen::Vector3d arm = solution.surface->vertices.col(v) - solution.surface->vertices.col(patch[0]);
            EXPECT_NEAR(arm.dot(solution.displacement.col(v) - solution.displacement.col(patch[0])), 0.0, 1e-13);
        }
    }
    document.fixed.clear();
    EXPECT_THAT(refusal_of(document), HasSubstr("balance"));
}

TEST(SceneLoads, TwoHandlesThatPullAtAFreeBodyAreHeldByEachOther) {
    Document document = loaded_cube();
    document.gravity.reset();
    document.loads.clear();
    document.fixed.clear();
    document.handles[0].select = {BoxSelector{.min = {0, 0, 0}, .max = {0, 1, 1}}};
    document.handles[0].force = GripForce{.force = {-50, 0, 0}};
    document.handles.push_back(document.handles[0]);
    document.handles[1].name = "right";
    document.handles[1].select = {BoxSelector{.min = {1, 0, 0}, .max = {1, 1, 1}}};
    document.handles[1].force = GripForce{.force = {50, 0, 0}};
    const Solution solution = solved(document);
    const auto face = [&](double x) {
        double sum = 0.0;
        int n = 0;
        for (int v = 0; v < solution.surface->n_vertices(); ++v)
            if (solution.surface->vertices(0, v) == x) sum += solution.displacement(0, v), ++n;
        return sum / n;
    };
    EXPECT_NEAR(face(1.0) - face(0.0), 0.05, 0.01);  // 50 / (E A) times the length, less the clamped ends
    EXPECT_NEAR(face(1.0) + face(0.0), 0.0, 1e-10);
}

/// By collocation they balance up to its error, on a body without symmetry between its handles.
TEST(SceneLoads, HandlesThatAloneHoldABodyTakeBalancedForcesByBoundaryElements) {
    Document document;
    document.mesh = Primitive{.name = "sphere", .resolution = 8, .size = {}};
    document.material = {1e4, 0.3};
    document.density = 20.0;
    const auto add = [&](const std::string& name, const BoxSelector& box, const GripForce& force) {
        document.handles.push_back({.name = name, .select = {box}});
        document.handles.back().force = force;
    };
    const Eigen::Vector3d moment(100, -60, 40);
    add("top", {{-1, -1, 0.8}, {1, 1, 1}}, {{0, 0, 0}, moment});
    add("side", {{0.6, -1, -1}, {1, 1, 1}}, {{0, 0, 0}, -moment});
    const auto largest = [](const Eigen::Matrix3Xd& u) { return u.colwise().norm().maxCoeff(); };
    const auto compare = [&](const char* what) {
        const Eigen::Matrix3Xd fine = solved(document, kQuadraticFem, false).displacement;
        for (const MethodKind kind : {kConstantBem, kLinearBem, kGalerkinBem}) {
            const Solution solution = solved(document, kind);
            const double off = largest(solution.displacement - fine) / largest(fine);
            const double told = solution.error_estimate.value();
            std::cout << what << ", " << name(kind) << ": off by " << off << ", told " << told << '\n';
            EXPECT_LT(off, kind->balances_forces ? 0.15 : 0.6) << what << ", " << name(kind);
            EXPECT_GT(told, 0.3 * off) << what << ", " << name(kind);
            EXPECT_LT(told, 3.0 * off) << what << ", " << name(kind);
        }
    };
    compare("moments");
    const double weight = 9.81 * document.density * enclosed_volume(make_sphere(8));
    document.gravity = Eigen::Vector3d(0, 0, -9.81);
    document.handles[0].force = GripForce{{0, 0, weight}, {0, 0, 0}};
    document.handles[1].force = GripForce{};
    compare("weight");
    document.handles[0].force->force = {0, 0, 0.5 * weight};
    EXPECT_THAT(refusal_of(document), HasSubstr("balance"));
}

/// Forces that balance on the body do so on its proxy, where patches have other middles.
TEST(SceneLoads, BalancedForcesOfAFreeBodyAreTakenByItsProxy) {
    Document document;
    document.mesh = Primitive{.name = "torus", .resolution = 10, .size = {}};
    document.material = {1e4, 0.3};
    const Selector right = {BoxSelector{{0.8, -1, -1}, {2, 1, 0.1}}}, far = {BoxSelector{{-0.6, 0.5, -1}, {0.3, 2, 1}}};
    const SurfaceMesh torus = make_torus(10);
    const auto middle = [&](const Selector& selected) -> Eigen::Vector3d {
        return torus.vertices(Eigen::all, select_vertices(torus, selected, "")).rowwise().mean();
    };
    const Eigen::Vector3d force(10, -3, 5), moment = (middle(far) - middle(right)).cross(force);
    const auto differ = [&](MethodKind kind) {
        document.proxy = {};
        const Eigen::Matrix3Xd own = solved(document, kind, false).displacement;
        document.proxy = {.use = ProxyUse::always, .n_vertices = 260};
        const Solution proxy = solved(document, kind, false);
        for (const auto* all : {&proxy.reactions, &proxy.loads})
            for (const GroupReaction& one : *all) {
                const double side = one.name == "right" ? 1.0 : -1.0;
                EXPECT_LT((one.force - side * force).norm(), (kind->balances_forces ? 1e-6 : 0.1) * force.norm());
            }
        return (proxy.displacement - own).norm() / own.norm();
    };
    document.handles = {{.name = "right", .select = right}, {.name = "far", .select = far}};
    document.handles[0].force = GripForce{force, moment};
    document.handles[1].force = GripForce{-force, {0, 0, 0}};
    for (const MethodKind kind : {kFem, kQuadraticFem, kGalerkinBem, kLinearBem})
        EXPECT_LT(differ(kind), 0.3) << name(kind);
    document.handles.clear();
    document.loads = {{.name = "right", .select = right, .value = ForceLoad{force}},
                      {.name = "far", .select = far, .value = ForceLoad{-force}}};
    EXPECT_THAT(refusal_of(document), AllOf(HasSubstr("force (0, 0, 0)"), HasSubstr("moment (")));
    document.loads[1].value = ForceLoad{{-1, 2, -3}};
    EXPECT_THAT(refusal_of(document), HasSubstr("add up to the force (9, -1, 2)"));
}

}  // namespace
}  // namespace elastolab
