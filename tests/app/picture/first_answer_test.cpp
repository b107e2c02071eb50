// What is shown and written besides the displacements of an answer that is not converged yet.

#include <gtest/gtest.h>

#include "app/files/export_source.hpp"
#include "app/picture/reaction_runner.hpp"
#include "bem/collocation/method.hpp"
#include "mesh/input/import.hpp"
#include "scene/simulation_bench.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::test {
namespace {

/// A pulled cube whose answer is the first one, and the same by a factorisation.
struct FirstAnswer : testing::Test {
    LiveScene scene = testing_simulation::pulled_cube(8);
    EmbeddedRunner embedded{[] {}};
    Control control;
    Deformer exact{precomputed_exactly()};

    FirstAnswer() {
        exact.constrain(scene.constraints().set, control);
        embedded.set_body(scene.body(kLinearBem), {.kind = kLinearBem, .hierarchical_from = 0}, nullptr);
        poll_until([&] { return embedded.runner().answers(); });
    }
    std::shared_ptr<const Model> precomputed_exactly() {
        return precompute(scene.body(kLinearBem), {.kind = kLinearBem, .update = Update::direct}, control);
    }
    template <class Condition>
    void poll_until(const Condition& condition) {
        wait_for([&] {
            embedded.set_constraints(scene.constraints());
            embedded.poll();
            return condition();
        });
    }
};

TEST_F(FirstAnswer, IsConvergedBeforeItIsWritten) {
    const TemporaryFolder folder;
    ASSERT_FALSE(embedded.runner().converged());
    write_export(folder.path() / "moved.obj", export_source(scene, embedded), control);
    const Positions moved = load_surface(folder.path() / "moved.obj").vertices - scene.mesh().vertices;
    const Eigen::VectorXd truth = exact.displace(scene.constraints().values);
    EXPECT_LT((moved.reshaped() - truth).cwiseAbs().maxCoeff(), 1e-6 * truth.cwiseAbs().maxCoeff());
}

TEST_F(FirstAnswer, HasNoReactionsUntilItIsConverged) {
    ASSERT_TRUE(embedded.runner().converging());
    ReactionRunner reactions([] {});
    reactions.update(embedded.runner());
    EXPECT_FALSE(reactions.running()) << "would iterate for what is being iterated for";
    poll_until([&] { return embedded.runner().converged(); });
    wait_for([&] {
        reactions.update(embedded.runner());
        return reactions.surface() != nullptr;
    });
    const Eigen::Matrix3Xd truth = exact.reactions(scene.constraints().values).forces;
    EXPECT_LT((reactions.reactions().forces - truth).norm(), 1e-5 * truth.norm());
}

}  // namespace
}  // namespace elastolab::test
