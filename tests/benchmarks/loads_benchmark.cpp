// Loads beside handles: a frame in which the sizes of loads change beside one in which a handle moves, and a new load
// beside a new handle of as many vertices, both on a set whose fixed vertices are constrained already.
//   build/release/tests/benchmarks/loads_benchmark

#include <algorithm>
#include <memory>

#include "benchmarks/tools.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

constexpr int kPatch = 40;  ///< vertices of the loaded patch, and of the handle

std::vector<int> held_fixed() { return lowest(cube(), 0.01); }

/// Triangles whose vertices are all of the patch.
std::vector<int> triangles_of(const std::vector<int>& patch) {
    std::vector<int> triangles;
    for (int t = 0; t < cube().n_triangles(); ++t) {
        const auto corners = cube().triangles.col(t);
        if (std::all_of(corners.begin(), corners.end(),
                        [&](int v) { return std::find(patch.begin(), patch.end(), v) != patch.end(); }))
            triangles.push_back(t);
    }
    return triangles;
}

/// A force along each axis on the patch.
ConstrainedSet with_force() {
    ConstrainedSet set{held_fixed(), {}};
    const std::vector<int> triangles = triangles_of(tip(cube(), Eigen::Vector3d(1, 2, 1), kPatch));
    for (int axis = 0; axis < 3; ++axis)
        set.loads.push_back(unit_force(cube(), triangles, Eigen::Vector3d::Unit(axis)));
    return set;
}
ConstrainedSet with_handle() { return {held_fixed(), tip(cube(), Eigen::Vector3d(1, 2, 1), kPatch)}; }

Eigen::MatrixXd basis_of(const ConstrainedSet& set) {
    if (set.loads.empty()) return Eigen::MatrixXd::Identity(3, 3).replicate(std::ssize(set.handles), 1);
    return Eigen::MatrixXd::Identity(set.n_values(), set.n_values());
}

/// Until the set can be dragged: its columns by one parameter an axis.
DragResponse ready(Deformer& deformer, const ConstrainedSet& set) {
    Control control;
    deformer.constrain(set, control);
    return deformer.drag_response(Eigen::VectorXd::Zero(set.n_values()), basis_of(set));
}

void frame_of_a_load_beside_that_of_a_handle(benchmark::State& state, MethodKind kind) {
    const auto model = precomputed(make_body(cube()), Method{.kind = kind});
    Deformer loaded(model), handled(model);
    const DragResponse by_force = ready(loaded, with_force()), by_motion = ready(handled, with_handle());
    Eigen::VectorXd u;
    const Eigen::VectorXd change = Eigen::Vector3d(0.1, -0.2, 0.3);
    const auto many = [&](const DragResponse& response) {
        for (int i = 0; i < 200; ++i) response.displace(change, u);
    };
    compare(
        state, 1.2, [&] { many(by_force); }, [&] { many(by_motion); });
}

void new_load_beside_a_new_handle(benchmark::State& state, MethodKind kind) {
    std::unique_ptr<Deformer> deformer;
    compare(
        state, 1.0, [&] { ready(*deformer, with_force()); }, [&] { ready(*deformer, with_handle()); },
        [&] {
            Control control;
            deformer = std::make_unique<Deformer>(precomputed(make_body(cube()), Method{.kind = kind}));
            deformer->constrain({held_fixed(), {}}, control);
        });
}

void register_all() {
    for (const MethodKind kind : all_methods()) {
        if (!kind->linear) continue;
        const std::string method(kind->name);
        benchmark::RegisterBenchmark(("frame_of_a_load/" + method).c_str(), frame_of_a_load_beside_that_of_a_handle,
                                     kind)
            ->UseManualTime()
            ->Iterations(15);
        benchmark::RegisterBenchmark(("new_load/" + method).c_str(), new_load_beside_a_new_handle, kind)
            ->UseManualTime()
            ->Iterations(5);
    }
}

}  // namespace
}  // namespace elastolab::test

int main(int argc, char** argv) {
    elastolab::test::register_all();
    elastolab::test::run_benchmarks(argc, argv);
}
