#include "bem/galerkin/cost.hpp"

#include <algorithm>

#include "bem/cost.hpp"
#include "bem/galerkin/close_cost.hpp"
#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace {

/// Flops per triangle for its pairs that touch or are close, which are a few.
constexpr double kGalerkinCloseFlops = 8e6;
/// Bytes of the rows that wait to be added to the hypersingular matrix: for each vertex, beside a constant, and at most
/// for each pair of vertices (small bodies).
constexpr double kRowMemoryPerVertex = 17e3, kLeastRowMemory = 12e6, kRowMemoryPerPair = 160.0;
/// Hierarchical matrices: bytes and flops as predict_hierarchical takes them.
constexpr double kBytesPerVertexAndLevel = 8.2e3, kHierarchicalFlops = 5.2e6;

}  // namespace

std::uint64_t hierarchical_set_memory(std::int64_t n_vertices, std::int64_t n_loaded, std::int64_t n_tractions) {
    const auto n = static_cast<double>(n_vertices), m = static_cast<double>(n_tractions);
    const double factorised = n_tractions <= kMostFactorisedTractions ? m * m : 0.0;
    return static_cast<std::uint64_t>(16e3 * n + 45e3 * static_cast<double>(n_loaded) + 16.0 * factorised);
}

/// Half an LU, and half of the pairs of triangles: each once.
Cost predict_galerkin_bem(const SurfaceMesh& mesh, const Method& method) {
    if (is_hierarchical(mesh, method)) {
        Cost cost = predict_hierarchical(mesh, kBytesPerVertexAndLevel, kHierarchicalFlops);
        cost.seconds += costly_pair_flops(mesh) / product_speed();
        return cost;
    }
    const double n = 3.0 * mesh.n_vertices(), triangles = mesh.n_triangles();
    const double vertices = mesh.n_vertices();
    const double waiting =
        std::min(kLeastRowMemory + kRowMemoryPerVertex * vertices, kRowMemoryPerPair * vertices * vertices);
    Cost cost{static_cast<std::int64_t>(n), kLeastMemory + static_cast<std::uint64_t>(waiting), 0.0};
    const bool factorises = factorises_ahead(method), keeps_integrals = method.rims > 0;
    if (!factorises && !keeps_integrals) return cost;
    double flops =
        0.5 * kFlopsPerPair * triangles * triangles + kGalerkinCloseFlops * triangles + costly_pair_flops(mesh);
    if (keeps_integrals) cost.memory_bytes += square_bytes(n);
    if (factorises) {
        cost.memory_bytes += square_bytes(n);
        flops += n * n * n / 3.0;
    }
    if (method.mode != Mode::on_demand) {
        cost.memory_bytes += 4 * square_bytes(n);
        flops += 2.0 * n * n * n;
    }
    cost.seconds = flops / product_speed();
    return cost;
}

}  // namespace elastolab
