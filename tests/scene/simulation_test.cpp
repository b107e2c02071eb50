#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "findings/cost.hpp"
#include "methods/registry.hpp"
#include "simulation_bench.hpp"

namespace elastolab {
namespace {

using namespace testing_simulation;

class EveryMethod : public testing::TestWithParam<MethodKind> {};
INSTANTIATE_TEST_SUITE_P(Simulation, EveryMethod, testing::ValuesIn(all_methods()));

TEST_P(EveryMethod, ShowsWhatAFreshComputationSays) {
    LiveScene scene = cube();
    Bench bench({GetParam()});
    bench.settle(scene);
    ASSERT_EQ(bench.runner(GetParam()).state(), State::ready);
    EXPECT_EQ(bench.runner(GetParam()).has_inverse(), GetParam()->full_serves_sets && has(GetParam(), Mode::full))
        << "small: completed by itself";
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0.02, 0}});
    bench.settle(scene);
    expect_near(bench.runner(GetParam()).displacement(), truth(scene, bench.choices.of(GetParam())));
}

TEST_P(EveryMethod, SaysBeforehandWhetherItIsCompletedAndWhatThatTakes) {
    const LiveScene scene = cube();
    Bench bench({GetParam()});
    const std::optional<Method> completion = completion_of(scene.mesh(), GetParam(), bench.choices);
    bench.settle(scene);
    EXPECT_EQ(completion.has_value(), bench.runner(GetParam()).has_inverse());
    if (completion) {
        EXPECT_EQ(bench.runner(GetParam()).model()->method().mode, completion->mode);
        EXPECT_GE(predict_cost(scene.mesh(), *completion).memory_bytes,
                  bench.runner(GetParam()).model()->facts().memory_bytes);
    }
    bench.choices.complete_up_to = scene.mesh().n_vertices() - 1;
    EXPECT_FALSE(completion_of(scene.mesh(), GetParam(), bench.choices));
    bench.choices = {.mode = Mode::full};
    EXPECT_FALSE(completion_of(scene.mesh(), GetParam(), bench.choices)) << "it is computed so at once";
}

/// The answer that somebody waits for comes first; nobody has to ask for the rest.
TEST(Simulation, WhatFurtherSetsTakeOverIsMadeAfterTheFirstAnswer) {
    LiveScene scene = pulled_cube(6);
    Bench bench({kGalerkinBem});
    bench.update_until(scene, [&] { return bench.runner(kGalerkinBem).answers(); });
    const std::shared_ptr<const Model> model = bench.runner(kGalerkinBem).model();
    const std::uint64_t version = bench.runner(kGalerkinBem).version();
    bench.update_until(scene, [&] { return model->serves_sets(); });
    EXPECT_EQ(bench.runner(kGalerkinBem).model(), model);
    EXPECT_EQ(bench.runner(kGalerkinBem).version(), version) << "what is shown stays";
    EXPECT_EQ(bench.runner(kGalerkinBem).state(), State::ready);
    expect_near(bench.runner(kGalerkinBem).displacement(), truth(scene, {.kind = kGalerkinBem}));
    scene.add_handle(where(scene, 0.9, -0.1));
    bench.settle(scene);
    expect_near(bench.runner(kGalerkinBem).displacement(), truth(scene, {.kind = kGalerkinBem}));
}

/// An empty list of prescribed values is an answer as good as any other.
TEST_P(EveryMethod, ABodyWhoseLastHandleIsRemovedComesToRest) {
    LiveScene scene = pulled_cube();
    Bench bench({GetParam()});
    bench.settle(scene);
    ASSERT_GT(bench.runner(GetParam()).displacement().norm(), 0.0);
    scene.remove_handle(0);
    bench.settle(scene);
    EXPECT_EQ(bench.runner(GetParam()).state(), State::ready);
    EXPECT_EQ(bench.runner(GetParam()).displacement().norm(), 0.0);
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
        bench.update(scene);  // in the same frame
        expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(kLinearBem)));
    }
}

TEST(Simulation, EveryFrameRuleAndUpdateShowsTheSame) {
    LiveScene scene = pulled_cube();
    Bench bench;
    const Eigen::VectorXd expected = truth(scene, bench.choices.of(kLinearBem));
    for (const Update update : {Update::direct, Update::eqn9, Update::reduced})
        for (const FrameRule rule : {FrameRule::drag_columns, FrameRule::displace}) {
            bench.choices.mode = Mode::full;
            bench.choices.update = update;
            bench.choices.frame_rule = rule;
            bench.settle(scene);
            expect_near(bench.runner().displacement(), expected);
        }
}

/// Methods are made anew one after the other: what the later ones show meanwhile is not of this scene.
TEST(Simulation, AMethodThatWaitsForItsTurnIsOfTheMaterialBefore) {
    LiveScene scene = pulled_cube();
    Bench bench({kGalerkinBem, kFem});
    bench.settle(scene);
    const Eigen::VectorXd before = bench.runner(kFem).displacement();
    for (const MethodKind kind : bench.shown) EXPECT_FALSE(bench.simulation.is_of_former_model(kind));
    Material material = scene.document().material;
    material.poisson_ratio = 0.1;
    scene.set_material(material);
    bench.update(scene);
    for (const MethodKind kind : bench.shown) EXPECT_TRUE(bench.simulation.is_of_former_model(kind));
    bench.settle(scene);
    for (const MethodKind kind : bench.shown) EXPECT_FALSE(bench.simulation.is_of_former_model(kind));
    EXPECT_GT((bench.runner(kFem).displacement() - before).norm(), 1e-3 * before.norm());
}

/// Another choice of the rims is another model, and the same one for the methods that have no such choice.
TEST(Simulation, FinerRimsAreAnsweredOnceTheyAreChosen) {
    LiveScene scene = pulled_cube();
    Bench bench({kGalerkinBem});
    bench.settle(scene);
    const Eigen::VectorXd given = bench.runner(kGalerkinBem).displacement();
    bench.choices.rims = 1;
    bench.update(scene);
    EXPECT_FALSE(bench.runner(kGalerkinBem).answers()) << "by rims as they were";
    bench.settle(scene);
    const Eigen::VectorXd finer = bench.runner(kGalerkinBem).displacement();
    expect_near(finer, truth(scene, bench.choices.of(kGalerkinBem)));
    EXPECT_GT((finer - given).norm(), 1e-4 * given.norm());
    EXPECT_EQ(bench.choices.of(kGalerkinBem).rims, 1);
    EXPECT_EQ(bench.choices.of(kLinearBem).rims, 0);
    const int handle = scene.add_handle(where(scene, 0.9, -1.0));
    scene.set_motion(handle, AffineMotion{.translate = {0.1, 0, 0}});
    bench.settle(scene);
    expect_near(bench.runner(kGalerkinBem).displacement(), truth(scene, bench.choices.of(kGalerkinBem)));
}

TEST(Simulation, TheOldAnswerStaysWhileAnotherMaterialIsPrecomputed) {
    LiveScene scene = pulled_cube(6);
    Bench bench;
    bench.settle(scene);
    const Eigen::VectorXd before = bench.runner().displacement();
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.45});
    bench.update(scene);
    EXPECT_EQ(bench.runner().state(), State::precomputing);
    EXPECT_EQ(bench.runner().displacement(), before);
    bench.settle(scene);
    expect_near(bench.runner().displacement(), truth(scene, bench.choices.of(kLinearBem)));
}

TEST(Simulation, SwitchingBackIsInstant) {
    LiveScene scene = cube();
    Bench bench;
    bench.settle(scene);
    bench.shown = {kFem};
    bench.settle(scene);
    bench.shown = kLinear;
    bench.update(scene);
    EXPECT_EQ(bench.runner().state(), State::ready);
}

TEST(Simulation, AHiddenMethodComesToAnEnd) {
    LiveScene scene = cube(8);
    Bench bench;
    bench.update(scene);
    ASSERT_TRUE(bench.runner().precomputing());
    bench.shown = {kFem};
    const Stopwatch watch;
    while (bench.runner().precomputing() && watch.seconds() < 60.0) bench.settle(scene);
    EXPECT_FALSE(bench.runner().precomputing());
    EXPECT_TRUE(bench.runner().model());
}

TEST(Simulation, AHiddenMethodForgetsABodyThatIsGone) {
    LiveScene first = cube(2), second = cube(3);
    Bench bench;
    bench.settle(first);
    bench.shown = {kFem};
    bench.settle(second);
    EXPECT_FALSE(bench.runner().model());
    EXPECT_FALSE(bench.runner().surface());
}

TEST(Simulation, AMethodThatCannotTakeTheMaterialSaysSoAndTheOthersGoOn) {
    LiveScene scene = cube();
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.5});
    Bench bench({kFem, kLinearBem});
    bench.settle(scene);
    EXPECT_THAT(bench.simulation.problem(kFem),
                testing::AllOf(testing::StartsWith("poisson_ratio: "), HasSubstr("below 0.5")));
    EXPECT_THAT(bench.simulation.problem(kLinearBem), IsEmpty());
    EXPECT_EQ(bench.runner().state(), State::ready);
}

TEST(Simulation, AnotherMeshReplacesEverything) {
    LiveScene small = cube(2), large = cube(3);
    Bench bench;
    bench.settle(small);
    bench.update(large);
    EXPECT_FALSE(bench.runner().has_answer());
    bench.settle(large);
    EXPECT_EQ(bench.runner().displacement().size(), 3 * large.mesh().n_vertices());
}

TEST(Simulation, AMethodThatWaitsForItsTurnForgetsABodyThatIsGone) {
    LiveScene first = cube(2), second = cube(4);
    Bench bench({all_methods().begin(), all_methods().end()});
    bench.settle(first);
    bench.update(second);
    ASSERT_TRUE(bench.runner(bench.shown.front()).precomputing());
    EXPECT_FALSE(bench.runner(bench.shown.back()).surface());
    EXPECT_FALSE(bench.runner(bench.shown.back()).has_answer());
    bench.settle(second);
    EXPECT_EQ(bench.runner(bench.shown.back()).state(), State::ready);
}

}  // namespace
}  // namespace elastolab
