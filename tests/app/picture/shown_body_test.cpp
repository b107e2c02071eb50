#include "app/picture/shown_body.hpp"

#include <gmock/gmock.h>

#include <utility>

#include "app/stage.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "methods/registry.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A cube that is pulled at the right face.
class ShownBodyTest : public testing::Test {
protected:
    ShownBodyTest() {
        std::vector<int> right;
        for (int v = 0; v < stage.scene().mesh().n_vertices(); ++v)
            if (stage.scene().mesh().vertices(0, v) > 0.99) right.push_back(v);
        stage.scene().add_handle(right);
        stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0, 0.05}});
        stage.settle();
    }
    ViewerState& state = stage_.state;
    test::Stage& stage = stage_;
    const ShownBody& shown(MethodKind kind = kLinearBem) { return *state.shown.body(kind); }
    Eigen::Map<const Eigen::Matrix3Xd> u(MethodKind kind = kLinearBem) {
        const Eigen::VectorXd& all = state.simulation.runner(kind).displacement();
        return {all.data(), 3, all.size() / 3};
    }
    void show(Field field) {
        state.display.field = field;
        stage.settle();
    }

private:
    test::Stage stage_{3};
};

TEST_F(ShownBodyTest, PositionsAreRestAndScaledDisplacement) {
    state.display.deformation_scale = 2.5;
    stage.settle();
    const Positions expected = stage.scene().mesh().vertices + 2.5 * u();
    EXPECT_LT((shown().positions() - expected).norm(), 1e-12);
    EXPECT_NEAR(shown().max_displacement(), u().colwise().norm().maxCoeff(), 1e-12);
}

TEST_F(ShownBodyTest, DoesNothingWhenNothingChanged) {
    const std::uint64_t before = shown().revision();
    EXPECT_FALSE(state.update_picture());
    EXPECT_EQ(shown().revision(), before);
    show(Field::displacement);
    EXPECT_GT(shown().revision(), before);
}

TEST_F(ShownBodyTest, DisplacementIsItsMagnitude) {
    EXPECT_THAT(shown().values(), IsEmpty());
    show(Field::displacement);
    ASSERT_EQ(std::ssize(shown().values()), u().cols());
    for (Eigen::Index v = 0; v < u().cols(); ++v)
        EXPECT_NEAR(shown().values()[static_cast<std::size_t>(v)], u().col(v).norm(), 1e-6);
    EXPECT_NEAR(state.shown.field_range(state.display).second, u().colwise().norm().maxCoeff(), 1e-6);
}

TEST_F(ShownBodyTest, TractionAndStressAreLargestWhereTheBodyIsHeld) {
    for (const Field field : {Field::traction, Field::von_mises}) {
        show(field);
        ASSERT_EQ(std::ssize(shown().values()), u().cols());
        const auto& values = shown().values();
        const auto worst = std::max_element(values.begin(), values.end()) - values.begin();
        EXPECT_NE(stage.scene().owner(static_cast<int>(worst)), LiveScene::kNobody);
        EXPECT_GT(shown().largest_magnitude(), 0.0);
    }
}

TEST_F(ShownBodyTest, ReactionsBalance) {
    state.method = kFem;  // exactly; those of BEM as far as the mesh is fine
    state.display.arrows = true;
    stage.settle();
    const ShownBody& body = shown(kFem);
    ASSERT_THAT(body.reactions(), SizeIs(2));
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
    for (const ShownReaction& reaction : body.reactions()) {
        force += reaction.force;
        moment += reaction.moment;
    }
    const double size = body.reactions()[1].force.norm();
    EXPECT_EQ(body.reactions()[0].name, "fixed");
    EXPECT_GT(body.reactions()[1].force.x(), 0.0);
    EXPECT_LT(force.norm(), 1e-6 * size);
    EXPECT_LT(moment.norm(), 1e-6 * size);
}

/// Else an arrow as long as any other would show what rounding has left.
TEST_F(ShownBodyTest, AForceThatVanishesIsZero) {
    for (const MethodKind kind : {kFem, kGalerkinBem}) {
        state.method = kind;
        state.display.arrows = true;
        stage.scene().set_force(0, GripForce{.force = Eigen::Vector3d::Zero(), .moment = {0.0, 1e-3, 2e-3}});
        stage.settle();
        ASSERT_THAT(shown(kind).reactions(), SizeIs(2));
        for (const ShownReaction& reaction : shown(kind).reactions()) {
            EXPECT_EQ(reaction.force, Eigen::Vector3d::Zero().eval());
            EXPECT_GT(reaction.moment_about_middle().norm(), 1e-4);
        }
    }
}

TEST_F(ShownBodyTest, EveryFixedSetHasAForceOfItsOwn) {
    state.method = kFem;
    state.display.arrows = true;
    std::vector<int> upper;
    for (const int v : stage.scene().vertices(LiveScene::kFixed))
        if (stage.scene().mesh().vertices(2, v) > 0.5) upper.push_back(v);
    stage.settle();
    const Eigen::Vector3d before = shown(kFem).reactions()[0].force;
    stage.scene().unfix(upper);
    stage.scene().fix(upper, 1);
    stage.scene().rename_fixed_set(1, "upper");
    stage.settle();
    const auto& told = shown(kFem).reactions();
    ASSERT_THAT(told, SizeIs(3));
    EXPECT_EQ(told[0].name, "fixed");
    EXPECT_EQ(told[1].name, "upper");
    EXPECT_TRUE(told[1].fixed);
    EXPECT_FALSE(told[2].fixed);
    EXPECT_GT(told[1].place.z(), told[0].place.z());
    EXPECT_LT((told[0].force + told[1].force - before).norm(), 1e-9 * before.norm());
    EXPECT_GT((told[0].force - told[1].force).norm(), 1e-3 * before.norm());
}

TEST_F(ShownBodyTest, WhileTheAnswerIsOfAnEarlierSetForcesKeepTheirNames) {
    state.method = kFem;
    state.display.arrows = true;
    std::vector<int> upper;
    for (const int v : stage.scene().vertices(LiveScene::kFixed))
        if (stage.scene().mesh().vertices(2, v) > 0.5) upper.push_back(v);
    stage.scene().unfix(upper);
    stage.scene().fix(upper, 1);
    stage.settle();
    const std::vector<ShownReaction> before = shown(kFem).reactions();
    ASSERT_THAT(before, SizeIs(3));
    ASSERT_GT((before[1].force - before[0].force).norm(), 1e-3 * before[0].force.norm());
    stage.scene().remove_fixed_set(0);
    state.update_picture();  // no displacements yet
    const auto& told = shown(kFem).reactions();
    ASSERT_THAT(told, SizeIs(2));
    for (std::size_t i : {0, 1}) {
        EXPECT_EQ(told[i].name, before[i + 1].name);
        EXPECT_EQ(told[i].fixed, before[i + 1].fixed);
        EXPECT_EQ(told[i].force, before[i + 1].force);
    }
    stage.scene().rename_handle(0, "another");
    state.update_picture();
    EXPECT_THAT(shown(kFem).reactions(), SizeIs(1)) << "the answer knows none of that name";
}

TEST_F(ShownBodyTest, AMotionWithoutASolutionIsToldAndEndsNothing) {
    for (const MethodKind kind : all_methods())
        for (const Field field : {Field::traction, Field::von_mises}) {
            stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0, 0.05}});
            state.method = kind;
            state.display.arrows = true;
            show(field);
            ASSERT_THAT(shown(kind).reactions(), SizeIs(2));
            stage.scene().set_motion(0, AffineMotion{.translate = {1e308, 1e308, 0}});
            EXPECT_NO_THROW(stage.settle());
            if (!kind->linear) {  // the last equilibrium stays, and it is said
                EXPECT_FALSE(state.simulation.runner(kind).failure().empty());
                continue;
            }
            EXPECT_FALSE(state.shown.reaction_failure(kind).empty());
            EXPECT_THAT(shown(kind).reactions(), IsEmpty());
            EXPECT_FALSE(shown(kind).is_coloured());
            const std::uint64_t before = shown(kind).revision();
            for (int i = 0; i < 3; ++i) stage.frame();
            EXPECT_EQ(shown(kind).revision(), before) << "solved again";
        }
    stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0, 0.05}});
    stage.settle();
    EXPECT_THAT(shown(all_methods().back()).reactions(), SizeIs(2));
    EXPECT_EQ(state.shown.reaction_failure(all_methods().back()), "");
}

TEST_F(ShownBodyTest, ReactionsAreThoseOfTheLastMotion) {
    state.method = kFem;
    state.display.arrows = true;
    stage.settle();
    const Eigen::Vector3d before = shown(kFem).reactions()[1].force;
    for (const double factor : {1.5, 2.0, 3.0}) {  // the first on the worker, the others as fast as it was
        stage.scene().set_motion(0, AffineMotion{.translate = factor * Eigen::Vector3d(0.1, 0, 0.05)});
        stage.settle();
        EXPECT_LT((shown(kFem).reactions()[1].force - factor * before).norm(), 1e-9 * before.norm());
    }
}

TEST(ReactionRunners, SolveOnTheWorkerWhatTakesLongAndKeepTheLastMeanwhile) {
    test::Stage stage(3);
    stage.scene().add_handle(std::vector<int>{stage.vertex_near({1, 1, 1})});
    stage.scene().set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    stage.settle();
    const MethodRunner& answer = stage.state.simulation.runner(stage.state.method);
    ReactionRunner runner([] {});
    runner.set_solve_budget(0.0);
    const auto wait = [&] {
        test::wait_for([&] {
            if (runner.running()) runner.update(answer);
            return !runner.running();
        });
    };
    runner.update(answer);
    EXPECT_TRUE(runner.running());
    EXPECT_EQ(runner.surface(), nullptr);
    wait();
    EXPECT_EQ(runner.surface(), &stage.scene().mesh());
    const Eigen::Matrix3Xd first = runner.reactions().forces;
    stage.scene().set_motion(0, AffineMotion{.translate = {0.2, 0, 0}});
    stage.frame();
    runner.update(answer);
    EXPECT_TRUE(runner.running());
    EXPECT_EQ(runner.reactions().forces, first);
    wait();
    EXPECT_LT((runner.reactions().forces - 2.0 * first).norm(), 1e-9 * first.norm());
    runner.set_solve_budget(1e9);
    stage.scene().set_motion(0, AffineMotion{.translate = {0.3, 0, 0}});
    stage.frame();
    runner.update(answer);
    EXPECT_FALSE(runner.running());
    EXPECT_LT((runner.reactions().forces - 3.0 * first).norm(), 1e-9 * first.norm());
}

TEST_F(ShownBodyTest, StressIsOfTheMaterialThatAnswered) {
    show(Field::von_mises);
    const std::vector<float> before = shown().values();
    stage.scene().set_material({.young_modulus = 1.0, .poisson_ratio = 0.05});
    stage.frame();
    ASSERT_TRUE(state.simulation.busy()) << "the old model still answers";
    state.display.deformation_scale = 2.0;  // whatever makes it be computed anew
    state.update_picture();
    EXPECT_EQ(shown().values(), before);
    stage.settle();
    EXPECT_NE(shown().values(), before);
}

TEST_F(ShownBodyTest, DifferencesAreToTheReference) {
    state.compare.mode = CompareMode::side_by_side;
    state.compare.reference = kFem;
    show(Field::difference);
    const Eigen::RowVectorXd d = (u(kLinearBem) - u(kFem)).colwise().norm();
    ASSERT_TRUE(shown().difference());
    const Difference& difference = *shown().difference();
    EXPECT_NEAR(difference.max, d.maxCoeff(), 1e-12);
    EXPECT_NEAR(difference.rms, std::sqrt(d.squaredNorm() / static_cast<double>(d.size())), 1e-12);
    EXPECT_NEAR(d[difference.worst_vertex], difference.max, 1e-12);
    EXPECT_NEAR(difference.relative_max, difference.max / u(kFem).colwise().norm().maxCoeff(), 1e-12);
    EXPECT_NEAR(shown().largest_magnitude(), difference.max, 1e-6);
    EXPECT_FALSE(shown(kFem).difference());
    EXPECT_EQ(shown(kFem).largest_magnitude(), 0.0);
}

TEST_F(ShownBodyTest, DifferencesFollowTheReference) {
    state.compare.mode = CompareMode::ghosts;
    show(Field::difference);
    const double before = shown(kFem).difference()->max;
    stage.scene().set_motion(0, AffineMotion{.translate = {0.2, 0, 0.1}});
    stage.settle();
    EXPECT_NEAR(shown(kFem).difference()->max, 2.0 * before, 1e-9);
}

TEST_F(ShownBodyTest, OnlyAnswersToTheSameSceneAreCompared) {
    state.compare.mode = CompareMode::side_by_side;
    state.compare.reference = kFem;
    show(Field::difference);
    ASSERT_TRUE(shown().difference());
    stage.scene().set_material({.young_modulus = 1.0, .poisson_ratio = 0.45});
    bool first = true;
    test::wait_for([&] {
        stage.frame();
        const auto ratio = [&](MethodKind kind) {
            return state.simulation.runner(kind).model()->body().material.poisson_ratio;
        };
        EXPECT_FALSE(std::exchange(first, false) && shown().difference());
        EXPECT_TRUE(!shown().difference() || ratio(kLinearBem) == ratio(kFem));
        return !state.simulation.busy();
    });
    stage.frame();
    EXPECT_TRUE(shown().difference());
}

TEST_F(ShownBodyTest, ADifferenceAloneHasTheReferenceComputed) {
    state.method = kFem;
    show(Field::difference);
    ASSERT_TRUE(shown(kFem).difference());
    EXPECT_GT(shown(kFem).difference()->max, 0.0);
    EXPECT_THAT(state.shown.bodies(), SizeIs(1));
}

TEST_F(ShownBodyTest, IsAtRestBeforeTheFirstAnswer) {
    stage.scene().clear_handles();
    const Document document = stage.scene().document();
    state.files.open_document(document, "scene.json");
    state.display.field = Field::von_mises;
    state.display.arrows = true;
    stage.frame();
    EXPECT_EQ(shown().positions(), stage.scene().mesh().vertices);
}

}  // namespace
}  // namespace elastolab
