// The part of core_benchmark that is about finite elements.

#include <unistd.h>

#include <filesystem>

#include "base/lapack.hpp"
#include "base/memory.hpp"
#include "benchmarks/tools.hpp"
#include "fem/assembly.hpp"
#include "fem/compliance.hpp"
#include "fem/constraints.hpp"
#include "fem/method.hpp"
#include "mesh/tets/tetrahedralize.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

/// FEM, stage by stage, beside the factorisation: 0 assembly, 1 factorisation, 2 a set change with no column known.
void fem_beside_its_factorisation(benchmark::State& state) {
    Control control;
    const TetMesh tets = tetrahedralize(cube(), "cube", {}, control);
    const StiffnessParts parts = assemble_stiffness_parts(tets, control);
    const CholeskyAnalysis analysis(parts.mu);
    const SparseMatrix K = stiffness(parts, Material{1.0, 0.3});
    const auto fixed = vertices_where(cube(), [](const auto& x) { return x[0] < 1e-9; });
    const auto pull = vertices_where(cube(), [](const auto& x) { return x[0] > 1 - 1e-9 && x[1] > 0.6; });
    const SparseMatrix held = eliminated(K, fixed);
    const auto factorise = [&] { benchmark::DoNotOptimize(SparseCholesky(analysis, held, "stiffness")); };
    const SurfaceCompliance compliance(K, analysis, tets.vertices, tets.n_surface_vertices, fixed, control);
    const std::function<void()> stages[] = {[&] { benchmark::DoNotOptimize(assemble_stiffness_parts(tets, control)); },
                                            factorise,
                                            [&] { benchmark::DoNotOptimize(compliance.columns(pull, control)); }};
    compare(state, 0.0, stages[state.range(0)], factorise);
    state.counters["degrees_of_freedom"] = static_cast<double>(K.rows());
}

/// make_lump() as an OBJ file.
class LumpFile {
public:
    explicit LumpFile(int cells) { save_surface(file_, make_lump(cells)); }
    ~LumpFile() { std::filesystem::remove(file_); }
    LumpFile(const LumpFile&) = delete;
    LumpFile& operator=(const LumpFile&) = delete;

    SurfaceMesh read() const {
        CheckedMesh checked = check_and_repair(load_surface(file_));
        require_usable(checked.report, file_.filename(), true);
        return std::move(checked.mesh);
    }

private:
    std::filesystem::path file_ =
        std::filesystem::temp_directory_path() / ("core_benchmark_" + std::to_string(::getpid()) + ".obj");
};

/// Linear FEM from a file to the columns of a drag, fixed set and handle included, beside TetGen, ordering and
/// factorisation of the same body. `memory_over_factor`: what the process has taken at most, over the factor; 2.5 is
/// wanted.
void fem_from_file_to_drag_beside_its_parts(benchmark::State& state) {
    const LumpFile file(static_cast<int>(state.range(0)));
    const SurfaceMesh mesh = file.read();
    const ConstrainedSet set{lowest(mesh, 0.08), tip(mesh, Eigen::Vector3d::UnitX(), 30)};
    const std::uint64_t before = peak_memory_bytes();
    Control control;
    const auto work = [&] {
        Deformer deformer(precomputed(make_body(file.read()), make_method(kFem)));
        benchmark::DoNotOptimize(drag(deformer, set));
    };
    work();  // before the parts, whose memory is not to count
    const std::uint64_t peak = peak_memory_bytes();
    std::uint64_t factor = 0;
    compare(state, 1.5, work, [&] {
        const TetMesh tets = tetrahedralize(mesh, "lump", {}, control);
        const SparseMatrix K = stiffness(assemble_stiffness_parts(tets, control), Material{1.0, 0.3});
        const CholeskyAnalysis analysis(K);
        benchmark::DoNotOptimize(SparseCholesky(analysis, eliminated(K, set.fixed), "stiffness"));
        factor = analysis.factor_bytes();
    });
    state.counters["vertices"] = mesh.n_vertices();
    state.counters["memory_over_factor"] = static_cast<double>(peak - before) / static_cast<double>(factor);
}

/// A new handle on a kept fixed set by linear FEM, until it can be dragged, beside the cheaper of its two old prices:
/// the set eliminated in a factorisation of its own; or the columns of the handle's vertices, and their dense system.
void fem_changed_handle_beside_the_cheaper_price(benchmark::State& state) {
    Control control;
    const SurfaceMesh mesh = LumpFile(static_cast<int>(state.range(0))).read();
    const ConstrainedSet first{lowest(mesh, 0.08), tip(mesh, Eigen::Vector3d::UnitX(), 30)};
    ConstrainedSet next{first.fixed, tip(mesh, -Eigen::Vector3d::UnitX(), static_cast<int>(state.range(1)))};
    std::erase_if(next.handles,
                  [&](int v) { return std::find(first.fixed.begin(), first.fixed.end(), v) != first.fixed.end(); });
    const std::shared_ptr<const Model> model = precomputed(make_body(mesh), make_method(kFem));
    Deformer deformer(model);
    benchmark::DoNotOptimize(drag(deformer, first));

    const TetMesh tets = tetrahedralize(mesh, "lump", {}, control);
    const SparseMatrix K = stiffness(assemble_stiffness_parts(tets, control), Material{1.0, 0.3});
    const CholeskyAnalysis analysis(K);
    const SurfaceCompliance held(K, analysis, tets.vertices, tets.n_surface_vertices, first.fixed, control);
    std::vector<int> all = next.fixed;
    all.insert(all.end(), next.handles.begin(), next.handles.end());
    const Eigen::Index n = 3 * std::ssize(next.handles);
    const auto eliminate = [&] {
        const SparseCholesky factor(analysis, eliminated(K, all), "stiffness");
        benchmark::DoNotOptimize(factor.solve(Eigen::MatrixXd::Ones(K.rows(), 4)));
    };
    const auto respond = [&] {
        benchmark::DoNotOptimize(held.columns(next.handles, control));
        LuFactorization(Eigen::MatrixXd::Random(n, n), "capacitance system");
    };
    const bool eliminating_is_cheaper = seconds_of(eliminate) < seconds_of(respond);
    compare(
        state, 1.3, [&] { benchmark::DoNotOptimize(drag(deformer, next)); },
        eliminating_is_cheaper ? std::function<void()>(eliminate) : respond);
    state.counters["vertices"] = mesh.n_vertices();
    state.counters["factorise"] = eliminating_is_cheaper ? 1.0 : 0.0;
}

BENCHMARK(fem_beside_its_factorisation)
    ->ArgName("stage")
    ->DenseRange(0, 2)
    ->UseManualTime()
    ->Iterations(9)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(fem_from_file_to_drag_beside_its_parts)
    ->ArgName("cells")
    ->Arg(35)
    ->Arg(100)  // 40 002 vertices
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(fem_changed_handle_beside_the_cheaper_price)
    ->ArgNames({"cells", "handle"})
    ->ArgsProduct({{35, 100}, {30, 300}})
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace elastolab::test
