// What predict_cost() says beside the clock, until a constrained set can be pulled, by every method on demand: cubes
// held at a face or pulled at a patch only, organic bodies, bars. The prices in src/bem and src/fem (cost.cpp) are
// fitted to such figures: what a change of the kernels does to them is seen here.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/blas.hpp"
#include "findings/cost.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "study/error/organic_body.hpp"
#include "study/setups.hpp"

namespace elastolab {
namespace {

struct HeldBody {
    std::string name;
    SurfaceMesh surface;
    ConstrainedSet set;
};

std::vector<HeldBody> held_bodies() {
    std::vector<HeldBody> bodies;
    for (const int cells : {5, 10, 16, 24}) {
        const SurfaceMesh cube = make_box(cells);
        const Eigen::Vector3d middle(1.0, 0.5, 0.5);
        const auto face = vertices_where(cube, [](const auto& x) { return x[0] < 1e-9; });
        const auto patch =
            vertices_where(cube, [&](const auto& x) { return x[0] > 1.0 - 1e-9 && (x - middle).norm() < 0.26; });
        bodies.push_back({"held cube", cube, {face, patch}});
        bodies.push_back({"free cube", cube, {{}, patch}});
    }
    for (const int n : {150, 600, 1500})
        for (OrganicBody organic : {make_rabbit(n), make_cactus(n)})
            bodies.push_back({organic.name, organic.surface, {organic.fixed, organic.pull}});
    const SurfaceMesh bar = make_box(4, {10.0, 1.0, 1.0});
    bodies.push_back({"bar",
                      bar,
                      {vertices_where(bar, [](const auto& x) { return x[0] < 1e-9; }),
                       vertices_where(bar, [](const auto& x) { return x[0] > 10.0 - 1e-9; })}});
    return bodies;
}

/// predicted_s, and its ratio to the time of an iteration.
void until_it_can_be_pulled(benchmark::State& state, const HeldBody& held, MethodKind kind) {
    const Body body = study_body(held.surface, Material{1.0, 0.3}, held.name);
    const Method method{.kind = kind};
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(3 * std::ssize(held.set.handles));
    const Eigen::MatrixXd basis = translation_basis(held.set.handles.size());
    Control control;
    double seconds = 0.0;
    for (auto _ : state) {
        const Stopwatch watch;
        Deformer deformer(precompute(body, method, control));
        deformer.constrain(held.set, control);
        if (!deformer.linear()) deformer.drag_response(rest, basis);  // which factorises
        seconds += watch.seconds();
    }
    const double predicted = predict_cost(*body.surface, method).seconds();
    state.counters["predicted_s"] = predicted;
    state.counters["ratio"] = predicted * static_cast<double>(state.iterations()) / seconds;
}

}  // namespace
}  // namespace elastolab

int main(int argc, char** argv) {
    using namespace elastolab;
    prepare_parallel_libraries(argv);
    constexpr int kMostForConstant = 1600;  // whose factor of all triangles takes minutes beyond
    const std::vector<HeldBody> bodies = held_bodies();
    for (const HeldBody& held : bodies)
        for (const MethodKind kind : all_methods()) {
            if (kind->shows_averages && held.surface.n_vertices() > kMostForConstant) continue;
            if (!kind->linear && held.set.fixed.empty()) continue;  // nothing holds it
            const std::string name = held.name + " of " + std::to_string(held.surface.n_vertices()) + " vertices, " +
                                     std::string(kind->name);
            benchmark::RegisterBenchmark(name.c_str(), until_it_can_be_pulled, held, kind)
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
        }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
