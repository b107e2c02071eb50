#include "bem/collocation/cost.hpp"

#include "bem/cost.hpp"
#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace {

/// With hierarchical matrices: bytes per traction of a constrained set and level, and per equation.
constexpr double kCollocationBytesOfATraction = 15.5e3, kCollocationBytesOfAnEquation = 28e3;
constexpr HierarchicalPrices kHierarchical{
    .bytes = 12.2e3, .precomputation = 5400.0, .set = 720.0, .set_triangles = 6000.0};

/// What a dense method takes, fitted to cubes, bars and organic bodies of 56 to 1500 vertices.
struct DensePrices {
    double pairs;           ///< integrals for a pair of node and triangle
    double traction_pairs;  ///< the same in the mode full, where the matrix of all tractions is made
    double triangles;       ///< integrals for a triangle
    double set_pairs;       ///< integrals for a pair of a node and a triangle of the constrained set
    double set_triangles;   ///< integrals for such a triangle
    double inverse;         ///< flops of K and its inverse, over the cube of the equations
    double columns;         ///< flops for a value of the set, over the square of the equations
    /// Whether sets take next to nothing in the mode full.
    bool inverse_serves_sets;
};

Cost predict(const SurfaceMesh& mesh, const Method& method, double nodes, double set_values,
             const DensePrices& prices) {
    const double n = 3.0 * nodes, triangles = mesh.n_triangles();
    const double set = UsualSet(mesh).triangles;
    Cost cost{static_cast<std::int64_t>(n), kLeastMemory};
    if (!factorises_ahead(method)) return cost;
    cost.memory_bytes += square_bytes(n + 6.0);
    Work work{.flops = 0.72 * n * n * n, .integrals = prices.pairs * nodes * triangles + prices.triangles * triangles};
    if (method.mode != Mode::on_demand) {
        cost.memory_bytes += 5 * square_bytes(n + 6.0);
        work.flops += prices.inverse * n * n * n;
        work.integrals += prices.traction_pairs * nodes * triangles;
    }
    if (method.mode == Mode::on_demand || !prices.inverse_serves_sets) {
        work.flops += prices.columns * n * n * set_values + 60.0 * set * set * set;
        work.integrals += prices.set_pairs * nodes * set + prices.set_triangles * set;
    }
    cost.work = work;
    return cost;
}

}  // namespace

Cost predict_constant_bem(const SurfaceMesh& mesh, const Method& method) {
    return predict(mesh, method, mesh.n_triangles(), 3.0 * UsualSet(mesh).vertices,
                   {.pairs = 11.3,
                    .traction_pairs = 19.0,
                    .triangles = 340.0,
                    .set_pairs = 5.9,
                    .set_triangles = 710.0,
                    .inverse = 9.6,
                    .columns = 4.4,
                    .inverse_serves_sets = true});
}

Cost predict_linear_bem(const SurfaceMesh& mesh, const Method& method) {
    if (is_hierarchical(mesh, method)) return predict_hierarchical(mesh, kHierarchical);
    return predict(mesh, method, mesh.n_vertices(), 9.0 * UsualSet(mesh).triangles,
                   {.pairs = 6.6,
                    .traction_pairs = 27.0,
                    .triangles = 290.0,
                    .set_pairs = 57.0,
                    .set_triangles = 0.0,
                    .inverse = 5.2,
                    .columns = 1.0,
                    .inverse_serves_sets = false});
}

std::uint64_t collocation_set_memory(std::int64_t n_vertices, std::int64_t n_points, std::int64_t n_slots) {
    return static_cast<std::uint64_t>(kCollocationBytesOfATraction * cluster_levels(n_vertices) *
                                          static_cast<double>(n_slots) +
                                      kCollocationBytesOfAnEquation * static_cast<double>(n_points));
}

}  // namespace elastolab
