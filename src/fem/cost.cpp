#include "fem/cost.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace {

/// Nodes that a tetrahedral mesh of this surface has, from its volume and mean edge.
double predict_tet_nodes(const SurfaceMesh& mesh) {
    double volume = 0.0, edges = 0.0;
    // About a vertex of the body: about the origin the volume of a body far away would be lost in cancellation.
    const Eigen::Vector3d center = mesh.vertices.leftCols(1).rowwise().sum();
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t)) - center,
                              b = mesh.vertices.col(mesh.triangles(1, t)) - center,
                              c = mesh.vertices.col(mesh.triangles(2, t)) - center;
        volume += a.dot(b.cross(c)) / 6.0;
        edges += ((b - a).norm() + (c - b).norm() + (a - c).norm()) / 3.0;
    }
    const double edge = edges / std::max(mesh.n_triangles(), 1);
    // A regular grid of cells whose faces are split along a diagonal has a mean edge of 1.14 cells.
    const double cell = edge / 1.14;
    return mesh.n_vertices() + std::max(0.0, std::abs(volume) / (cell * cell * cell) - 0.5 * mesh.n_vertices());
}

}  // namespace

Cost predict_linear_fem(const SurfaceMesh& mesh, const Method& method) {
    const double all = predict_tet_nodes(mesh), n = 3.0 * all, surface = 3.0 * mesh.n_vertices();
    Cost cost{static_cast<std::int64_t>(n), 0, 0.0};
    // Nested dissection in three dimensions: fill grows like N^(4/3), work like N^2.
    const double factor_entries = 14.0 * std::pow(n, 4.0 / 3.0);
    double flops = 60.0 * n * n + 2.0e5 * all;
    cost.memory_bytes = static_cast<std::uint64_t>(8.0 * factor_entries + 3000.0 * n);
    if (method.mode != Mode::on_demand) {
        const double dense = method.mode == Mode::full ? surface : n;
        cost.memory_bytes += 4 * square_bytes(dense + 6.0);
        flops += 2.0 * dense * dense * dense + 4.0 * surface * factor_entries;
    }
    cost.seconds = flops / product_speed();
    return cost;
}

}  // namespace elastolab
