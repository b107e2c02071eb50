// Galerkin and linear BEM by hierarchical matrices beside hmat-oss's H-LU (Debian's libhmat-oss, which is sequential)
// of a matrix of the same size: Kelvin's solution between the vertices, to 1e-4, for which a solve is then off by about
// 1e-2.
//   build/release/tests/benchmarks/hierarchical_benchmark

#include <hmat/hmat.h>

#include <memory>
#include <numbers>

#include "base/memory.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "benchmarks/tools.hpp"
#include "mesh/measures.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

constexpr double kCompression = 1e-4, kAdmissibility = 3.0;

/// The single layer of forces at the vertices; at itself, that of a disc of the mean area.
struct PointForces {
    const SurfaceMesh& mesh;
    double radius;

    static void entry(void* context, int row, int column, void* result) {
        const auto& self = *static_cast<const PointForces*>(context);
        const int i = row / 3, j = column / 3, a = row % 3, b = column % 3;
        const Eigen::Vector3d d = self.mesh.vertices.col(i) - self.mesh.vertices.col(j);
        constexpr double kRatio = 0.3;
        const double r = i == j ? 0.5 * self.radius : d.norm();
        const double along = i == j ? (a == b ? 1.0 / 3.0 : 0.0) : d[a] * d[b] / (r * r);
        const double value =
            ((a == b ? 3.0 - 4.0 * kRatio : 0.0) + along) / (16.0 * std::numbers::pi * (1.0 - kRatio) * r);
        *static_cast<double*>(result) = value;
    }
};

void factorise_by_hmat(const SurfaceMesh& mesh) {
    hmat_interface_t hmat;
    hmat_init_default_interface(&hmat, HMAT_DOUBLE_PRECISION);
    hmat.init();
    PointForces forces{mesh, std::sqrt(surface_area(mesh) / mesh.n_vertices() / std::numbers::pi)};
    Eigen::Matrix3Xd points(3, 3 * mesh.n_vertices());
    for (int i = 0; i < points.cols(); ++i) points.col(i) = mesh.vertices.col(i / 3);
    hmat_clustering_algorithm_t* clustering = hmat_create_clustering_median();
    hmat_cluster_tree_t* tree = hmat_create_cluster_tree(points.data(), 3, static_cast<int>(points.cols()), clustering);
    hmat_admissibility_t* admissible = hmat_create_admissibility_standard(kAdmissibility);
    hmat_matrix_t* matrix = hmat.create_empty_hmatrix_admissibility(tree, tree, 0, admissible);
    hmat.set_low_rank_epsilon(matrix, kCompression);
    hmat_compression_algorithm_t* compression = hmat_create_compression_aca_plus(kCompression);
    hmat_assemble_context_t assembly;
    hmat_assemble_context_init(&assembly);
    assembly.simple_compute = PointForces::entry;
    assembly.user_context = &forces;
    assembly.compression = compression;
    assembly.progress = nullptr;
    hmat.assemble_generic(matrix, &assembly);
    hmat_factorization_context_t factorisation;
    hmat_factorization_context_init(&factorisation);
    factorisation.factorization = hmat_factorization_lu;
    factorisation.progress = nullptr;
    hmat.factorize_generic(matrix, &factorisation);
    hmat.destroy(matrix);
    hmat_delete_compression(compression);
    hmat_delete_admissibility(admissible);
    hmat_delete_cluster_tree(tree);
    hmat_delete_clustering(clustering);
    hmat.finalize();
}

/// From the surface to columns of a drag, fixed set and handle included. `gigabytes`: what the process has taken at
/// most, of this method only when it is the one that --benchmark_filter names.
void bem_until_a_drag_beside_an_h_lu(benchmark::State& state, MethodKind kind) {
    const SurfaceMesh mesh = make_lump(static_cast<int>(state.range(0)));
    const ConstrainedSet set{lowest(mesh, 0.08), tip(mesh, Eigen::Vector3d::UnitX(), 30)};
    const Body body = make_body(mesh);
    const auto work = [&] {
        Deformer deformer(precomputed(body, make_method(kind)));
        benchmark::DoNotOptimize(drag(deformer, set));
    };
    work();
    state.counters["gigabytes"] = 1e-9 * static_cast<double>(peak_memory_bytes());
    compare(state, 1.0, work, [&] { factorise_by_hmat(mesh); });
    state.counters["vertices"] = mesh.n_vertices();
}

void of_10002_vertices(benchmark::internal::Benchmark* its) {
    its->ArgName("cells")->Arg(50)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(bem_until_a_drag_beside_an_h_lu, galerkin, kGalerkinBem)->Apply(of_10002_vertices);
BENCHMARK_CAPTURE(bem_until_a_drag_beside_an_h_lu, linear, kLinearBem)->Apply(of_10002_vertices);

}  // namespace
}  // namespace elastolab::test

int main(int argc, char** argv) { elastolab::test::run_benchmarks(argc, argv); }
