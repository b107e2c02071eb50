// No frame waits for a computation, however long the method takes.

#include <gmock/gmock.h>

#include <array>

#include "bem/collocation/method.hpp"
#include "fem/method.hpp"
#include "scene/live/embedded_runner.hpp"
#include "simulation_bench.hpp"
#include "slow_method.hpp"

namespace elastolab {
namespace {

using namespace testing_simulation;
using test::slow_calls;

struct SlowFrames : testing::TestWithParam<std::pair<FrameRule, bool>> {
    LiveScene scene = cube(2);
    MethodRunner runner{[] {}};
    Method method = GetParam().second ? test::slow_method<true>() : test::slow_method<false>();

    SlowFrames() {
        slow_calls.restart();
        runner.set_frame_rule(GetParam().first);
    }
    void frame() {
        runner.set_body(scene.body(kLinearBem), method);
        runner.set_constraints(scene.constraints());
        runner.poll();
    }
    void settle() {
        test::wait_for([&] {
            frame();
            return runner.answers() && runner.converged() && runner.state() == State::ready;
        });
    }
    void pull(int handle, const AffineMotion& motion) {
        scene.set_motion(handle, motion);
        settle();
    }
    /// What the slow method says: the mean of what is prescribed.
    Eigen::Vector3d mean() const {
        const Constraints& constraints = scene.constraints();
        const auto n = static_cast<double>(constraints.set.fixed.size() + constraints.set.handles.size());
        return Eigen::Map<const Eigen::Matrix3Xd>(constraints.values.data(), 3, constraints.values.size() / 3)
                   .rowwise()
                   .sum() /
               n;
    }
};

TEST_P(SlowFrames, LeaveEveryComputationToTheWorkers) {
    settle();
    const int first = scene.add_handle(where(scene, 0.9, 0.6));
    pull(first, {.translate = {0.1, 0.0, 0.0}});
    pull(first, {.translate = {0.1, 0.2, 0.0}});
    EXPECT_GT(runner.set_memory(), 0u) << "what the panel shows";
    std::vector<int> lower_edge = where(scene, 0.9, -0.1);
    std::erase_if(lower_edge, [&](int v) { return scene.mesh().vertices(1, v) > 0.1; });
    const int second = scene.add_handle(lower_edge);
    pull(second, {.translate = {0.0, 0.0, 0.3}});
    pull(first, {.matrix = 0.1 * Eigen::Matrix3d::Identity(), .translate = {0.1, 0.2, 0.0}});
    for (const FrameRule rule : {FrameRule::displace, FrameRule::drag_columns}) {
        runner.set_frame_rule(rule);
        pull(first, {.translate = {0.2, 0.2, 0.0}});
        pull(second, {.matrix = 0.2 * Eigen::Matrix3d::Identity()});
    }
    scene.set_material({.young_modulus = 1.0, .poisson_ratio = 0.1});
    settle();
    pull(first, {.translate = {0.3, 0.2, 0.0}});
    EXPECT_LT((runner.displacement().head<3>() - mean()).norm(), 1e-6);
    EXPECT_EQ(slow_calls.by_watcher, 0);
    EXPECT_GT(slow_calls.by_others, 20);
}

TEST_P(SlowFrames, FollowAMotionThatGoesOn) {
    const int handle = scene.add_handle(where(scene, 0.9, 0.6));
    settle();
    const std::uint64_t before = runner.version();
    double x = 0.0;
    test::wait_for([&] {
        scene.set_motion(handle, AffineMotion{.translate = {x += 1e-3, 0.0, 0.0}});
        frame();
        return runner.version() > before + 2 && runner.displacement()[0] > 0.0;
    });
    EXPECT_EQ(slow_calls.by_watcher, 0);
}

/// Where a force holds a handle is a matter of several solves. Two handles on the far face, one of them under a force.
struct SlowForces : testing::TestWithParam<bool> {
    LiveScene scene = cube(2);
    int held = scene.add_handle(where(scene, 0.9, 0.6));
    int moved = scene.add_handle(low_corner());
    Method method = GetParam() ? test::slow_method<true>() : test::slow_method<false>();
    EmbeddedRunner runner{[] {}};

    SlowForces() {
        slow_calls.restart();
        scene.set_force(held, GripForce{{0.5, 0.0, 0.0}});
    }
    std::vector<int> low_corner() const {
        std::vector<int> corner = where(scene, 0.9, -0.1);
        std::erase_if(corner, [&](int v) { return scene.mesh().vertices(1, v) > 0.1; });
        return corner;
    }
    void frame() {
        runner.set_body(scene.body(kLinearBem), method, nullptr);
        runner.set_constraints(scene.constraints());
        runner.poll();
    }
    void settle() {
        test::wait_for([&] {
            frame();
            return runner.ready() && runner.runner().answers() && runner.runner().converged();
        });
    }
    void move_while_it_is_placed() {
        settle();
        scene.set_motion(moved, AffineMotion{.translate = {0.1, 0.0, 0.0}});
        frame();
        ASSERT_TRUE(runner.placing_grips());
    }
    double placed_at() const { return runner.grip_motions().at(0).translate.x(); }
};

TEST_P(SlowForces, AreAnsweredByTheWorkers) {
    settle();
    ASSERT_EQ(runner.grip_motions().size(), 1u) << runner.grip_failure();
    const double first = placed_at();
    EXPECT_GT(first, 0.0);
    scene.set_motion(moved, AffineMotion{.translate = {0.1, 0.0, 0.0}});
    settle();
    scene.set_force(held, GripForce{{1.0, 0.0, 0.0}});
    settle();
    EXPECT_NEAR(placed_at(), 2.0 * first, 1e-9 * first);
    EXPECT_EQ(slow_calls.by_watcher, 0);
}

/// What was stopped says so, and begins again when it is told to.
TEST_P(SlowForces, CanBeStopped) {
    move_while_it_is_placed();
    runner.cancel();
    test::wait_for([&] {
        frame();
        return !runner.placing_grips();
    });
    EXPECT_THAT(runner.grip_failure(), testing::HasSubstr("stopped"));
    runner.retry();
    settle();
    EXPECT_THAT(runner.grip_failure(), testing::IsEmpty());
}

TEST_P(SlowForces, AreNotWaitedForOnceTheyAreGone) {
    move_while_it_is_placed();
    scene.set_force(held, std::nullopt);
    settle();
    EXPECT_TRUE(runner.grip_motions().empty());
}

/// Until it is known where another handle goes, nothing is said of it.
TEST_P(SlowForces, OfOneHandleAreNotThoseOfAnother) {
    settle();
    ASSERT_EQ(runner.grip_motions().size(), 1u);
    scene.set_force(held, std::nullopt);
    scene.set_force(moved, GripForce{{0.0, 0.5, 0.0}});
    frame();
    EXPECT_TRUE(runner.grip_motions().empty());
    settle();
    ASSERT_EQ(runner.grip_motions().size(), 1u);
    EXPECT_GT(runner.grip_motions()[0].translate.y(), 0.0);
    runner.set_body(scene.body(kFem), method, nullptr);
    runner.clear();
    EXPECT_TRUE(runner.grip_motions().empty());
}

INSTANTIATE_TEST_SUITE_P(Methods, SlowForces, testing::Bool());

INSTANTIATE_TEST_SUITE_P(Rules, SlowFrames,
                         testing::Values(std::pair{FrameRule::drag_columns, false},
                                         std::pair{FrameRule::drag_columns, true},
                                         std::pair{FrameRule::displace, false}, std::pair{FrameRule::displace, true}));

}  // namespace
}  // namespace elastolab
