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

/// On demand. Nested dissection in three dimensions: fill grows like N^(4/3), work like N^2.
Cost predict_sparse(double unknowns, double elements_work) {
    Cost cost{static_cast<std::int64_t>(unknowns), 0, 0.0};
    cost.memory_bytes = static_cast<std::uint64_t>(8.0 * 14.0 * std::pow(unknowns, 4.0 / 3.0) + 3000.0 * unknowns);
    cost.seconds = (60.0 * unknowns * unknowns + elements_work) / product_speed();
    return cost;
}

}  // namespace

Cost predict_linear_fem(const SurfaceMesh& mesh, const Method& method) {
    const double all = predict_tet_nodes(mesh), n = 3.0 * all, surface = 3.0 * mesh.n_vertices();
    Cost cost = predict_sparse(n, 2.0e5 * all);
    if (method.mode == Mode::on_demand) return cost;
    const double dense = method.mode == Mode::full ? surface : n, factor_entries = 14.0 * std::pow(n, 4.0 / 3.0);
    cost.memory_bytes += 4 * square_bytes(dense + 6.0);
    cost.seconds += (2.0 * dense * dense * dense + 4.0 * surface * factor_entries) / product_speed();
    return cost;
}

/// A node more for every edge, of which there are some seven a vertex inside.
Cost predict_quadratic_fem(const SurfaceMesh& mesh, const Method&) {
    const double vertices = predict_tet_nodes(mesh);
    return predict_sparse(3.0 * 8.0 * vertices, 1.2e6 * vertices);
}

}  // namespace elastolab
