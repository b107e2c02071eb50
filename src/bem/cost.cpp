#include "bem/cost.hpp"

#include <algorithm>
#include <cmath>

#include "bem/galerkin/close_cost.hpp"
#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace {

/// Arithmetic per pair of source and triangle, in flops at the speed of the matrix product: about 0.1 us on a core.
constexpr double kFlopsPerPair = 3000.0;
/// The same per triangle for its pairs that touch or are close, which are a few: by collocation, and by Galerkin BEM.
constexpr double kCloseFlops = 2e6, kGalerkinCloseFlops = 8e6;
/// What every boundary method needs besides its matrices.
constexpr std::uint64_t kLeastMemory = 12u << 20;
/// Bytes of the rows that wait to be added to the hypersingular matrix: for each vertex, beside a constant, and at most
/// for each pair of vertices (small bodies).
constexpr double kRowMemoryPerVertex = 17e3, kLeastRowMemory = 12e6, kRowMemoryPerPair = 160.0;

/// Hierarchical matrices: number of vertices from which they are used, and bytes per vertex and level of clusters. By
/// linear BEM a cube of 3458 vertices with a held face and a patch took 29 s with a dense factor, one of 5402 takes 13
/// s with them; only a further handle of a few vertices, whose columns are few, is cheaper with the factor.
constexpr int kHierarchicalFrom = 3000;
constexpr double kBytesPerVertexAndLevel = 8.2e3;
/// Flops beside the power 4/3 of the number of vertices, with which time was measured to grow.
constexpr double kHierarchicalFlops = 5.2e6;
/// The same by linear collocation, whose matrix is not symmetric and needs no pairs of triangles; and bytes per
/// traction of a constrained set and level, and per equation.
constexpr double kCollocationBytes = 12.2e3, kCollocationFlops = 6.05e6;
constexpr double kCollocationBytesOfATraction = 15.5e3, kCollocationBytesOfAnEquation = 28e3;

/// Levels of clusters.
double levels_of(std::int64_t n_vertices) { return std::log2(std::max(static_cast<double>(n_vertices) / 48.0, 2.0)); }

Cost predict_hierarchical(const SurfaceMesh& mesh, double bytes_per_level, double flops) {
    const double n = mesh.n_vertices(), levels = levels_of(mesh.n_vertices());
    return {3 * static_cast<std::int64_t>(mesh.n_vertices()),
            (64u << 20) + static_cast<std::uint64_t>(bytes_per_level * levels * n),
            flops * n * std::cbrt(n) / product_speed()};
}

Cost predict(const SurfaceMesh& mesh, const Method& method, double nodes) {
    const double n = 3.0 * nodes;
    const double integrals = kFlopsPerPair * nodes * mesh.n_triangles() + kCloseFlops * mesh.n_triangles();
    Cost cost{static_cast<std::int64_t>(n), kLeastMemory, 0.0};
    if (!factorises_ahead(method)) return cost;
    cost.memory_bytes += square_bytes(n + 6.0);
    double flops = 2.0 / 3.0 * n * n * n + integrals;
    if (method.mode != Mode::on_demand) {
        cost.memory_bytes += 5 * square_bytes(n + 6.0);
        flops += (2.0 / 3.0 + 2.0 + 2.0) * n * n * n + integrals;
    }
    cost.seconds = flops / product_speed();
    return cost;
}

}  // namespace

Cost predict_constant_bem(const SurfaceMesh& mesh, const Method& method) {
    return predict(mesh, method, mesh.n_triangles());
}

Cost predict_linear_bem(const SurfaceMesh& mesh, const Method& method) {
    if (is_hierarchical(mesh, method)) return predict_hierarchical(mesh, kCollocationBytes, kCollocationFlops);
    return predict(mesh, method, mesh.n_vertices());
}

bool is_hierarchical(const SurfaceMesh& surface, const Method& method) {
    return method.mode == Mode::on_demand && surface.n_vertices() >= kHierarchicalFrom &&
           method.update != Update::eqn9;  // which acts on inverses of the whole matrix
}

std::uint64_t hierarchical_set_memory(std::int64_t n_vertices, std::int64_t n_loaded, std::int64_t n_tractions) {
    const auto n = static_cast<double>(n_vertices), m = static_cast<double>(n_tractions);
    const double factorised = n_tractions <= kMostFactorisedTractions ? m * m : 0.0;
    return static_cast<std::uint64_t>(16e3 * n + 45e3 * static_cast<double>(n_loaded) + 16.0 * factorised);
}

std::uint64_t collocation_set_memory(std::int64_t n_vertices, std::int64_t n_points, std::int64_t n_slots) {
    return static_cast<std::uint64_t>(kCollocationBytesOfATraction * levels_of(n_vertices) *
                                          static_cast<double>(n_slots) +
                                      kCollocationBytesOfAnEquation * static_cast<double>(n_points));
}

/// Half an LU, and half of the pairs of triangles: each once.
Cost predict_galerkin_bem(const SurfaceMesh& mesh, const Method& method) {
    if (is_hierarchical(mesh, method)) {
        Cost cost = predict_hierarchical(mesh, kBytesPerVertexAndLevel, kHierarchicalFlops);
        cost.seconds += nearly_touching_flops(mesh) / product_speed();
        return cost;
    }
    const double n = 3.0 * mesh.n_vertices(), triangles = mesh.n_triangles();
    const double vertices = mesh.n_vertices();
    const double waiting =
        std::min(kLeastRowMemory + kRowMemoryPerVertex * vertices, kRowMemoryPerPair * vertices * vertices);
    Cost cost{static_cast<std::int64_t>(n), kLeastMemory + static_cast<std::uint64_t>(waiting), 0.0};
    if (!factorises_ahead(method)) return cost;
    cost.memory_bytes += square_bytes(n);
    double flops = n * n * n / 3.0 + 0.5 * kFlopsPerPair * triangles * triangles + kGalerkinCloseFlops * triangles +
                   nearly_touching_flops(mesh);
    if (method.mode != Mode::on_demand) {
        cost.memory_bytes += 4 * square_bytes(n);
        flops += 2.0 * n * n * n;
    }
    cost.seconds = flops / product_speed();
    return cost;
}

}  // namespace elastolab
