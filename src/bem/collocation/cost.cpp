#include "bem/collocation/cost.hpp"

#include "bem/cost.hpp"
#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace {

/// Flops per triangle for its pairs that touch or are close, which are a few.
constexpr double kCloseFlops = 2e6;
/// With hierarchical matrices: bytes per vertex and level, per traction of a constrained set and level, and per
/// equation; flops as predict_hierarchical takes them.
constexpr double kCollocationBytes = 12.2e3, kCollocationFlops = 6.05e6;
constexpr double kCollocationBytesOfATraction = 15.5e3, kCollocationBytesOfAnEquation = 28e3;

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

std::uint64_t collocation_set_memory(std::int64_t n_vertices, std::int64_t n_points, std::int64_t n_slots) {
    return static_cast<std::uint64_t>(kCollocationBytesOfATraction * cluster_levels(n_vertices) *
                                          static_cast<double>(n_slots) +
                                      kCollocationBytesOfAnEquation * static_cast<double>(n_points));
}

}  // namespace elastolab
