// What a model says while another thread factorises.
#include <gtest/gtest.h>

#include <thread>

#include "fem/fem_body.hpp"
#include "fem/method.hpp"
#include "fem/model.hpp"
#include "mesh/primitives.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

TEST(Factorising, KeepsNobodyWaitingWhoAsksForThePredictedMemory) {
    const SurfaceMesh surface = make_box(16);
    Control control, its;
    const FemModel model(surface, "box", 0.3, {.kind = kFem}, control);
    const auto face = [&](double x) {
        return test::vertices_where(surface.vertices, surface.n_vertices(),
                                    [x](const Eigen::Vector3d& at) { return at[0] == x; });
    };
    const std::vector<int> fixed = face(0.0), handles{face(1.0).front()};
    const std::uint64_t before = model.constrain_memory(fixed, handles);
    std::jthread worker([&] {
        try {
            model.constrain(fixed, handles, {}, its);
        } catch (const Cancelled&) {
        }
    });
    ASSERT_TRUE(test::wait_until([&] { return its.progress() > 0.0; }));
    EXPECT_EQ(model.constrain_memory(fixed, handles), before)
        << "waited for the factorisation, which is counted no more";
    its.cancel();
    worker.join();
    EXPECT_EQ(model.constrain_memory(fixed, handles), before) << "nothing is kept of what was cancelled";
    model.constrain(fixed, handles, {}, control);
    EXPECT_LT(model.constrain_memory(fixed, handles), before);
}

}  // namespace
}  // namespace elastolab
