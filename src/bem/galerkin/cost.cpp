#include "bem/galerkin/cost.hpp"

#include <algorithm>
#include <cmath>

#include "bem/cost.hpp"
#include "bem/galerkin/close_cost.hpp"
#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace {

// Fitted to cubes, bars and organic bodies of 56 to 1500 vertices.
/// Integrals for each pair of triangles, and for each triangle, whose pairs that touch or are close are a few.
constexpr double kIntegralsOfAPair = 6.0, kIntegralsOfATriangle = 5000.0;
/// The same of a constrained set: for pairs of one of its triangles and any, and of two of its own.
constexpr double kIntegralsOfASet = 5.0, kIntegralsWithinASet = 57.0;
/// Bytes of the rows that wait to be added to the hypersingular matrix: for each vertex, beside a constant, and at most
/// for each pair of vertices (small bodies).
constexpr double kRowMemoryPerVertex = 17e3, kLeastRowMemory = 12e6, kRowMemoryPerPair = 160.0;
constexpr HierarchicalPrices kHierarchical{
    .bytes = 8.2e3, .precomputation = 4800.0, .set = 500.0, .set_triangles = 7100.0};

/// With finer rims D is integrated and factorised again: for each triangle along a rim, and for its pairs with any.
constexpr double kIntegralsOfARim = 1.7e5, kIntegralsAcrossRims = 130.0, kIntegralsBetweenRims = 1700.0;

/// The single layer is factorised and eliminated from all rows.
PredictedWork work_of_set(const SurfaceMesh& mesh) {
    const double n = 3.0 * mesh.n_vertices(), set = UsualSet(mesh).triangles, tractions = 3.0 * set;
    return {1.7 * tractions * tractions * tractions + 4.2 * n * tractions * tractions + 330.0 * n * n,
            kIntegralsOfASet * mesh.n_triangles() * set + kIntegralsWithinASet * set * set};
}

PredictedWork work_of_finer_rims(const SurfaceMesh& mesh, int rows) {
    const double n = 3.0 * mesh.n_vertices();
    const double thin = 5.0 * std::sqrt(UsualSet(mesh).vertices) * (std::exp2(rows) - 1.0);
    const PredictedWork as_given = work_of_set(mesh);
    return {5.0 * as_given.flops + 2.3 * n * n * n,
            5.0 * as_given.integrals +
                thin * (kIntegralsOfARim + kIntegralsAcrossRims * mesh.n_triangles() + kIntegralsBetweenRims * thin)};
}

}  // namespace

std::uint64_t hierarchical_set_memory(std::int64_t n_vertices, std::int64_t n_loaded, std::int64_t n_tractions) {
    const auto n = static_cast<double>(n_vertices), m = static_cast<double>(n_tractions);
    const double factorised = n_tractions <= kMostFactorisedTractions ? m * m : 0.0;
    return static_cast<std::uint64_t>(16e3 * n + 45e3 * static_cast<double>(n_loaded) + 16.0 * factorised);
}

/// Half an LU, and half of the pairs of triangles: each once.
Cost predict_galerkin_bem(const SurfaceMesh& mesh, const Method& method) {
    if (is_hierarchical(mesh, method)) {
        Cost cost = predict_hierarchical(mesh, kHierarchical);
        cost.seconds += costly_pair_integrals(mesh) / integral_speed();
        return cost;
    }
    const double n = 3.0 * mesh.n_vertices(), triangles = mesh.n_triangles();
    const double vertices = mesh.n_vertices();
    const double waiting =
        std::min(kLeastRowMemory + kRowMemoryPerVertex * vertices, kRowMemoryPerPair * vertices * vertices);
    Cost cost{static_cast<std::int64_t>(n), kLeastMemory + static_cast<std::uint64_t>(waiting), 0.0};
    const bool factorises = factorises_ahead(method), keeps_integrals = method.rims > 0;
    if (!factorises && !keeps_integrals) return cost;
    PredictedWork work = method.rims > 0 ? work_of_finer_rims(mesh, method.rims) : work_of_set(mesh);
    work.integrals +=
        kIntegralsOfAPair * triangles * triangles + kIntegralsOfATriangle * triangles + costly_pair_integrals(mesh);
    if (keeps_integrals) cost.memory_bytes += square_bytes(n);
    if (factorises) {
        cost.memory_bytes += square_bytes(n);
        work.flops += 0.2 * n * n * n;
    }
    if (method.mode != Mode::on_demand) {
        cost.memory_bytes += 4 * square_bytes(n);
        work.flops += 2.5 * n * n * n;
    }
    cost.seconds = work.seconds();
    return cost;
}

}  // namespace elastolab
