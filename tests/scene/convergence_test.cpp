// Answers of a method that iterates: to a looser tolerance first, then converged behind it.

#include <gmock/gmock.h>

#include "bem/collocation/method.hpp"
#include "simulation_bench.hpp"

namespace elastolab {
namespace {

using namespace testing_simulation;

double relative_difference(const Eigen::VectorXd& u, const Eigen::VectorXd& truth) {
    return (u - truth).cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff();
}

struct Convergence : testing::Test {
    LiveScene scene = pulled_cube(6);
    Eigen::VectorXd expected = truth(scene, {.kind = kLinearBem});  // by a factorisation
    MethodRunner runner{[] {}};

    Convergence() { runner.set_body(scene.body(kLinearBem), {.kind = kLinearBem, .hierarchical_from = 0}); }
    template <class Condition>
    void poll_until(const Condition& condition) {
        test::wait_for([&] {
            runner.set_constraints(scene.constraints());
            runner.poll();
            return condition();
        });
    }
};

TEST_F(Convergence, FollowsAFirstAnswerWithoutAJump) {
    poll_until([&] { return runner.answers(); });
    EXPECT_EQ(runner.state(), State::ready);
    EXPECT_FALSE(runner.converged());
    EXPECT_TRUE(runner.converging());
    EXPECT_EQ(runner.tolerance(), kFirstTolerance);
    EXPECT_LT(relative_difference(runner.displacement(), expected), 1e-3);
    EXPECT_GT(relative_difference(runner.displacement(), expected), 2e-6) << "iterated for nothing";
    const Deformer* deformer = runner.deformer().get();
    const std::uint64_t version = runner.version();
    poll_until([&] { return runner.answers() && runner.converged(); });
    EXPECT_LT(relative_difference(runner.displacement(), expected), 1e-6);
    EXPECT_EQ(runner.deformer().get(), deformer);
    EXPECT_GT(runner.version(), version);
    EXPECT_FALSE(runner.converging());
}

TEST_F(Convergence, ServesFurtherMotionsToo) {
    poll_until([&] { return runner.answers() && runner.converged(); });
    scene.set_motion(0, AffineMotion{.translate = {0.2, -0.1, 0.1}});
    poll_until([&] { return runner.answers(); });
    EXPECT_TRUE(runner.converged()) << "the same columns";
    EXPECT_LT(relative_difference(runner.displacement(), truth(scene, {.kind = kLinearBem})), 1e-6);
}

TEST_F(Convergence, WaitsForMotionsThatTakeLong) {
    runner.set_solve_budget(0.0);
    poll_until([&] { return runner.answers() && runner.converged(); });
    scene.set_motion(0, AffineMotion{.matrix = 0.2 * Eigen::Matrix3d::Identity(), .translate = {0.1, 0.0, 0.0}});
    poll_until([&] { return runner.answers(); });
    EXPECT_FALSE(runner.converged());
    poll_until([&] { return runner.answers() && runner.converged(); });
    EXPECT_LT(relative_difference(runner.displacement(), truth(scene, {.kind = kLinearBem})), 1e-6);
}

TEST_F(Convergence, ThatIsStoppedLeavesTheFirstAnswer) {
    poll_until([&] { return runner.answers(); });
    ASSERT_TRUE(runner.converging());
    runner.cancel();
    poll_until([&] { return !runner.converging(); });
    for (int frame = 0; frame < 3; ++frame) poll_until([] { return true; });
    EXPECT_FALSE(runner.converging());
    EXPECT_FALSE(runner.converged());
    EXPECT_EQ(runner.state(), State::ready);
    EXPECT_LT(relative_difference(runner.displacement(), expected), 1e-3);
    runner.retry();
    poll_until([&] { return runner.answers() && runner.converged(); });
    EXPECT_LT(relative_difference(runner.displacement(), expected), 1e-6);
}

}  // namespace
}  // namespace elastolab
