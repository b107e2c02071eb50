#include "scene/simulation.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <limits>
#include <thread>

#include "base/error.hpp"

namespace elastolab {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using State = MethodRunner::State;

const std::vector<MethodKind> kLinear = {MethodKind::linear_bem};

LiveScene cube(int cells = 3) {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = cells, .size = {}};
    document.fixed = Selector{PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}};
    return {document, "cube.json"};
}

std::vector<int> where(const LiveScene& scene, double x_min, double y_min) {
    std::vector<int> vertices;
    for (int v = 0; v < scene.mesh().n_vertices(); ++v)
        if (scene.mesh().vertices(0, v) > x_min && scene.mesh().vertices(1, v) > y_min) vertices.push_back(v);
    return vertices;
}

/// What a fresh computation says.
Eigen::VectorXd truth(const LiveScene& scene, const Method& method) {
    Control control;
    Deformer deformer(precompute(scene.body(method.kind), method, control));
    deformer.constrain(scene.constraints().set, control);
    return deformer.displace(scene.constraints().values);
}

void expect_near(const Eigen::VectorXd& u, const Eigen::VectorXd& expected) {
    ASSERT_EQ(u.size(), expected.size());
    EXPECT_LT((u - expected).norm(), 1e-9 * expected.norm());
}

/// A simulation with its choices, updated like a window would.
struct Bench {
    explicit Bench(std::vector<MethodKind> kinds = kLinear) : shown(std::move(kinds)) {}

    Simulation simulation{[] {}};
    MethodChoices choices;
    std::vector<MethodKind> shown;

    void settle(const LiveScene& scene) {
        do {
            simulation.update(scene, shown, choices);
            std::this_thread::sleep_for(1ms);
        } while (simulation.busy());
        simulation.update(scene, shown, choices);
    }
    const MethodRunner& runner(MethodKind kind = MethodKind::linear_bem) { return simulation.runner(kind); }
};

class EveryMethod : public testing::TestWithParam<MethodKind> {};
INSTANTIATE_TEST_SUITE_P(Simulation, EveryMethod, testing::ValuesIn(all_method_kinds()));

TEST_P(EveryMethod, ShowsWhatAFreshComputationSays) {
    LiveScene scene = cube();
    Bench bench({GetParam()});
    bench.settle(scene);
    ASSERT_EQ(bench.runner(GetParam()).state(), State::ready);
    EXPECT_TRUE(bench.runner(GetParam()).has_inverse());  // small: completed by itself
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0.02, 0}});
    bench.settle(scene);
    expect_near(bench.runner(GetParam()).displacement(), truth(scene, bench.choices.of(GetParam())));
}

TEST(Simulation, FollowsTranslationsRotationsAndSeveralHandles) {
    LiveScene scene = cube();
    const int first = scene.add_handle(where(scene, 0.9, 0.6));
    const int second = scene.add_handle(where(scene, 0.9, -1.0));
    Bench bench;
    bench.settle(scene);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix();
    const std::vector<std::pair<int, Motion>> steps = {
        {first, AffineMotion{.translate = {0.1, 0, 0}}},
        {first, AffineMotion{.translate = {0.2, 0.1, 0}}},
        {second, AffineMotion{.translate = {0, 0, 0.1}}},
        {second, transformed(AffineMotion{.translate = {0, 0, 0.1}}, turn, {1, 0.2, 0.5}, Positions())},
        {second, AffineMotion{.matrix = 0.1 * turn}},
    };
    for (const auto& [handle, motion] : steps) {
        scene.set_motion(handle, motion);
        bench.simulation.update(scene, bench.shown, bench.choices);  // in the same frame
        expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(MethodKind::linear_bem)));
    }
}

TEST(Simulation, EveryFrameRuleAndUpdateShowsTheSame) {
    LiveScene scene = cube();
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    Bench bench;
    const Eigen::VectorXd expected = truth(scene, bench.choices.of(MethodKind::linear_bem));
    for (const Update update : {Update::direct, Update::eqn9, Update::reduced})
        for (const FrameRule rule : {FrameRule::drag_columns, FrameRule::displace}) {
            bench.choices.mode = Mode::full;
            bench.choices.update = update;
            bench.choices.frame_rule = rule;
            bench.settle(scene);
            expect_near(bench.runner().displacement(), expected);
        }
}

TEST(Simulation, ACompletedModelAnswersByTheUpdateThatWasChosen) {
    LiveScene scene = cube();
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    Bench bench;
    const Eigen::VectorXd expected = truth(scene, bench.choices.of(MethodKind::linear_bem));
    for (const Update update : {Update::eqn9, Update::reduced, Update::direct}) {
        bench.choices.update = update;
        bench.settle(scene);
        ASSERT_TRUE(bench.runner().has_inverse());
        EXPECT_EQ(bench.runner().model()->method().update, update);
        expect_near(bench.runner().displacement(), expected);
    }
}

TEST(Simulation, ACompletedInverseIsKeptWhenPoissonsRatioStays) {
    for (const MethodKind kind : all_method_kinds()) {
        LiveScene scene = cube();
        scene.add_handle(where(scene, 0.9, 0.6));
        scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
        Bench bench({kind});
        bench.settle(scene);
        ASSERT_TRUE(bench.runner(kind).has_inverse());
        for (int change = 0; change < 3; ++change) {
            if (change == 0) scene.set_material({.young_modulus = 5.0, .poisson_ratio = 0.3});
            if (change == 1) bench.choices.tractions = Tractions::continuous;
            if (change == 2) bench.choices.update = Update::direct;
            do bench.simulation.update(scene, bench.shown, bench.choices);
            while (bench.runner(kind).precomputing());
            EXPECT_TRUE(bench.runner(kind).has_inverse());
            EXPECT_THAT(bench.runner(kind).model()->facts().stages, IsEmpty());
            bench.settle(scene);
            EXPECT_EQ(bench.runner(kind).model()->body().material.young_modulus, 5.0);
            expect_near(bench.runner(kind).displacement(), truth(scene, bench.choices.of(kind)));
        }
    }
}

TEST(Simulation, AnInverseThatWasAskedForGoesWithItsMode) {
    LiveScene scene = cube();
    Bench bench;
    bench.choices.mode = Mode::full;
    bench.settle(scene);
    ASSERT_TRUE(bench.runner().has_inverse());
    bench.choices.mode = Mode::on_demand;
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    EXPECT_FALSE(bench.runner().has_inverse());
}

TEST(Simulation, AStopOfTheCompletionLeavesTheAnswerReady) {
    LiveScene scene = cube(8);
    Bench bench;
    do bench.simulation.update(scene, bench.shown, bench.choices);
    while (!bench.runner().completing());
    bench.simulation.prefetch(scene.set_with_handle(where(scene, 0.9, 0.6)));
    do bench.simulation.update(scene, bench.shown, bench.choices);
    while (bench.runner().completing() && !bench.runner().preparing());
    bench.simulation.runner(MethodKind::linear_bem).cancel();
    EXPECT_EQ(bench.runner().state(), State::ready);
    EXPECT_THAT(bench.runner().failure(), IsEmpty());
}

TEST(Simulation, AStoppedSetIsForgottenByAnotherOne) {
    LiveScene scene = cube(8);
    Bench bench({MethodKind::fem});
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    scene.commit();
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.commit();
    bench.simulation.update(scene, bench.shown, bench.choices);
    ASSERT_EQ(bench.runner(MethodKind::fem).state(), State::preparing);
    bench.simulation.runner(MethodKind::fem).cancel();
    EXPECT_EQ(bench.runner(MethodKind::fem).state(), State::failed);
    EXPECT_THAT(bench.simulation.problem(MethodKind::fem), HasSubstr("stopped"));
    scene.undo();
    bench.simulation.update(scene, bench.shown, bench.choices);
    EXPECT_EQ(bench.runner(MethodKind::fem).state(), State::ready);
}

TEST(Simulation, AMotionThatCannotBeFollowedIsForgottenByTheNext) {
    LiveScene scene = cube();
    scene.add_handle(where(scene, 0.9, 0.6));
    Bench bench;
    bench.choices.frame_rule = FrameRule::displace;
    bench.settle(scene);
    const double most = std::numeric_limits<double>::max();
    scene.set_motion(0, AffineMotion{.translate = {most, most, most}});
    bench.settle(scene);
    EXPECT_EQ(bench.runner().state(), State::failed);
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    bench.simulation.update(scene, bench.shown, bench.choices);
    EXPECT_EQ(bench.runner().state(), State::ready);
    expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(MethodKind::linear_bem)));
}

TEST(Simulation, TellsTheProgressOfASetThatIsBeingPrepared) {
    LiveScene scene = cube(8);
    Bench bench({MethodKind::fem});
    bench.choices.complete_up_to = 0;
    do bench.simulation.update(scene, bench.shown, bench.choices);
    while (bench.runner(MethodKind::fem).state() != State::preparing);
    EXPECT_LT(bench.runner(MethodKind::fem).elapsed_seconds(), 60.0);
    EXPECT_GT(bench.runner(MethodKind::fem).elapsed_seconds(), 0.0);
}

TEST(Simulation, AHandleThatWasPrefetchedAnswersAtOnce) {
    LiveScene scene = cube();
    Bench bench;
    bench.settle(scene);
    const std::vector<int> patch = where(scene, 0.9, 0.6);
    bench.simulation.prefetch(scene.set_with_handle(patch));
    do {
        bench.simulation.update(scene, bench.shown, bench.choices);
        std::this_thread::sleep_for(1ms);
    } while (bench.runner().preparing());
    EXPECT_EQ(bench.runner().displacement().norm(), 0.0);
    scene.add_handle(patch);
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    EXPECT_TRUE(bench.simulation.update(scene, bench.shown, bench.choices));
    EXPECT_EQ(bench.runner().state(), State::ready);
    for (const AffineMotion& motion :
         {AffineMotion{.translate = {0.1, 0, 0}}, AffineMotion{.translate = {0, 0.2, -0.1}},
          AffineMotion{.matrix = 0.1 * Eigen::Matrix3d::Identity()}}) {
        scene.set_motion(0, motion);
        bench.simulation.update(scene, bench.shown, bench.choices);
        expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(MethodKind::linear_bem)));
    }
}

TEST(Simulation, TheOldAnswerStaysWhileAnotherMaterialIsPrecomputed) {
    LiveScene scene = cube(6);
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    Bench bench;
    bench.settle(scene);
    const Eigen::VectorXd before = bench.runner().displacement();
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.45});
    bench.simulation.update(scene, bench.shown, bench.choices);
    EXPECT_EQ(bench.runner().state(), State::precomputing);
    EXPECT_EQ(bench.runner().displacement(), before);
    bench.settle(scene);
    expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(MethodKind::linear_bem)));
}

TEST(Simulation, ACancelledPrecomputationCanBeTriedAgain) {
    LiveScene scene = cube(10);
    Bench bench;
    bench.simulation.update(scene, bench.shown, bench.choices);
    ASSERT_EQ(bench.runner().state(), State::precomputing);
    bench.simulation.runner(MethodKind::linear_bem).cancel();
    bench.settle(scene);
    EXPECT_EQ(bench.runner().state(), State::idle);
    EXPECT_FALSE(bench.runner().has_answer());
    bench.simulation.runner(MethodKind::linear_bem).retry();
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    EXPECT_EQ(bench.runner().state(), State::ready);
    EXPECT_FALSE(bench.runner().has_inverse());
}

TEST(Simulation, SwitchingBackIsInstant) {
    LiveScene scene = cube();
    Bench bench;
    bench.settle(scene);
    bench.shown = {MethodKind::fem};
    bench.settle(scene);
    bench.shown = kLinear;
    bench.simulation.update(scene, bench.shown, bench.choices);
    EXPECT_EQ(bench.runner().state(), State::ready);
}

TEST(Simulation, AHiddenMethodComesToAnEnd) {
    LiveScene scene = cube(8);
    Bench bench;
    bench.simulation.update(scene, bench.shown, bench.choices);
    ASSERT_TRUE(bench.runner().precomputing());
    bench.shown = {MethodKind::fem};
    const Stopwatch watch;
    while (bench.runner().precomputing() && watch.seconds() < 60.0) bench.settle(scene);
    EXPECT_FALSE(bench.runner().precomputing());
    EXPECT_TRUE(bench.runner().model());
}

TEST(Simulation, AHiddenMethodForgetsABodyThatIsGone) {
    LiveScene first = cube(2), second = cube(3);
    Bench bench;
    bench.settle(first);
    bench.shown = {MethodKind::fem};
    bench.settle(second);
    EXPECT_FALSE(bench.runner().model());
    EXPECT_FALSE(bench.runner().surface());
}

TEST(Simulation, AMethodThatCannotTakeTheMaterialSaysSoAndTheOthersGoOn) {
    LiveScene scene = cube();
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.5});
    Bench bench({MethodKind::fem, MethodKind::linear_bem});
    bench.settle(scene);
    EXPECT_THAT(bench.simulation.problem(MethodKind::fem), HasSubstr("below 0.5"));
    EXPECT_THAT(bench.simulation.problem(MethodKind::linear_bem), IsEmpty());
    EXPECT_EQ(bench.runner().state(), State::ready);
}

TEST(Simulation, ComesToRestWhenAMethodIsComputedThatTheMaterialForbidsMeanwhile) {
    LiveScene scene = cube(8);
    Bench bench({MethodKind::fem});
    bench.simulation.update(scene, bench.shown, bench.choices);
    ASSERT_TRUE(bench.simulation.waiting());
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.5});
    bench.settle(scene);
    EXPECT_FALSE(bench.simulation.busy());
    EXPECT_FALSE(bench.simulation.checking());
    EXPECT_FALSE(bench.simulation.update(scene, bench.shown, bench.choices)) << "nothing changes any more";
}

TEST(Simulation, AnotherMeshReplacesEverything) {
    LiveScene small = cube(2), large = cube(3);
    Bench bench;
    bench.settle(small);
    bench.simulation.update(large, bench.shown, bench.choices);
    EXPECT_FALSE(bench.runner().has_answer());
    bench.settle(large);
    EXPECT_EQ(bench.runner().displacement().size(), 3 * large.mesh().n_vertices());
}

TEST(Simulation, AMethodThatWaitsForItsTurnForgetsABodyThatIsGone) {
    LiveScene first = cube(2), second = cube(8);
    Bench bench(all_method_kinds());
    bench.settle(first);
    bench.simulation.update(second, bench.shown, bench.choices);
    ASSERT_TRUE(bench.runner(bench.shown.front()).precomputing());
    EXPECT_FALSE(bench.runner(bench.shown.back()).surface());
    EXPECT_FALSE(bench.runner(bench.shown.back()).has_answer());
    bench.settle(second);
    EXPECT_EQ(bench.runner(bench.shown.back()).state(), State::ready);
}

TEST(Simulation, EndsWhileItComputes) {
    LiveScene scene = cube(10);
    Bench bench(all_method_kinds());
    bench.simulation.update(scene, bench.shown, bench.choices);
    EXPECT_TRUE(bench.simulation.busy());
}

}  // namespace
}  // namespace elastolab
