// From the press on a new handle to its columns, on a cube of 10 088 vertices whose left face is held: to the tolerance
// that is shown first and converged from there, beside the final one at once.
//   build/release/tests/benchmarks/first_answer_benchmark

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "benchmarks/tools.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

constexpr int kCells = 41;

/// Columns of a set that nothing is known of but its tractions, and seconds to each tolerance, one after the other.
struct Press {
    Press(const std::shared_ptr<const Model>& model, const ConstrainedSet& set, const std::vector<double>& tolerances) {
        Control control;
        Deformer deformer(model);
        const Stopwatch watch;
        deformer.constrain(set, control);
        seconds.push_back(watch.seconds());
        const std::ptrdiff_t n = std::ssize(set.handles);
        const Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(3, 3).replicate(n, 1);
        for (const double tolerance : tolerances) {
            columns.push_back(deformer.drag_response(Eigen::VectorXd::Zero(3 * n), basis, control, tolerance).X);
            seconds.push_back(watch.seconds());
        }
    }
    std::vector<double> seconds;
    std::vector<Eigen::MatrixXd> columns;
};

void from_press_to_columns(benchmark::State& state, MethodKind kind) {
    const SurfaceMesh mesh = make_box(kCells);
    ConstrainedSet set{vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; }), {}};
    const auto model = precomputed(make_body(mesh), Method{.kind = kind});
    Control control;
    Deformer before(model);
    before.constrain(set, control);
    set.handles = vertices_where(
        mesh, [](const auto& x) { return x[0] > 1.0 - 1e-9 && (x - Eigen::Vector3d(1.0, 0.5, 0.5)).norm() < 0.26; });
    const Press warm(model, set, {});  // after which only the iteration differs
    for (auto _ : state) {
        const Press at_once(model, set, {kSolveTolerance}), converged(model, set, {kFirstTolerance, kSolveTolerance});
        state.SetIterationTime(converged.seconds[1]);
        state.counters["constrain_s"] = converged.seconds[0];
        state.counters["at_once_s"] = at_once.seconds[1];
        state.counters["first_s"] = converged.seconds[1];
        state.counters["converged_s"] = converged.seconds[2];
        const Eigen::MatrixXd& exact = at_once.columns[0];
        const auto largest = [](const Eigen::MatrixXd& u) { return u.cwiseAbs().maxCoeff(); };
        state.counters["first_off"] = largest(converged.columns[0] - exact) / largest(exact);
        state.counters["converged_off"] = largest(converged.columns[1] - exact) / largest(exact);
    }
    state.counters["vertices"] = mesh.n_vertices();
}

BENCHMARK_CAPTURE(from_press_to_columns, linear, kLinearBem)->UseManualTime()->Iterations(2)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(from_press_to_columns, galerkin, kGalerkinBem)
    ->UseManualTime()
    ->Iterations(2)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace elastolab::test

int main(int argc, char** argv) { elastolab::test::run_benchmarks(argc, argv); }
