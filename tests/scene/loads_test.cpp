#include <gmock/gmock.h>

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "elasticity/rotation.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/loaded_cube.hpp"
#include "scene/selectors.hpp"
#include "scene/solve.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Solution solved(const Document& document, MethodKind kind = kFem, bool with_checks = true) {
    Control control;
    return solve({.scene_file = "scene.json",
                  .document = document,
                  .method = {.kind = kind},
                  .solve_once = true,
                  .with_checks = with_checks},
                 control);
}

std::string refusal_of(const Document& document) {
    try {
        solved(document);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "no complaint";
}

const GroupReaction& named(const std::vector<GroupReaction>& all, const std::string& name) {
    for (const GroupReaction& one : all)
        if (one.name == name) return one;
    throw std::out_of_range(name);
}

TEST(SceneLoads, AreReadAndWrittenAsTheyAre) {
    const Document document = loaded_cube();
    EXPECT_EQ(document.loads.size(), 3u);
    EXPECT_EQ(document.gravity, Eigen::Vector3d(0, 0, -9.81));
    EXPECT_EQ(std::get<PressureLoad>(document.loads[0].value).pressure, 3.0);
    const Document again = parse_scene(print_scene(document), "scene.json");
    EXPECT_TRUE(again == document);
    Document other = document;
    other.loads[1].value = ForceLoad{{5, 0, 2}};
    EXPECT_FALSE(other == document);
}

TEST(SceneLoads, StandInTheForcesTableAndBalance) {
    for (const MethodKind kind : {kFem, kGalerkinBem}) {
        const Solution solution = solved(loaded_cube(), kind);
        const GroupReaction& weight = named(solution.loads, "gravity");
        EXPECT_LT((weight.force - Eigen::Vector3d(0, 0, -2.0 * 9.81)).norm(), 1e-9);
        EXPECT_LT((weight.moment - Eigen::Vector3d(0.5, 0.5, 0.5).cross(weight.force)).norm(), 1e-9);
        EXPECT_LT((named(solution.loads, "above").force - Eigen::Vector3d(0, 0, -3)).norm(), 1e-12);
        EXPECT_LT((named(solution.loads, "load-1").force - Eigen::Vector3d(5, 0, 1)).norm(), 1e-12);
        EXPECT_LT((named(solution.loads, "side").force - Eigen::Vector3d(0, 1.5, 0)).norm(), 1e-12);
        EXPECT_LT(solution.imbalance.force, 1e-8) << name(kind);
        EXPECT_LT(solution.imbalance.moment, 1e-8) << name(kind);
        EXPECT_LT(*solution.residual, 1e-7);
        EXPECT_TRUE(solution.error_estimate.has_value());
    }
}

/// A softer cube, so that it matters where the loads act by now.
TEST(SceneLoads, BalanceUnderLargeDeformations) {
    Document document = loaded_cube();
    document.material.young_modulus = 100.0;
    document.loads[0].value = PressureLoad{30.0};
    const Solution solution = solved(document, kNonlinearFem);
    const GroupReaction& weight = named(solution.loads, "gravity");
    EXPECT_LT((weight.force - Eigen::Vector3d(0, 0, -2.0 * 9.81)).norm(), 1e-9);
    EXPECT_GT((weight.moment - Eigen::Vector3d(0.5, 0.5, 0.5).cross(weight.force)).norm(), 0.1) << "it has sunk";
    EXPECT_LT((named(solution.loads, "load-1").force - Eigen::Vector3d(5, 0, 1)).norm(), 1e-9);
    EXPECT_GT((named(solution.loads, "above").force - Eigen::Vector3d(0, 0, -30)).norm(), 1.0) << "it follows";
    EXPECT_LT(solution.imbalance.force, 1e-8);
    EXPECT_LT(solution.imbalance.moment, 1e-8);
    EXPECT_LT(*solution.residual, 1e-7);
    EXPECT_GT(*solution.compliance, 0.0);
    // Without handles half of the work is stored, but for what is not linear.
    document.material.young_modulus = 1e5;
    document.handles.clear();
    const Solution stiff = solved(document, kNonlinearFem, false);
    EXPECT_NEAR(2.0 * stiff.facts->energy, *stiff.compliance, 0.01 * *stiff.compliance);
    EXPECT_NEAR(*solved(document, kQuadraticFem, false).compliance, *stiff.compliance, 0.01 * *stiff.compliance);
}

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

TEST(SceneLoads, DoTheWorkThatTheBodyStores) {
    // By Clapeyron, loads and supports do twice the energy; doubling every load quadruples it.
    Document document = loaded_cube();
    document.handles.clear();
    const double work = *solved(document).compliance;
    EXPECT_GT(work, 0.0);
    // Converged: 0.843. On this coarse mesh linear FEM has 0.71, quadratic FEM 0.81, Galerkin 0.83.
    EXPECT_NEAR(*solved(document, kQuadraticFem).compliance, work, 0.15 * work);
    EXPECT_NEAR(*solved(document, kGalerkinBem).compliance, *solved(document, kQuadraticFem).compliance, 0.04 * work);
    *document.gravity *= 2.0;
    document.loads[0].value = PressureLoad{6.0};
    document.loads[1].value = ForceLoad{{10, 0, 2}};
    document.loads[2].value = TractionLoad{{0, 4, 0}};
    EXPECT_NEAR(*solved(document).compliance, 4.0 * work, 1e-8 * work);
}

/// Its reactions are rounding, of which nothing is to be said.
TEST(SceneLoads, ReactionsOfABodyThatOnlyMovesAreNoImbalance) {
    Document document = loaded_cube();
    document.gravity.reset();
    document.loads.clear();
    document.fixed.clear();
    document.handles[0].motion = AffineMotion{.matrix = cross_matrix({0.1, -0.2, 0.3}), .translate = {0.2, 0, 0.1}};
    document.handles[0].select = {PlaneSelector{{1, 0, 0}, {1, 0, 0}, 1e-9}};
    for (const MethodKind kind : {kFem, kQuadraticFem, kGalerkinBem, kLinearBem}) {
        const Solution moved = solved(document, kind);
        EXPECT_EQ(moved.imbalance.force, 0.0) << name(kind);
        EXPECT_THAT(moved.warnings(), Each(Not(HasSubstr("do not balance")))) << name(kind);
    }
    Document stretched = document;
    std::get<AffineMotion>(stretched.handles[0].motion).matrix(1, 1) = 1e-6;
    EXPECT_GT(solved(stretched, kLinearBem).imbalance.force, 0.0);
}

TEST(SceneLoads, AreRefusedWithTheirPlaces) {
    Document document = loaded_cube();
    document.loads[1].select = {BoxSelector{.min = {0, 0, 0}, .max = {0, 1, 1}}};
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /loads/1/select: "), HasSubstr("constrained")));
    document = loaded_cube();
    document.loads[2].select = {VertexSelector{{0, 1}}};
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /loads/2/select: "), HasSubstr("no triangle")));
    document = loaded_cube();
    document.loads[2].name = "above";
    EXPECT_THAT(refusal_of(document), StartsWith("scene.json: /loads: two of them"));
    document.loads[2].name = "gravity";
    EXPECT_THAT(refusal_of(document), StartsWith("scene.json: /loads/2/name: "));
    document = loaded_cube();
    document.fixed.clear();
    document.handles.clear();
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /loads: "), HasSubstr("balance")));
    document.loads.clear();
    EXPECT_THAT(refusal_of(document), AllOf(StartsWith("scene.json: /gravity: "), HasSubstr("balance")));
}

/// A unit cube and the same at x = 3, of four vertices an edge.
Document two_cubes(const test::TemporaryFolder& folder) {
    const SurfaceMesh one = make_box(3);
    std::ostringstream text;
    for (const double x : {0.0, 3.0})
        for (const auto& v : one.vertices.colwise()) text << "v " << v.x() + x << ' ' << v.y() << ' ' << v.z() << "\n";
    for (const int first : {1, 1 + one.n_vertices()})
        for (const auto& t : one.triangles.colwise())
            text << "f " << t[0] + first << ' ' << t[1] + first << ' ' << t[2] + first << "\n";
    Document document;
    document.mesh = MeshFile{.file = folder.write("two.obj", text.str()).string()};
    document.material = {1000.0, 0.3};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    return document;
}

TEST(SceneLoads, SolidsThatOnlyMoveEachByItselfHaveNoImbalance) {
    const test::TemporaryFolder folder;
    Document document = two_cubes(folder);
    document.handles = {{.name = "moved",
                         .select = {PlaneSelector{{3, 0, 0}, {1, 0, 0}, 1e-9}},
                         .motion = AffineMotion{.translate = {0.1, 0, 0.2}}}};
    for (const MethodKind kind : {kFem, kGalerkinBem}) {
        const Solution moved = solved(document, kind);
        EXPECT_EQ(moved.imbalance.force, 0.0) << name(kind);
        EXPECT_THAT(moved.warnings(), Each(Not(HasSubstr("do not balance")))) << name(kind);
    }
}

/// Whichever solid its first vertex is on.
TEST(SceneLoads, AHandleUnderAForceHoldsSolidsTogether) {
    const test::TemporaryFolder folder;
    for (const bool free_one_first : {true, false}) {
        Document document = two_cubes(folder);
        const SurfaceMesh one = make_box(3);
        std::vector<int> right_of_one, left_of_other;
        for (int v = 0; v < one.n_vertices(); ++v) {
            if (one.vertices(0, v) > 0.9) right_of_one.push_back(v);
            if (one.vertices(0, v) < 0.1) left_of_other.push_back(v + one.n_vertices());
        }
        std::vector<int> both = free_one_first ? left_of_other : right_of_one;
        const std::vector<int>& more = free_one_first ? right_of_one : left_of_other;
        both.insert(both.end(), more.begin(), more.end());
        document.handles = {{.name = "bond",
                             .select = {VertexSelector{both}},
                             .motion = AffineMotion{},
                             .force = GripForce{{1, 2, 3}}}};
        EXPECT_GT(solved(document).displacement.norm(), 0.0);
        document.fixed.clear();
        EXPECT_THAT(refusal_of(document), HasSubstr("nothing holds the body"));
    }
}

/// Of which rounding leaves something, and no force that it could be compared with.
TEST(SceneLoads, MomentsThatBalanceEachOtherAreTaken) {
    Document document = loaded_cube();
    document.gravity.reset();
    document.loads.clear();
    document.fixed.clear();
    document.handles.clear();
    const double moments[] = {0.1, 0.2, -0.3};
    for (int i = 0; i < 3; ++i)
        document.handles.push_back({.name = std::to_string(i),
                                    .select = {BoxSelector{{0.5 * i - 0.1, -0.1, 0.7}, {0.5 * i + 0.1, 0.3, 1.1}}},
                                    .motion = AffineMotion{},
                                    .force = GripForce{{0, 0, 0}, {0, moments[i], 0}}});
    ASSERT_NE(moments[0] + moments[1] + moments[2], 0.0);
    EXPECT_GT(solved(document).displacement.norm(), 0.0);
    document.handles[2].force->moment *= 1.001;
    EXPECT_THAT(refusal_of(document), HasSubstr("the moment"));
}

/// What is held may leave a body to turn: the moment about that line or point is what has to vanish.
TEST(SceneLoads, OfABodyThatCanTurnAreRefusedWithTheirMomentAboutWhatHoldsIt) {
    Document document = loaded_cube();
    document.loads.clear();
    document.handles.clear();
    document.fixed = {{.select = {BoxSelector{{-1, -1, -1}, {2, 0.1, 0.1}}}}};
    EXPECT_THAT(refusal_of(document),
                AllOf(StartsWith("scene.json: /gravity: do not balance: "),
                      HasSubstr("about the line through (0, 0, 0) along (1, 0, 0)"), HasSubstr("moment -9.81.")));
    document.fixed = {{.select = {VertexSelector{{0}}}}};
    EXPECT_THAT(refusal_of(document), AllOf(HasSubstr("turn about (0, 0, 0), "), HasSubstr("moment (-9.81, 9.81, 0)")));
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

TEST(SceneLoads, AreCarriedToAFilledSurface) {
    Document document = loaded_cube();
    document.proxy.use = ProxyUse::fill;
    EXPECT_LT(solved(document).imbalance.force, 1e-8);
}

/// A proxy around the body takes over patches by what is near them: forces stay, areas nearly.
TEST(SceneLoads, AreCarriedToAProxyAroundTheBody) {
    Document document = loaded_cube();
    document.mesh = Primitive{.name = "cube", .resolution = 8, .size = {}};
    document.handles.clear();
    const Solution own = solved(document, kQuadraticFem, false);
    document.proxy = {.use = ProxyUse::always, .n_vertices = 400};
    const Solution proxy = solved(document, kQuadraticFem, false);
    ASSERT_TRUE(proxy.proxy);
    EXPECT_FALSE(proxy.proxy->is_filled());
    EXPECT_LT(proxy.imbalance.force, 1e-8);
    EXPECT_LT((named(proxy.loads, "load-1").force - Eigen::Vector3d(5, 0, 1)).norm(), 1e-9);
    const std::string above = "above";
    for (const char* load : {"gravity", "above", "side"}) {
        const Eigen::Vector3d force = named(own.loads, load).force;
        EXPECT_LT((named(proxy.loads, load).force - force).norm(), (load == above ? 0.15 : 1e-6) * force.norm())
            << load;
    }
    for (const char* load : {"load-1", "side"}) {
        const Eigen::Vector3d moment = named(own.loads, load).moment;
        EXPECT_LT((named(proxy.loads, load).moment - moment).norm(), 1e-9 * moment.norm()) << load;
    }
    EXPECT_LT((proxy.displacement - own.displacement).norm(), 0.15 * own.displacement.norm());
    EXPECT_NEAR(*proxy.compliance, *own.compliance, 0.25 * *own.compliance);
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
