// Loads of a scene while a person edits it.
#include <gtest/gtest.h>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/simulation.hpp"
#include "scene/solve.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

using test::wait_until;

Document fixed_cube() {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = 4, .size = {}};
    document.material = {1000.0, 0.3};
    document.fixed = {{.name = "wall", .select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    return document;
}

std::vector<int> vertices_at(const LiveScene& scene, int axis, double place) {
    std::vector<int> vertices;
    for (int v = 0; v < scene.mesh().n_vertices(); ++v)
        if (std::abs(scene.mesh().vertices(axis, v) - place) < 1e-9) vertices.push_back(v);
    return vertices;
}

double factor(const LiveScene& scene, int load, int row = 0) {
    const Constraints& all = scene.constraints();
    return all.values[all.values.size() - std::ssize(all.set.loads) + scene.applied_load(load)->first + row];
}

/// Displacements under loads go as one over Young's modulus; those that are prescribed do not depend on it.
TEST(LiveLoads, WaitForTheMaterialThatTheyActOn) {
    LiveScene scene(fixed_cube(), "scene.json");
    const std::vector<int> above = vertices_at(scene, 2, 1.0);
    for (const bool loaded : {true, false}) {
        if (loaded)
            scene.add_load(above, PressureLoad{3.0});
        else {
            scene.remove_load(0);
            scene.set_motion(scene.add_handle(vertices_at(scene, 0, 1.0)), AffineMotion{.translate = {0.1, 0, 0}});
        }
        scene.commit();
        MethodRunner runner([] {});
        const auto set = [&] {
            runner.set_body(scene.body(kGalerkinBem), {.kind = kGalerkinBem});
            runner.set_constraints(scene.constraints());
            runner.poll();
        };
        wait_until([&] {
            set();
            return runner.state() == MethodRunner::State::ready;
        });
        EXPECT_TRUE(runner.answers());
        EXPECT_TRUE(runner.is_of_present_model());
        const Eigen::VectorXd before = runner.displacement();
        scene.set_material({100.0, 0.3});
        set();
        EXPECT_EQ(runner.answers(), !loaded);
        EXPECT_FALSE(runner.is_of_present_model());
        wait_until([&] {
            set();
            return runner.answers() && runner.is_of_present_model();
        });
        EXPECT_LT((runner.displacement() - (loaded ? 10.0 : 1.0) * before).norm(), 1e-9 * runner.displacement().norm());
        scene.set_material({1000.0, 0.3});
        scene.commit();
    }
}

TEST(LiveLoads, AreAddedNamedRemovedAndTakenBack) {
    LiveScene scene(fixed_cube(), "scene.json");
    const int above = scene.add_load(vertices_at(scene, 2, 1.0), PressureLoad{3.0});
    scene.commit();
    const int end = scene.add_load(vertices_at(scene, 0, 1.0), ForceLoad{{5, 0, 1}});
    scene.commit();
    ASSERT_EQ(above, 0);
    ASSERT_EQ(end, 1);
    EXPECT_EQ(scene.load_name(1), "load-1");
    EXPECT_FALSE(scene.rename_load(1, "load-0"));
    EXPECT_FALSE(scene.rename_load(1, "gravity"));
    EXPECT_TRUE(scene.rename_load(1, "tip"));
    EXPECT_TRUE(scene.modified());
    scene.set_gravity(Eigen::Vector3d(0, 0, -9.81), 2.0);
    EXPECT_EQ(factor(scene, LiveScene::kGravity, 2), -19.62);
    EXPECT_EQ(factor(scene, above), 3.0);
    EXPECT_EQ(factor(scene, end, 2), 1.0);
    scene.remove_load(0);
    EXPECT_EQ(scene.load_name(0), "tip");
    EXPECT_EQ(factor(scene, 0), 5.0);
    scene.commit();
    scene.undo();
    scene.undo();
    ASSERT_EQ(scene.n_loads(), 1);
    EXPECT_FALSE(scene.document().gravity.has_value());
    scene.redo();
    EXPECT_EQ(scene.n_loads(), 2);
    EXPECT_EQ(scene.add_load(std::vector<int>{0, 1}, ForceLoad{}), LiveScene::kNobody) << "has no triangle";
    EXPECT_EQ(scene.add_load(vertices_at(scene, 0, 0.0), ForceLoad{}), LiveScene::kNobody) << "all constrained";
}

TEST(LiveLoads, ChangeOfSizeKeepsTheConstrainedSet) {
    LiveScene scene(fixed_cube(), "scene.json");
    scene.add_load(vertices_at(scene, 2, 1.0), PressureLoad{3.0});
    scene.set_gravity(Eigen::Vector3d(0, 0, -1.0), 1.0);
    const std::vector<UnitLoad> before = scene.constraints().set.loads;
    const std::uint64_t revision = scene.revision();
    scene.set_load(0, PressureLoad{-7.0});
    scene.set_gravity(Eigen::Vector3d(1.0, 0, 0), 3.0);
    EXPECT_GT(scene.revision(), revision);
    EXPECT_EQ(scene.constraints().set.loads, before);
    EXPECT_EQ(factor(scene, 0), -7.0);
    EXPECT_EQ(factor(scene, LiveScene::kGravity), 3.0);
    scene.set_load(0, PressureLoad{std::nan("")});
    scene.set_gravity(Eigen::Vector3d(1.0, 0, 0), 0.0);
    EXPECT_EQ(factor(scene, 0), -7.0);
    EXPECT_EQ(factor(scene, LiveScene::kGravity), 3.0);
    scene.set_load(0, TractionLoad{{0, 0, 2}});
    EXPECT_EQ(scene.applied_load(0)->count, 3);
    EXPECT_EQ(factor(scene, 0, 2), 2.0);
}

/// A patch that is pulled may cover loaded triangles; a total force then acts on those that are left.
TEST(LiveLoads, ActOnWhatIsFreeWhileAPatchOfThemIsPulled) {
    LiveScene scene(fixed_cube(), "scene.json");
    const std::vector<int> end = vertices_at(scene, 0, 1.0);
    scene.add_load(end, ForceLoad{{5, 0, 1}});
    const auto force = [&] {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        const AppliedLoad& load = *scene.applied_load(0);
        for (int k = 0; k < 3; ++k)
            sum +=
                factor(scene, 0, k) *
                resultant(scene.mesh(), scene.constraints().set.loads[static_cast<std::size_t>(load.first + k)]).force;
        return sum;
    };
    const std::size_t n_before = scene.applied_load(0)->triangles.size();
    std::vector<int> lower;
    for (const int v : end)
        if (scene.mesh().vertices(2, v) < 0.51) lower.push_back(v);
    scene.add_handle(lower);
    EXPECT_EQ(scene.applied_load(0)->triangles.size(), n_before / 2);
    EXPECT_LT((force() - Eigen::Vector3d(5, 0, 1)).norm(), 1e-12);
    scene.remove_handle(0);
    EXPECT_EQ(scene.applied_load(0)->triangles.size(), n_before);
    const Constraints foreseen = scene.constraints_with_handle(end);
    scene.add_handle(end);
    EXPECT_EQ(scene.applied_load(0), nullptr);
    EXPECT_EQ(foreseen.set.loads, scene.constraints().set.loads);
    EXPECT_EQ(foreseen.values.size(), scene.constraints().values.size());
    EXPECT_EQ(scene.n_loads(), 1) << "it comes back when the handle goes";
}

/// What the viewer shows is what `solve` says.
TEST(LiveLoads, MoveTheShownBodyAsSolveDoes) {
    for (const MethodKind kind : {kFem, kGalerkinBem}) {
        LiveScene scene(fixed_cube(), "scene.json");
        Simulation simulation([] {});
        const MethodChoices choices;
        const auto settle = [&] {
            return wait_until([&] {
                simulation.update(scene, {kind}, choices);
                return !simulation.busy() && !simulation.previewing(kind);
            });
        };
        ASSERT_TRUE(settle());
        scene.add_load(vertices_at(scene, 0, 1.0), ForceLoad{{1, 0, 0}});
        scene.set_gravity(Eigen::Vector3d(0, 0, -9.81), 0.5);
        ASSERT_TRUE(settle());
        scene.set_load(0, ForceLoad{{5, -2, 1}});
        ASSERT_TRUE(settle());
        Control control;
        const Solution solution =
            solve({.scene_file = "scene.json", .document = scene.document(), .method = {.kind = kind}}, control);
        const Eigen::VectorXd truth = solution.displacement.reshaped();
        EXPECT_LT((simulation.answer(kind).displacement() - truth).norm(), 1e-9 * truth.norm()) << name(kind);
    }
}

/// A handle under a force is shown where `solve` puts it, while another is moved and loads change; on a proxy, too.
void expect_handles_where_solve_puts_them(MethodKind kind, double young_modulus, double tolerance) {
    for (const bool on_proxy : {false, true}) {
        Document document = fixed_cube();
        document.material.young_modulus = young_modulus;
        document.handles = {{.name = "edge", .select = {BoxSelector{{0.9, 0, 0}, {1, 0.3, 1}}}},
                            {.name = "held", .select = {BoxSelector{{0.9, 0.7, 0}, {1, 1, 1}}}}};
        document.handles[0].force = GripForce{{2.0, -1.0, 3.0}, {0.1, 0.2, -0.1}};
        if (on_proxy) document.proxy = {.use = ProxyUse::always, .n_vertices = 200};
        LiveScene scene(document, "scene.json");
        Simulation simulation([] {});
        const MethodChoices choices;
        const auto settle = [&] {
            return wait_until([&] {
                simulation.update(scene, {kind}, choices);
                return !simulation.busy() && !simulation.previewing(kind);
            });
        };
        const auto expect_as_solved = [&] {
            ASSERT_TRUE(settle());
            simulation.update(scene, {kind}, choices);
            Control control;
            const Solution solution = solve({.scene_file = "scene.json",
                                             .document = scene.document(),
                                             .method = {.kind = kind},
                                             .with_checks = false},
                                            control);
            const Eigen::VectorXd truth = solution.displacement.reshaped();
            // Proxies of the two may differ.
            const double allowed = on_proxy ? 0.1 : tolerance;
            EXPECT_LT((simulation.answer(kind).displacement() - truth).norm(), allowed * truth.norm()) << on_proxy;
        };
        expect_as_solved();
        scene.set_motion(1, AffineMotion{.translate = {0, 0.02, 0}});
        expect_as_solved();
        scene.set_gravity(Eigen::Vector3d(0, 0, -9.81), 0.5);
        expect_as_solved();
        scene.set_force(0, GripForce{{0, 0, -1.0}});
        expect_as_solved();
    }
}

TEST(LiveLoads, HandlesUnderAForceStandWhereSolvePutsThem) { expect_handles_where_solve_puts_them(kFem, 1000.0, 1e-8); }

/// So soft a cube that linear theory is far off.
TEST(LiveLoads, HandlesUnderAForceStandWhereSolvePutsThemByNonlinearFem) {
    expect_handles_where_solve_puts_them(kNonlinearFem, 25.0, 1e-6);
}

TEST(LiveLoads, AHandleUnderAForceOnABodyThatNothingHoldsStaysAndSaysWhy) {
    for (const MethodKind kind : {kFem, kLinearBem, kGalerkinBem, kNonlinearFem}) {
        Document document = fixed_cube();
        document.fixed.clear();
        document.handles = {{.name = "edge", .select = {BoxSelector{{0.9, 0, 0}, {1, 0.3, 1}}}}};
        document.handles[0].force = GripForce{{2.0, -1.0, 3.0}, {0, 0, 0}};
        LiveScene scene(document, "scene.json");
        Simulation simulation([] {});
        const MethodChoices choices;
        const auto settle = [&] {
            const bool settled = wait_until([&] {
                simulation.update(scene, {kind}, choices);
                return !simulation.busy() && !simulation.previewing(kind);
            });
            simulation.update(scene, {kind}, choices);
            return settled;
        };
        ASSERT_TRUE(settle());
        EXPECT_NE(simulation.problem(kind).find("no motion of theirs balances it"), std::string::npos) << name(kind);
        EXPECT_EQ(simulation.answer(kind).displacement().norm(), 0.0) << name(kind);
        scene.set_force(0, GripForce{{0, 0, 0}, {0, 0, 0}});
        ASSERT_TRUE(settle());
        EXPECT_EQ(simulation.problem(kind), "") << name(kind);
        EXPECT_LT(simulation.answer(kind).displacement().norm(), 1e-9) << name(kind);
    }
}

}  // namespace
}  // namespace elastolab
