#include "bem/cost.hpp"

#include <algorithm>
#include <cmath>

#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace {

/// Arithmetic per pair of source and triangle, in flops at the speed of the matrix product: about 0.1 us on a core.
constexpr double kFlopsPerPair = 3000.0;

/// Hierarchical matrices: vertices from which they are used, and what they take for each and each level of clusters.
constexpr int kHierarchicalFrom = 4000;
constexpr double kBytesPerVertexAndLevel = 9e3, kFlopsPerVertexAndLevel = 4e7;

Cost predict(const SurfaceMesh& mesh, const Method& method, double nodes) {
    const double n = 3.0 * nodes, pairs = nodes * mesh.n_triangles();
    Cost cost{static_cast<std::int64_t>(n), 64u << 20, 0.0};
    if (!factorises_ahead(method)) return cost;
    cost.memory_bytes += square_bytes(n + 6.0);
    double flops = 2.0 / 3.0 * n * n * n + kFlopsPerPair * pairs;
    if (method.keep_integrals) cost.memory_bytes += static_cast<std::uint64_t>(80.0 * nodes * nodes);
    if (method.mode != Mode::on_demand) {
        cost.memory_bytes += 5 * square_bytes(n + 6.0);
        flops += (2.0 / 3.0 + 2.0 + 2.0) * n * n * n + kFlopsPerPair * pairs;
    }
    cost.seconds = flops / product_speed();
    return cost;
}

}  // namespace

Cost predict_constant_bem(const SurfaceMesh& mesh, const Method& method) {
    return predict(mesh, method, mesh.n_triangles());
}

Cost predict_linear_bem(const SurfaceMesh& mesh, const Method& method) {
    return predict(mesh, method, mesh.n_vertices());
}

bool is_hierarchical(const SurfaceMesh& surface, const Method& method) {
    return method.mode == Mode::on_demand && surface.n_vertices() >= kHierarchicalFrom;
}

std::uint64_t hierarchical_set_memory(std::int64_t n_vertices, std::int64_t n_tractions) {
    const double n = static_cast<double>(n_vertices), m = static_cast<double>(n_tractions);
    return static_cast<std::uint64_t>(12e3 * n + 20e3 * m + 8.0 * std::min(m * m, 64e6));
}

/// Half an LU, and half of the pairs of triangles: each once.
Cost predict_galerkin_bem(const SurfaceMesh& mesh, const Method& method) {
    const double n = 3.0 * mesh.n_vertices(), triangles = mesh.n_triangles();
    Cost cost{static_cast<std::int64_t>(n), 192u << 20, 0.0};
    if (is_hierarchical(mesh, method)) {
        const double levels = std::log2(std::max(mesh.n_vertices() / 48.0, 2.0));
        cost.memory_bytes += static_cast<std::uint64_t>(kBytesPerVertexAndLevel * mesh.n_vertices() * levels);
        cost.seconds = kFlopsPerVertexAndLevel * mesh.n_vertices() * levels / product_speed();
        return cost;
    }
    if (!factorises_ahead(method)) return cost;
    cost.memory_bytes += square_bytes(n);
    double flops = n * n * n / 3.0 + 0.5 * kFlopsPerPair * triangles * triangles;
    if (method.keep_integrals) cost.memory_bytes += 2 * square_bytes(n);
    if (method.mode != Mode::on_demand) {
        cost.memory_bytes += 4 * square_bytes(n);
        flops += 2.0 * n * n * n;
    }
    cost.seconds = flops / product_speed();
    return cost;
}

}  // namespace elastolab
