// From the file of an open scan to the first frame in which a pulled patch moves, as in the viewer: beside reading the
// file, one wrap of it and FEM of that wrap until the same patch can be dragged. `ratio` 1.5 at most is wanted.
//   build/release/tests/benchmarks/first_pull_benchmark

#include <filesystem>
#include <memory>
#include <random>
#include <thread>

#include "bem/galerkin/method.hpp"
#include "benchmarks/tools.hpp"
#include "fem/method.hpp"
#include "methods/registry.hpp"
#include "scene/live/simulation.hpp"
#include "scene/proxy/carried_constraints.hpp"
#include "scene/proxy/proxy.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::test {
namespace {

constexpr int kProxyVertices = 1500;  // the default of scenes
const std::vector<MethodKind> kShown = {kGalerkinBem};

/// A lumpy ball of 8 cells^2 triangles without its top, with one triangle in a hundred missing and one in twenty facing
/// inward.
SurfaceMesh make_scan(int cells) {
    SurfaceMesh mesh = make_lump(cells);
    std::mt19937 random(5);
    std::vector<Eigen::Vector3i> kept;
    for (const auto& t : mesh.triangles.colwise()) {
        if (mesh.vertices(1, t[0]) > 0.8 || random() % 100 == 0) continue;
        kept.emplace_back(random() % 20 == 0 ? Eigen::Vector3i(t[0], t[2], t[1]) : Eigen::Vector3i(t));
    }
    mesh.triangles.resize(3, std::ssize(kept));
    for (std::size_t i = 0; i < kept.size(); ++i) mesh.triangles.col(static_cast<Eigen::Index>(i)) = kept[i];
    return mesh;
}

/// As the viewer opens a bare mesh, then a press on its outermost part; returns when its answer has moved.
void open_and_pull(const std::filesystem::path& file) {
    Control control;
    Document document;
    document.mesh = MeshFile{file.string()};
    document.method = kShown.front();
    LiveScene scene(document, file.parent_path() / "scene.json", control);
    scene.fix(lowest(scene.mesh(), 0.06));
    scene.add_handle(tip(scene.mesh(), Eigen::Vector3d::UnitX(), 30));
    scene.set_motion(0, AffineMotion{.translate = {0.1, 0.0, 0.0}});
    Simulation simulation([] {});
    while (!simulation.update(scene, kShown, {})) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    simulation.cancel();
    while (simulation.stopping()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void from_file_to_first_pull_beside_its_parts(benchmark::State& state) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "scan.obj";
    save_surface(file, make_scan(static_cast<int>(state.range(0))));
    const CheckedMesh checked = check_and_repair(load_surface(file));
    const auto shown = std::make_shared<const SurfaceMesh>(checked.mesh);
    const ConstrainedSet set{lowest(*shown, 0.06), tip(*shown, Eigen::Vector3d::UnitX(), 30)};
    const std::vector<int> size = {kProxyVertices};
    double reading = 0.0, wrapping = 0.0;
    compare(
        state, 1.5, [&] { open_and_pull(file); },
        [&] {
            Control control;
            reading = seconds_of([&] { benchmark::DoNotOptimize(load_surface(file)); });
            std::shared_ptr<const Proxy> proxy;
            wrapping = seconds_of([&] { proxy = make_proxies("scan", shown, checked.report, size, control).front(); });
            Deformer deformer(precomputed(make_body(*proxy->surface), make_method(kFem)));
            const ConstrainedSet carried{lowest(*proxy->surface, 0.06),
                                         tip(*proxy->surface, Eigen::Vector3d::UnitX(), 30)};
            benchmark::DoNotOptimize(drag(deformer, carried));
        });
    state.counters["triangles"] = checked.mesh.n_triangles();
    state.counters["reading_ms"] = 1e3 * reading;
    state.counters["wrap_ms"] = 1e3 * wrapping;
}

BENCHMARK(from_file_to_first_pull_beside_its_parts)
    ->ArgName("cells")
    ->Arg(35)
    ->Arg(112)  // 100 000 triangles
    ->Arg(354)  // a million
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace elastolab::test

int main(int argc, char** argv) { elastolab::test::run_benchmarks(argc, argv); }
