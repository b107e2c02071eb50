#include "app/picture/reaction_runner.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "bem/collocation/method.hpp"
#include "scene/simulation_bench.hpp"
#include "scene/slow_method.hpp"

namespace elastolab::test {
namespace {

std::atomic<bool> solves_for_loads{false}, was_cancelled{false};

/// Solves for loads until it is cancelled, or half a minute.
class EndlessSolver : public SlowSolver {
public:
    using SlowSolver::SlowSolver;
    NodeSolution solve_watched(const Eigen::MatrixXd& prescribed, bool want_loads, double,
                               Control& control) const override {
        solves_for_loads = want_loads;
        for (int i = 0; want_loads && i < 30000 && !control.cancelled(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        was_cancelled = control.cancelled();
        control.checkpoint();
        return solve(prescribed, want_loads);
    }
};

class EndlessModel : public SlowModel {
public:
    using SlowModel::SlowModel;
    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                std::span<const UnitLoad>, Control&) const override {
        return std::make_unique<ConstrainedSolid>(
            facts_.n_vertices, constrain_vertices(joined(fixed, handles)), std::vector<LoadShare>{}, nullptr,
            std::make_unique<EndlessSolver>(facts_.n_vertices, false), SolutionChecks{});
    }
};

TEST(ReactionRunner, StopsASolveThatIsNotWantedAnyMore) {
    MethodTraits traits = kLinearBemTraits;
    traits.precompute = [](const SurfaceMesh& surface, const std::string&, double, const Method&, const SolidModel*,
                           Control&) -> std::shared_ptr<const SolidModel> {
        return std::make_shared<EndlessModel>(surface, false);
    };
    const LiveScene scene = testing_simulation::pulled_cube(2);
    MethodRunner runner{[] {}};
    runner.set_body(scene.body(kLinearBem), {.kind = &traits});
    runner.set_constraints(scene.constraints());
    wait_for([&] {
        runner.poll();
        return runner.answers();
    });
    ReactionRunner reactions([] {});
    reactions.update(runner);
    ASSERT_TRUE(wait_until([] { return solves_for_loads.load(); }));
    reactions.rest();
    ASSERT_TRUE(wait_until([&] { return !reactions.working(); }));
    EXPECT_TRUE(was_cancelled);
}

}  // namespace
}  // namespace elastolab::test
