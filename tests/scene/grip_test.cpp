// The stiffness of a handle's grip, and the loop that asks it for forces a thousand times a second.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <thread>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "scene/constraints.hpp"
#include "scene/live/haptic_loop.hpp"
#include "scene/loaded_cube.hpp"
#include "scene/scene_mesh.hpp"

namespace elastolab {
namespace {

/// A scene's body with its constraints; that of the cube with a held edge.
struct Grasped {
    Control control;
    std::shared_ptr<Deformer> deformer;
    Eigen::VectorXd values;

    explicit Grasped(MethodKind kind, const Document& document = loaded_cube()) {
        const SceneMesh mesh = load_scene_mesh(document.mesh, "scene.json", control);
        const Constraints constraints = make_constraints(document, mesh.checked.mesh, "scene.json");
        const Body body{"cube", std::make_shared<const SurfaceMesh>(mesh.checked.mesh), document.material};
        deformer = std::make_shared<Deformer>(precompute(body, {.kind = kind}, control));
        deformer->constrain(constraints.set, control);
        values = constraints.values;
    }
    GripStiffness stiffness() {
        return {*deformer, values, {{0, static_cast<int>(deformer->set().handles.size())}}, control};
    }
};

Eigen::VectorXd motion_at(double phase) {
    const double a = 2.0 * std::numbers::pi * phase;
    Eigen::VectorXd motion(6);
    motion << 0.03 * std::sin(a), 0.02 * (1.0 - std::cos(a)), 0.02 * std::sin(2.0 * a), 0.1 * std::sin(a),
        0.2 * (1.0 - std::cos(a)), -0.1 * std::sin(3.0 * a);
    return motion;
}

TEST(GripStiffness, IsSymmetricAndDoesNoWorkAroundAClosedPathByFemAndGalerkin) {
    for (const MethodKind kind : {kFem, kQuadraticFem, kGalerkinBem}) {
        const GripStiffness grip = Grasped(kind).stiffness();
        EXPECT_LT((grip.matrix() - grip.matrix().transpose()).norm(), 1e-9 * grip.matrix().norm()) << name(kind);
        double work = 0.0, size = 0.0;
        constexpr int kSteps = 500;
        for (int i = 0; i < kSteps; ++i) {
            const Eigen::VectorXd a = motion_at(i / double{kSteps}), b = motion_at((i + 1) / double{kSteps});
            const double step = grip.forces(0.5 * (a + b)).dot(b - a);  // exact: forces are linear
            work += step;
            size += std::abs(step);
        }
        EXPECT_LT(std::abs(work), 1e-9 * size) << name(kind);
    }
}

/// A bar of one cell across that two handles hold against its weight. The reactions of constant elements to it add up
/// to another weight by more than a fifth, which is no reason to refuse forces that balance, nor to take others.
TEST(GripStiffness, JudgesTheBalanceByTheLoadsThemselves) {
    Document document;
    document.mesh = Primitive{.name = "beam", .resolution = 1, .size = {}};
    document.material = {1e4, 0.3};
    document.density = 20.0;
    document.gravity = Eigen::Vector3d(0, 0, -10);
    for (const double x : {0.0, 4.0}) {
        document.handles.push_back({.name = x > 0.0 ? "right" : "left", .select = {BoxSelector{{x, 0, 0}, {x, 1, 1}}}});
        document.handles.back().force = GripForce{};
    }
    Eigen::VectorXd halves = Eigen::VectorXd::Zero(12);  // of a weight of 800
    halves[2] = halves[8] = 400.0;
    for (const MethodKind kind : {kConstantBem, kLinearBem, kGalerkinBem, kFem}) {
        const Grasped grasped(kind, document);
        Control control;
        GripStiffness stiffness(*grasped.deformer, grasped.values, {{0, 4}, {4, 8}}, control);
        EXPECT_GT(stiffness.motions(halves).norm(), 0.0) << name(kind);
        for (const int row : {1, 2, 3}) {  // across, against the weight, and a moment about the bar
            const Eigen::VectorXd more = halves + 8.0 * Eigen::VectorXd::Unit(12, row);
            EXPECT_THROW(stiffness.motions(more), SolveError) << name(kind) << ", row " << row;
        }
        EXPECT_THROW(stiffness.motions(Eigen::VectorXd::Zero(12)), SolveError) << name(kind);
        stiffness.set_others(*grasped.deformer, Eigen::VectorXd::Zero(grasped.values.size()), control);
        EXPECT_THROW(stiffness.motions(halves), SolveError) << name(kind) << ", without weight";
        EXPECT_LT(stiffness.motions(Eigen::VectorXd::Zero(12)).norm(), 1e-12) << name(kind);
    }
}

TEST(HapticLoop, GivesTheForcesOfASolveAndCountsItsTicks) {
    Grasped grasped(kFem);
    const GripStiffness grip = grasped.stiffness();
    std::mutex mutex;
    std::vector<std::pair<GripPose, FeltForce>> felt;
    GripPose last;
    HapticTimings timings;
    {
        HapticLoop loop(
            grip,
            [&](double seconds) {
                const Eigen::VectorXd motion = motion_at(seconds);
                last = {motion.head<3>(), motion.tail<3>()};
                return last;
            },
            [&](double, const FeltForce& force) {
                const std::scoped_lock lock(mutex);
                felt.emplace_back(last, force);
            });
        const auto enough = [&] {
            const std::scoped_lock lock(mutex);
            return felt.size() >= 50;
        };
        while (!enough()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        timings = loop.timings();
    }
    EXPECT_GE(timings.ticks, 49u);
    EXPECT_GT(timings.computation_p999_ms, 0.0);
    for (const std::size_t i : {std::size_t{0}, felt.size() / 2, felt.size() - 1}) {
        Eigen::VectorXd motion(6), values = grasped.values;
        motion << felt[i].first.shift, felt[i].first.turn;
        grip.move(motion, values);
        const Reactions reactions = grasped.deformer->reactions(values);
        const Eigen::Index n = std::ssize(grasped.deformer->set().handles);
        const Eigen::Vector3d force = reactions.forces.rightCols(n).rowwise().sum();
        const Eigen::Vector3d moment = reactions.moments.rightCols(n).rowwise().sum() - grip.middle(0).cross(force);
        EXPECT_LT((felt[i].second.force + force).norm(), 1e-9 * force.norm());
        EXPECT_LT((felt[i].second.moment + moment).norm(), 1e-9 * (moment.norm() + force.norm()));
    }
}

}  // namespace
}  // namespace elastolab
