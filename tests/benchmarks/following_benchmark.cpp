// How many equilibria a second follow a hand that turns and pulls the ear of the rabbit by 60 degrees a second there
// and back (nonlinear FEM; what the viewer's worker does: the newest motion, to the tolerance that is shown first, with
// the columns for the frames between), beside one numeric factorisation of the tangent by CHOLMOD.
//   build/release/tests/benchmarks/following_benchmark
#include "benchmarks/tools.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/nonlinear/model.hpp"
#include "fem/quadratic/method.hpp"
#include "scene/constraints.hpp"
#include "scene/live/drag_solver.hpp"
#include "scene/live/set_keeper.hpp"
#include "scene/proxy/carried_constraints.hpp"
#include "scene/scene_mesh.hpp"
#include "scene/wish.hpp"

namespace elastolab::test {
namespace {

constexpr double kDegreesPerSecond = 60.0, kFarthest = 90.0, kSeconds = 6.0;

Document rabbit() {
    Document document;
    document.mesh = MeshFile{ELASTOLAB_ASSETS "/meshes/rabbit.obj"};
    document.fixed = {{.name = "feet", .select = {BoxSelector{{-1, -1, -1}, {1, 1, 0.12}}}}};
    document.handles = {{.name = "ear", .select = {BoxSelector{{0, -1, 2.05}, {1, 1, 3}}}}};
    return document;
}

AffineMotion turned_by(double degrees, const Eigen::Vector3d& center) {
    return {.translate = Eigen::Vector3d(0.0, -0.3, -0.2) * degrees / kFarthest,
            .rotate = {.axis = Eigen::Vector3d::UnitX(), .degrees = degrees, .center = center}};
}

void follow(benchmark::State& state, ElementDegree degree, int proxy_vertices) {
    Control control;
    const Document document = rabbit();
    SceneMesh mesh = load_scene_mesh(document.mesh, "", control);
    const auto shown = std::make_shared<const SurfaceMesh>(mesh.checked.mesh);
    Constraints constraints = make_constraints(document, *shown, "");
    auto surface = shown;
    if (proxy_vertices > 0) {
        const ProxyChoice choice{.use = ProxyUse::always, .n_vertices = proxy_vertices};
        const auto proxy = make_proxy(mesh.name, shown, mesh.checked.report, choice, control);
        CarriedConstraints carried(proxy);
        carried.set(constraints);
        constraints = carried.constraints();
        surface = proxy->surface;
    }
    Method method{.kind = kNonlinearFem};
    method.elements = degree;
    const auto model = precompute({"rabbit", surface, {1.0, 0.3}}, method, control);
    const auto deformer = std::make_shared<Deformer>(model);
    deformer->constrain(constraints.set, control);
    const Eigen::Vector3d center = surface->vertices(Eigen::all, constraints.set.handles).rowwise().mean();
    const Positions rest = surface->vertices(Eigen::all, constraints.set.handles);
    for (auto _ : state) {
        const Stopwatch watch;
        const auto hand = [&] {  // is now
            const double way = std::fmod(kDegreesPerSecond * watch.seconds(), 2.0 * kFarthest);
            constraints.move(0, turned_by(way < kFarthest ? way : 2.0 * kFarthest - way, center), surface->vertices);
            return wish_of(constraints);
        };
        DragSolver drag(deformer, {static_cast<int>(constraints.set.handles.size())});
        std::vector<double> seconds, iterations, behind;
        Wish at = hand();
        while (watch.seconds() < kSeconds) {
            const Wish wanted = hand();
            const std::optional<Wish> step = step_towards(wanted, at, SetKeeper::kFollowTurn, rest);
            const Stopwatch one;
            at = step.value_or(wanted);
            drag.prepare(at.values, step ? SetKeeper::kPassingTolerance : kFirstTolerance, control,
                         {drag.equilibrium(), {}});
            seconds.push_back(one.seconds());
            behind.push_back(turn_between(at.motions[0], hand().motions[0]));
            iterations.push_back(drag.equilibrium()->solids.front()->facts().iterations);
        }
        state.counters["per_second"] = static_cast<double>(seconds.size()) / watch.seconds();
        state.counters["median_ms"] = 1e3 * median(seconds);
        state.counters["median_iterations"] = median(iterations);
        state.counters["median_degrees_behind"] = median(behind);
        state.counters["vertices"] = surface->n_vertices();
        state.counters["unknowns"] = model->facts().n_degrees_of_freedom;
    }
}
BENCHMARK_CAPTURE(follow, four_nodes, ElementDegree::linear, 0)->Iterations(1);
BENCHMARK_CAPTURE(follow, ten_nodes_on_the_proxy, ElementDegree::quadratic, 700)->Iterations(1);

/// A face of the cube that was turned by 90 degrees rests: how long until the equilibrium is shown, and until it is
/// exact. And what a frame costs about it, beside one of linear elasticity on the same elements.
void settle(benchmark::State& state) {
    Control control;
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = 13, .size = {}};
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    document.handles = {{.name = "face", .select = {PlaneSelector{{1, 0, 0}, {1, 0, 0}, 1e-9}}}};
    const auto surface = std::make_shared<const SurfaceMesh>(load_scene_mesh(document.mesh, "", control).checked.mesh);
    Constraints constraints = make_constraints(document, *surface, "");
    const Positions rest = surface->vertices(Eigen::all, constraints.set.handles);
    constraints.move(0, AffineMotion{.rotate = {.axis = {1, 0, 0}, .degrees = 90.0, .center = {1, 0.5, 0.5}}},
                     surface->vertices);
    const Wish wish = wish_of(constraints);
    const auto drag_by = [&](MethodKind kind) {
        const auto deformer =
            std::make_shared<Deformer>(precompute({"cube", surface, {1.0, 0.3}}, {.kind = kind}, control));
        deformer->constrain(constraints.set, control);
        return DragSolver(deformer, wish.ends);
    };
    const auto frame_us = [&](DragSolver& drag) {
        constexpr int kFrames = 1000;
        Eigen::VectorXd u;
        const Stopwatch watch;
        for (int i = 0; i < kFrames; ++i) drag.displace(wish.values * (1.0 + 1e-6 * i), u);
        return 1e6 * watch.seconds() / kFrames;
    };
    for (auto _ : state) {
        DragSolver drag = drag_by(kNonlinearFem), linear = drag_by(kQuadraticFem);
        drag.prepare(wish.values * 0.0, kFirstTolerance, control, {});
        const Stopwatch watch;
        drag.prepare(wish.values, kFirstTolerance, control, {nullptr, way_to(wish, nullptr, rest).path});
        state.counters["first_s"] = watch.seconds();
        drag.converge(control);
        state.counters["exact_s"] = watch.seconds();
        linear.prepare(wish.values, kSolveTolerance, control, {});
        linear.prepare(wish.values * 1.1, kSolveTolerance, control, {});  // the motion is an affine one
        state.counters["frame_us"] = frame_us(drag);
        state.counters["linear_frame_us"] = frame_us(linear);
    }
}
BENCHMARK(settle)->Iterations(1);

}  // namespace
}  // namespace elastolab::test

int main(int argc, char** argv) { elastolab::test::run_benchmarks(argc, argv); }
