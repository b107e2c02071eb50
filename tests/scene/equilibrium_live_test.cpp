// Drags of a method that is not linear: every frame shows where its tangent leads, a worker follows with equilibria.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fem/nonlinear/method.hpp"
#include "scene/motion.hpp"
#include "scene/simulation_bench.hpp"
#include "scene/solve.hpp"

namespace elastolab::testing_simulation {
namespace {

constexpr double kConverged = 1e-6;  ///< of displacements, where the forces balance to 1e-8

const Selector kEnd{PlaneSelector{{4, 0, 0}, {1, 0, 0}, 1e-9}};
const Selector kHalf{BoxSelector{{2, 0, 0}, {4, 1, 1}}};

/// A bar of 4 x 1 x 1 held at one end, with `handle` of it as handle 0.
LiveScene bar(const Selector& handle = kEnd, int cells = 2) {
    Document document;
    document.mesh = Primitive{.name = "beam", .resolution = cells, .size = {}};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    document.handles = {{.name = "end", .select = handle, .motion = AffineMotion{}}};
    return {document, "bar.json"};
}

AffineMotion twist(double degrees) {
    return {.rotate = {.axis = {1, 0, 0}, .degrees = degrees, .center = {4, 0.5, 0.5}}};
}

class LiveEquilibrium : public ::testing::Test {
protected:
    void ask(const AffineMotion& motion) {
        scene.set_motion(0, motion);
        bench.update(scene);
    }
    const MethodRunner& runner() { return bench.runner(kNonlinearFem); }
    const Eigen::VectorXd& u() { return runner().displacement(); }
    /// What the handle's vertices do on the screen, less what they are asked to do.
    double off_handle() {
        const Constraints& asked = scene.constraints();
        double most = 0.0;
        for (std::size_t i = 0; i < asked.set.handles.size(); ++i)
            most = std::max(most, (u().segment<3>(3 * asked.set.handles[i]) -
                                   asked.values.segment<3>(3 * static_cast<Eigen::Index>(i)))
                                      .norm());
        return most;
    }
    void expect_converged(const Eigen::VectorXd& expected) {
        EXPECT_FALSE(runner().following());
        EXPECT_TRUE(runner().converged());
        EXPECT_EQ(runner().state(), State::ready);
        EXPECT_LT((u() - expected).norm(), kConverged * expected.norm());
    }

    LiveScene scene = bar();
    Bench bench{{kNonlinearFem}};
};

TEST_F(LiveEquilibrium, AFrameFollowsAtOnceAndIsExactWhenTheHandRests) {
    bench.settle(scene);
    EXPECT_LT(u().norm(), 1e-12);
    for (const double degrees : {10.0, 25.0, 20.0}) {
        const std::uint64_t before = runner().version();
        ask(twist(degrees));
        EXPECT_GT(runner().version(), before);
        EXPECT_TRUE(runner().following()) << "the worker has not even begun";
        EXPECT_FALSE(runner().converged());
        EXPECT_LT(off_handle(), 1e-9);
        bench.settle(scene);
        expect_converged(truth(scene, bench.choices.of(kNonlinearFem)));
        EXPECT_LT(off_handle(), 1e-9);
    }
}

TEST_F(LiveEquilibrium, TheNewestWishIsServedWhateverWasWishedBefore) {
    bench.settle(scene);
    for (int i = 0; i < 60; ++i) {
        ask(twist(5.0 + 70.0 * std::sin(0.4 * i)));
        EXPECT_LT(off_handle(), 1e-9) << i;
    }
    ask(twist(40));
    bench.settle(scene);
    expect_converged(truth(scene, bench.choices.of(kNonlinearFem)));
}

/// A handle more, where the body was deformed by another one: it is there at once, and nothing has moved.
TEST_F(LiveEquilibrium, AHandleMoreIsPreparedWhereTheBodyIs) {
    ask(twist(60));
    bench.settle(scene);
    const Eigen::VectorXd before = u();
    std::vector<int> patch;
    for (int v = 0; v < scene.mesh().n_vertices(); ++v)
        if (std::abs(scene.mesh().vertices(0, v) - 2.0) < 0.6 && scene.mesh().vertices(2, v) > 1.0 - 1e-9)
            patch.push_back(v);
    bench.simulation.prefetch(scene.constraints_with_handle(patch));
    bench.update_until(scene, [&] { return !runner().preparing(); });
    const int handle = scene.add_handle(patch);
    const Positions rest = scene.rest_positions(handle);
    const Eigen::Matrix3Xd moved = before.reshaped(3, before.size() / 3)(Eigen::all, patch);
    scene.set_motion(handle, motion_to(rest, rest + moved));
    bench.update(scene);
    EXPECT_TRUE(runner().answers());
    EXPECT_FALSE(runner().following());
    EXPECT_LT((u() - before).norm(), 0.01 * before.norm());
    bench.settle(scene);
    expect_converged(truth(scene, bench.choices.of(kNonlinearFem)));
}

/// A body whose equilibria take long enough.
TEST_F(LiveEquilibrium, AFarMotionIsFollowedByStepsWhichAreShown) {
    scene = bar(kEnd, 5);
    bench.settle(scene);
    const std::uint64_t first = runner().version();  // before a worker that is quick has gone its first steps
    ask(twist(150));
    EXPECT_TRUE(runner().following());
    bench.settle(scene);
    EXPECT_GE(runner().version(), first + 5) << "four or more on the way, then the answer";
    expect_converged(truth(scene, bench.choices.of(kNonlinearFem)));
}

TEST_F(LiveEquilibrium, FullTurnsAreWoundUpAndUnwound) {
    bench.settle(scene);
    for (int degrees = 45; degrees <= 360; degrees += 45) {
        ask(twist(degrees));
        bench.settle(scene);
    }
    ASSERT_EQ(scene.constraints().values.cwiseAbs().maxCoeff(), 0.0) << "the end is where it was";
    const Eigen::VectorXd wound = u();
    EXPECT_GT(wound.cwiseAbs().maxCoeff(), 0.5);
    ask(twist(0));
    EXPECT_TRUE(runner().following()) << "the same values, after another number of turns";
    bench.settle(scene);
    EXPECT_LT(u().cwiseAbs().maxCoeff(), 1e-6);
    ask(twist(360));
    bench.settle(scene);
    expect_converged(wound);
    Control control;
    const Solution solved = solve({.scene_file = "bar.json",
                                   .document = scene.document(),
                                   .method = bench.choices.of(kNonlinearFem),
                                   .with_checks = false},
                                  control);
    expect_converged(solved.displacement.reshaped());
}

/// The worker is stopped, and the answer that is there is called what it is.
TEST_F(LiveEquilibrium, AMotionThatIsTakenBackIsNotSolvedFor) {
    scene = bar(kEnd, 5);
    ask(twist(20));
    bench.settle(scene);
    const Eigen::VectorXd before = u();
    ask(twist(150));
    ASSERT_TRUE(runner().following());
    ask(twist(20));
    EXPECT_FALSE(runner().following());
    EXPECT_EQ(runner().state(), State::ready);
    EXPECT_LT((u() - before).norm(), kConverged * before.norm());
    const std::uint64_t version = runner().version();
    bench.settle(scene);
    EXPECT_EQ(runner().version(), version) << "nothing came of the other motion";
    expect_converged(before);
}

/// An end that is pushed on from 120 to 200 degrees, by displacements, which know nothing of turns.
TEST_F(LiveEquilibrium, OneThatIsFoundAnewIsThatFromRest) {
    ask(twist(120));
    bench.settle(scene);
    const Eigen::Matrix3Xd pushed = displacements(Motion(twist(200)), scene.rest_positions(0));
    VertexMotion motion;
    for (Eigen::Index i = 0; i < pushed.cols(); ++i) motion.displacements.emplace_back(pushed.col(i));
    scene.set_motion(0, motion);
    bench.settle(scene);
    const Eigen::VectorXd wound = u(), from_rest = truth(scene, bench.choices.of(kNonlinearFem));
    ASSERT_GT((wound - from_rest).norm(), 0.5 * wound.norm()) << "200 degrees, and 160 the other way";
    bench.simulation.begin_from_rest(kNonlinearFem);
    bench.update(scene);
    EXPECT_TRUE(runner().following());
    EXPECT_EQ(runner().equilibrium(), nullptr);
    EXPECT_EQ(u(), wound) << "what is shown stays until the other is there";
    bench.settle(scene);
    expect_converged(from_rest);
    bench.simulation.begin_from_rest(kNonlinearFem);
    bench.settle(scene);
    expect_converged(from_rest);
}

TEST_F(LiveEquilibrium, AMotionWithoutAnEquilibriumKeepsTheLastAndSaysWhere) {
    scene = bar(kHalf);
    bench.settle(scene);
    ask(twist(30));
    bench.settle(scene);
    const Eigen::VectorXd last = u();
    ask({.matrix = Eigen::Vector3d(0, -2, 0).asDiagonal(), .translate = {0, 1, 0}});  // its mirror image, inside out
    bench.settle(scene);
    bench.update_until(scene, [&] { return runner().state() == State::failed; });
    ASSERT_TRUE(runner().crushed());
    EXPECT_THAT(runner().failure(), HasSubstr("crushed"));
    const Eigen::Vector3d place = runner().crushed()->place;
    EXPECT_GE(place.minCoeff(), -1e-9) << "a place of the body at rest";
    EXPECT_LE((place - Eigen::Vector3d(4, 1, 1)).maxCoeff(), 1e-9);
    EXPECT_LT((u() - last).norm(), kConverged * last.norm());
    bench.update(scene);
    EXPECT_EQ(runner().state(), State::failed) << "it is not tried again and again";
    ask(twist(35));
    bench.settle(scene);
    EXPECT_FALSE(runner().crushed());
    expect_converged(truth(scene, bench.choices.of(kNonlinearFem)));
}

TEST_F(LiveEquilibrium, AStoppedOneIsTriedAgainWhenAskedFor) {
    bench.settle(scene);
    ask(twist(60));
    ASSERT_TRUE(runner().following());
    bench.simulation.runner(kNonlinearFem).cancel();
    bench.settle(scene);
    EXPECT_EQ(runner().state(), State::failed);
    bench.simulation.retry(kNonlinearFem);
    bench.settle(scene);
    expect_converged(truth(scene, bench.choices.of(kNonlinearFem)));
}

/// A soft bar that bends far under its handle's force, in a window that watches every frame. What it shows as exact is
/// compared with what comes out in the end.
class LiveForce : public ::testing::Test {
protected:
    LiveForce() { scene.set_force(0, kForce); }
    const EmbeddedRunner& answer() { return bench.simulation.answer(kNonlinearFem); }
    const MethodRunner& runner() { return bench.runner(kNonlinearFem); }
    Eigen::VectorXd solved() {
        Control control;
        return solve({.scene_file = "bar.json",
                      .document = scene.document(),
                      .method = bench.choices.of(kNonlinearFem),
                      .with_checks = false},
                     control)
            .displacement.reshaped();
    }
    /// Until it rests; in every frame something like `before` or the answer is seen.
    void expect_no_jump_and_no_early_answer(const Eigen::VectorXd& before) {
        const Eigen::VectorXd expected = solved();
        const double least = 0.5 * std::min(before.norm(), expected.norm());
        int n_frames = 0;
        bench.update_until(scene, [&] {
            ++n_frames;
            const Eigen::VectorXd& u = answer().displacement();
            const double seen = u.size() > 0 ? u.norm() : 0.0;
            EXPECT_GT(seen, least) << "in frame " << n_frames;
            if (runner().answers() && !runner().following()) {
                EXPECT_LT((u - expected).norm(), 1e-3 * expected.norm()) << "exact in frame " << n_frames;
            }
            EXPECT_FALSE(runner().state() == State::ready && answer().placing_grips()) << "in frame " << n_frames;
            return !bench.simulation.busy() || HasFailure();
        });
        EXPECT_EQ(bench.simulation.problem(kNonlinearFem), "");
        EXPECT_EQ(runner().state(), State::ready);
        EXPECT_LT((runner().displacement() - expected).norm(), kConverged * expected.norm());
    }
    /// Vertices of the top between these.
    std::vector<int> top(double from, double to) const {
        std::vector<int> patch;
        for (int v = 0; v < scene.mesh().n_vertices(); ++v)
            if (const Eigen::Vector3d x = scene.mesh().vertices.col(v);
                x.x() > from && x.x() < to && x.z() > 1.0 - 1e-9)
                patch.push_back(v);
        return patch;
    }

    static inline const GripForce kForce{{0.0, 0.2, 1.0}, {0.0, 0.0, 0.0}};
    LiveScene scene = [] {
        Document document = bar().document();
        document.material.young_modulus = 100.0;
        document.gravity = Eigen::Vector3d(0, 0, -0.1);
        return LiveScene(document, "bar.json");
    }();
    Bench bench{{kNonlinearFem}};
};

TEST_F(LiveForce, FirstAnswerHasTheHandleWhereItsForceHoldsIt) {
    bench.shown = {kFem};
    bench.settle(scene);
    const Eigen::VectorXd by_linear_fem = bench.simulation.answer(kFem).displacement();
    bench.shown = {kNonlinearFem};
    expect_no_jump_and_no_early_answer(by_linear_fem);
}

TEST_F(LiveForce, AnotherHandleUnderAForceLeavesTheBodyWhereItIsUntilBothAreInEquilibrium) {
    bench.settle(scene);
    const Eigen::VectorXd before = runner().displacement();
    const int handle = scene.add_handle(top(1.5, 3.0));
    scene.set_force(handle, GripForce{{0.0, 0.5, 0.5}, {0.0, 0.0, 0.0}});
    expect_no_jump_and_no_early_answer(before);
    scene.set_force(handle, GripForce{{0.0, 1.0, 0.2}, {0.0, 0.0, 0.0}});
    expect_no_jump_and_no_early_answer(runner().displacement());
}

TEST_F(LiveForce, FoundAnewFromRestIsTheSameWithoutAJump) {
    bench.settle(scene);
    const Eigen::VectorXd before = runner().displacement();
    bench.simulation.begin_from_rest(kNonlinearFem);
    EXPECT_TRUE(runner().following());
    expect_no_jump_and_no_early_answer(before);
}

TEST_F(LiveForce, AHandleThatIsMovedIsFollowedUntilTheForceOfTheOtherOneIsMet) {
    bench.settle(scene);
    const Eigen::VectorXd before = runner().displacement();
    const std::vector<int> patch = top(1.5, 3.0);
    const int handle = scene.add_handle(patch);
    const Positions rest = scene.rest_positions(handle);
    const Eigen::Matrix3Xd moved = before.reshaped(3, before.size() / 3)(Eigen::all, patch);
    scene.set_motion(handle, motion_to(rest, rest + moved));
    expect_no_jump_and_no_early_answer(before);
    AffineMotion further = std::get<AffineMotion>(motion_to(rest, rest + moved));
    further.translate.y() += 0.3;
    scene.set_motion(handle, further);
    bench.update(scene);
    EXPECT_TRUE(runner().following());
    expect_no_jump_and_no_early_answer(before);
}

}  // namespace
}  // namespace elastolab::testing_simulation
