// What the workers do beside the answers: complete, prefetch, stop, fail, come to rest.

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <limits>

#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "methods/registry.hpp"
#include "simulation_bench.hpp"

namespace elastolab {
namespace {

using namespace testing_simulation;

TEST(BackgroundWork, ACompletedModelAnswersByTheUpdateThatWasChosen) {
    LiveScene scene = pulled_cube();
    Bench bench;
    const Eigen::VectorXd expected = truth(scene, bench.choices.of(kLinearBem));
    for (const Update update : {Update::eqn9, Update::reduced, Update::direct}) {
        bench.choices.update = update;
        bench.settle(scene);
        ASSERT_TRUE(bench.runner().has_inverse());
        EXPECT_EQ(bench.runner().model()->method().update, update);
        expect_near(bench.runner().displacement(), expected);
    }
}

TEST(BackgroundWork, ACompletedInverseIsKeptWhenPoissonsRatioStays) {
    for (const MethodKind kind : all_methods()) {
        LiveScene scene = pulled_cube();
        Bench bench({kind});
        bench.settle(scene);
        if (!has(kind, Mode::full) || !kind->full_serves_sets) {  // nobody would gain from an inverse
            EXPECT_FALSE(bench.runner(kind).has_inverse()) << kind->name;
            continue;
        }
        ASSERT_TRUE(bench.runner(kind).has_inverse());
        for (int change = 0; change < 3; ++change) {
            if (change == 0) scene.set_material({.young_modulus = 5.0, .poisson_ratio = 0.3});
            if (change == 1) bench.choices.tractions = Tractions::continuous;
            if (change == 2) bench.choices.update = Update::direct;
            bench.update_until(scene, [&] { return !bench.runner(kind).precomputing(); });
            EXPECT_TRUE(bench.runner(kind).has_inverse());
            EXPECT_THAT(bench.runner(kind).model()->facts().stages, IsEmpty());
            bench.settle(scene);
            EXPECT_EQ(bench.runner(kind).model()->body().material.young_modulus, 5.0);
            expect_near(bench.runner(kind).displacement(), truth(scene, bench.choices.of(kind)));
        }
    }
}

TEST(BackgroundWork, AnInverseThatWasAskedForGoesWithItsMode) {
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

TEST(BackgroundWork, AStopOfTheCompletionLeavesTheAnswerReady) {
    LiveScene scene = cube(8);
    Bench bench;
    bench.update_until(scene, [&] { return bench.runner().completing(); });
    bench.simulation.prefetch(scene.constraints_with_handle(where(scene, 0.9, 0.6)));
    bench.update_until(scene, [&] { return !bench.runner().completing() || bench.runner().preparing(); });
    bench.simulation.runner(kLinearBem).cancel();
    EXPECT_EQ(bench.runner().state(), State::ready);
    EXPECT_THAT(bench.runner().failure(), IsEmpty());
}

TEST(BackgroundWork, AStoppedSetIsForgottenByAnotherOne) {
    LiveScene scene = cube(8);
    Bench bench({kFem});
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    scene.commit();
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.commit();
    bench.update(scene);
    ASSERT_EQ(bench.runner(kFem).state(), State::preparing);
    bench.simulation.runner(kFem).cancel();
    EXPECT_EQ(bench.runner(kFem).state(), State::failed);
    EXPECT_THAT(bench.simulation.problem(kFem), HasSubstr("stopped"));
    scene.undo();
    bench.update(scene);
    EXPECT_EQ(bench.runner(kFem).state(), State::ready);
}

TEST(BackgroundWork, AMotionThatCannotBeFollowedIsForgottenByTheNext) {
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
    bench.update(scene);
    EXPECT_EQ(bench.runner().state(), State::ready);
    expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(kLinearBem)));
}

TEST(BackgroundWork, TellsTheProgressOfASetThatIsBeingPrepared) {
    LiveScene scene = cube(8);
    Bench bench({kFem});
    bench.choices.complete_up_to = 0;
    std::vector<JobStatus> seen;
    bench.update_until(scene, [&] {
        const bool prepares = bench.runner(kFem).state() == State::preparing;
        if (prepares) seen.push_back(bench.runner(kFem).status());
        return !seen.empty() && !prepares;
    });
    EXPECT_GT(seen.front().seconds, 0.0);
    EXPECT_THAT(seen.back().stage, ::testing::AnyOf(::testing::StrEq("constrain"), ::testing::StrEq("solve")));
    for (std::size_t i = 0; i < seen.size(); ++i) {
        EXPECT_GE(seen[i].progress, 0.0);
        EXPECT_LE(seen[i].progress, 1.0);
        EXPECT_GE(seen[i].seconds, seen[i > 0 ? i - 1 : 0].seconds);
    }
}

TEST(BackgroundWork, AHandleThatWasPrefetchedAnswersAtOnce) {
    LiveScene scene = cube();
    Bench bench;
    bench.settle(scene);
    const std::vector<int> patch = where(scene, 0.9, 0.6);
    bench.simulation.prefetch(scene.constraints_with_handle(patch));
    bench.update_until(scene, [&] { return !bench.runner().preparing(); });
    EXPECT_EQ(bench.runner().displacement().norm(), 0.0);
    scene.add_handle(patch);
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    EXPECT_TRUE(bench.update(scene));
    EXPECT_EQ(bench.runner().state(), State::ready);
    for (const AffineMotion& motion :
         {AffineMotion{.translate = {0.1, 0, 0}}, AffineMotion{.translate = {0, 0.2, -0.1}},
          AffineMotion{.matrix = 0.1 * Eigen::Matrix3d::Identity()}}) {
        scene.set_motion(0, motion);
        bench.update(scene);
        expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(kLinearBem)));
    }
}

TEST(BackgroundWork, AMotionThatTakesLongIsSolvedByTheWorker) {
    LiveScene scene = cube();
    const int first = scene.add_handle(where(scene, 0.9, 0.6)), second = scene.add_handle(where(scene, 0.9, -1.0));
    Bench bench;
    bench.settle(scene);
    bench.set_solve_budget(0.0);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()).toRotationMatrix();
    const std::vector<std::pair<int, AffineMotion>> pulls = {{first, {.translate = {0.1, 0, 0}}},
                                                             {second, {.translate = {0, 0.1, 0}}},
                                                             {first, {.matrix = 0.1 * turn, .translate = {0.1, 0, 0}}}};
    for (const auto& [handle, motion] : pulls) {
        const Eigen::VectorXd before = bench.runner().displacement();
        scene.set_motion(handle, motion);
        bench.update(scene);
        EXPECT_EQ(bench.runner().state(), State::preparing);
        EXPECT_EQ(bench.runner().displacement(), before);
        AffineMotion on = motion;  // the pull goes on meanwhile
        on.translate += Eigen::Vector3d(0.05, 0.01, 0);
        scene.set_motion(handle, on);
        bench.settle(scene);
        EXPECT_EQ(bench.runner().state(), State::ready);
        expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(kLinearBem)));
        on.translate += Eigen::Vector3d(0, 0.02, 0.03);
        scene.set_motion(handle, on);
        bench.update(scene);  // by the columns at hand, in the same frame
        EXPECT_EQ(bench.runner().state(), State::ready);
        expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(kLinearBem)));
    }
}

TEST(BackgroundWork, AMotionWhoseSolutionWasStoppedCanBeTriedAgain) {
    LiveScene scene = pulled_cube(8);
    Bench bench;
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    bench.set_solve_budget(0.0);
    scene.set_motion(0, AffineMotion{.matrix = 0.3 * Eigen::Matrix3d::Identity(), .translate = {0, 0.1, 0}});
    bench.update(scene);
    ASSERT_EQ(bench.runner().state(), State::preparing);
    MethodRunner& runner = bench.simulation.runner(kLinearBem);
    runner.cancel();
    bench.settle(scene);
    EXPECT_EQ(runner.state(), State::failed);
    EXPECT_THAT(runner.failure(), HasSubstr("stopped"));
    runner.retry();
    bench.settle(scene);
    EXPECT_EQ(runner.state(), State::ready);
    expect_near(runner.displacement(), truth(scene, bench.choices.of(kLinearBem)));
}

TEST(BackgroundWork, AMotionWithoutASolutionFailsOnTheWorkerToo) {
    LiveScene scene = pulled_cube();
    Bench bench;
    bench.settle(scene);
    bench.set_solve_budget(0.0);
    const double most = std::numeric_limits<double>::max();
    scene.set_motion(0, AffineMotion{.matrix = 0.3 * Eigen::Matrix3d::Identity(), .translate = {most, most, most}});
    bench.settle(scene);
    EXPECT_EQ(bench.runner().state(), State::failed);
    scene.set_motion(0, AffineMotion{.matrix = 0.3 * Eigen::Matrix3d::Identity(), .translate = {0, 0.1, 0}});
    bench.settle(scene);
    EXPECT_EQ(bench.runner().state(), State::ready);
    expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(kLinearBem)));
}

TEST(BackgroundWork, ACancelledPrecomputationCanBeTriedAgain) {
    LiveScene scene = cube(10);
    Bench bench;
    bench.update(scene);
    ASSERT_EQ(bench.runner().state(), State::precomputing);
    bench.simulation.runner(kLinearBem).cancel();
    bench.settle(scene);
    EXPECT_EQ(bench.runner().state(), State::idle);
    EXPECT_FALSE(bench.runner().has_answer());
    bench.simulation.runner(kLinearBem).retry();
    bench.choices.complete_up_to = 0;
    bench.settle(scene);
    EXPECT_EQ(bench.runner().state(), State::ready);
    EXPECT_FALSE(bench.runner().has_inverse());
}

TEST(BackgroundWork, ComesToRestWhenAMethodIsComputedThatTheMaterialForbidsMeanwhile) {
    LiveScene scene = cube(8);
    Bench bench({kFem});
    bench.update(scene);
    ASSERT_TRUE(bench.simulation.waiting());
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.5});
    bench.settle(scene);
    EXPECT_FALSE(bench.simulation.busy());
    EXPECT_FALSE(bench.simulation.checking());
    EXPECT_FALSE(bench.update(scene)) << "nothing changes any more";
}

TEST(BackgroundWork, EndsWhileItComputes) {
    LiveScene scene = cube(10);
    Bench bench({all_methods().begin(), all_methods().end()});
    bench.update(scene);
    EXPECT_TRUE(bench.simulation.busy());
}

}  // namespace
}  // namespace elastolab
