#pragma once

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "base/blas.hpp"
#include "base/timer.hpp"
#include "deform/deformer.hpp"
#include "mesh/checks/check.hpp"
#include "mesh/input/export.hpp"
#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"

namespace elastolab::test {

inline double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
    return values[values.size() / 2];
}

inline double seconds_of(const std::function<void()>& work) {
    const Stopwatch watch;
    work();
    return watch.seconds();
}

/// Times `work` and, beside it in every round, `reference`; `prepare` runs before each of them, untimed. `target`: the
/// largest ratio that is wanted, printed beside the measured one; 0: none is set.
inline void compare(
    benchmark::State& state, double target, const std::function<void()>& work, const std::function<void()>& reference,
    const std::function<void()>& prepare = [] {}) {
    std::vector<double> ours, theirs, ratios;
    for (auto _ : state) {
        prepare();
        theirs.push_back(seconds_of(reference));
        prepare();
        ours.push_back(seconds_of(work));
        ratios.push_back(ours.back() / theirs.back());
        state.SetIterationTime(ours.back());
    }
    state.counters["ms"] = 1e3 * median(ours);
    state.counters["reference_ms"] = 1e3 * median(theirs);
    state.counters["ratio"] = median(ratios);
    if (target > 0.0) state.counters["target"] = target;
}

/// 1016 vertices, the size of the paper's largest cubes.
inline const SurfaceMesh& cube() {
    static const SurfaceMesh mesh = make_box(13);
    return mesh;
}

/// A round body of 4 cells^2 + 2 vertices with bumps.
inline SurfaceMesh make_lump(int cells) {
    SurfaceMesh mesh = make_sphere(cells);
    for (auto p : mesh.vertices.colwise())
        p *= 1.0 + 0.25 * std::sin(3.0 * p[0]) * std::cos(4.0 * p[1] + 1.0) + 0.15 * std::sin(5.0 * p[2] + 2.0 * p[0]);
    return mesh;
}

/// The lowest part of a body, and the vertices nearest to the outermost one along an axis.
inline std::vector<int> lowest(const SurfaceMesh& mesh, double share) {
    const double low = mesh.vertices.row(1).minCoeff(), high = mesh.vertices.row(1).maxCoeff();
    return vertices_where(mesh, [&](const auto& x) { return x[1] < low + share * (high - low); });
}
inline std::vector<int> tip(const SurfaceMesh& mesh, const Eigen::Vector3d& axis, int n) {
    Eigen::Index outermost = 0;
    (axis.transpose() * mesh.vertices).maxCoeff(&outermost);
    std::vector<int> vertices(static_cast<std::size_t>(mesh.n_vertices()));
    std::iota(vertices.begin(), vertices.end(), 0);
    const auto distance = [&](int v) { return (mesh.vertices.col(v) - mesh.vertices.col(outermost)).norm(); };
    std::partial_sort(vertices.begin(), vertices.begin() + n, vertices.end(),
                      [&](int a, int b) { return distance(a) < distance(b); });
    vertices.resize(static_cast<std::size_t>(n));
    return vertices;
}

/// Until this set can be dragged.
inline DragResponse drag(Deformer& deformer, const ConstrainedSet& set) {
    Control control;
    deformer.constrain(set, control);
    const std::ptrdiff_t n = std::ssize(set.handles);
    return deformer.drag_response(Eigen::VectorXd::Zero(3 * n), Eigen::MatrixXd::Identity(3, 3).replicate(n, 1));
}

/// Those that the command line asks for, with the BLAS kernels that the program would choose.
inline void run_benchmarks(int argc, char** argv) {
    prepare_parallel_libraries(argv);
    benchmark::Initialize(&argc, argv);
    benchmark::AddCustomContext("blas_kernels", blas_kernels());
    benchmark::AddCustomContext("threads", std::to_string(thread_count()));
    benchmark::RunSpecifiedBenchmarks();
}

}  // namespace elastolab::test
