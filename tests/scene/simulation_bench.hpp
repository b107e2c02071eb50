#pragma once

#include <gmock/gmock.h>

#include <limits>

#include "bem/collocation/method.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "scene/live/simulation.hpp"
#include "support/wait_until.hpp"

namespace elastolab::testing_simulation {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using State = MethodRunner::State;

inline const std::vector<MethodKind> kLinear = {kLinearBem};

/// The unit cube, its left face fixed.
inline LiveScene cube(int cells = 3) {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = cells, .size = {}};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    return {document, "cube.json"};
}

inline std::vector<int> where(const LiveScene& scene, double x_min, double y_min) {
    std::vector<int> vertices;
    for (int v = 0; v < scene.mesh().n_vertices(); ++v)
        if (scene.mesh().vertices(0, v) > x_min && scene.mesh().vertices(1, v) > y_min) vertices.push_back(v);
    return vertices;
}

/// The cube with handle 0 pulled.
inline LiveScene pulled_cube(int cells = 3) {
    LiveScene scene = cube(cells);
    scene.add_handle(where(scene, 0.9, 0.6));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0, 0}});
    return scene;
}

/// What a fresh computation says.
inline Eigen::VectorXd truth(const LiveScene& scene, const Method& method) {
    Control control;
    Deformer deformer(precompute(scene.body(method.kind), method, control));
    deformer.constrain(scene.constraints().set, control);
    return deformer.displace(scene.constraints().values);
}

inline void expect_near(const Eigen::VectorXd& u, const Eigen::VectorXd& expected) {
    ASSERT_EQ(u.size(), expected.size());
    EXPECT_LT((u - expected).norm(), 1e-9 * expected.norm());
}

/// A simulation with its choices, updated like a window would.
struct Bench {
    /// However slow the machine, answers within a set come in the frame that asks for them.
    explicit Bench(std::vector<MethodKind> kinds = kLinear) : shown(std::move(kinds)) {
        set_solve_budget(std::numeric_limits<double>::infinity());
        choices.preview = false;  // but in tests of it
    }

    Simulation simulation{[] {}};
    MethodChoices choices;
    std::vector<MethodKind> shown;

    void set_solve_budget(double seconds) {
        for (const MethodKind kind : all_methods()) simulation.runner(kind).set_solve_budget(seconds);
    }
    bool update(const LiveScene& scene) { return simulation.update(scene, shown, choices); }
    /// One update at least.
    template <class Condition>
    void update_until(const LiveScene& scene, const Condition& condition) {
        test::wait_for([&] {
            update(scene);
            return condition();
        });
    }
    void settle(const LiveScene& scene) {
        update_until(scene, [&] { return !simulation.busy(); });
        update(scene);
    }
    const MethodRunner& runner(MethodKind kind = kLinearBem) { return simulation.runner(kind); }
};

}  // namespace elastolab::testing_simulation
