#include "bem/galerkin/cost.hpp"

#include <algorithm>
#include <cmath>

#include "bem/cost.hpp"
#include "bem/galerkin/close_cost.hpp"
#include "bem/galerkin/finer_rims.hpp"
#include "bem/galerkin/solvers.hpp"
#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

namespace {

// Fitted to cubes, bars and organic bodies of 56 to 1500 vertices.
/// Integrals for each pair of triangles, and for each triangle, whose pairs that touch or are close are a few.
constexpr double kIntegralsOfAPair = 6.0, kIntegralsOfATriangle = 5000.0;
/// The same of a constrained set, and of given loads: for each of their triangles with any.
constexpr double kIntegralsOfASet = 12.0;
/// Time of one answer by elimination over that of these prices, which are of columns that serve further sets too. On
/// cubes, bars and plates with finer rims, of 46 to 890 vertices, it was 0.54 to 1.15.
constexpr double kShareOfDirect = 0.75;
/// Bytes of the rows that wait to be added to the hypersingular matrix: for each vertex, beside a constant, and at most
/// for each pair of vertices (small bodies).
constexpr double kRowMemoryPerVertex = 17e3, kLeastRowMemory = 12e6, kRowMemoryPerPair = 160.0;
constexpr HierarchicalPrices kHierarchical{
    .bytes = 8.2e3, .precomputation = 4800.0, .set = 500.0, .set_triangles = 7100.0};

/// With finer rims D is integrated and factorised again: for each triangle along a rim, and for its pairs with any.
constexpr double kIntegralsOfARim = 1.7e5, kIntegralsAcrossRims = 130.0, kIntegralsBetweenRims = 1700.0;
/// The same for each triangle along a re-entrant edge, most of which carry no tractions, and for its pairs: on a letter
/// E, a Menger sponge and a twisted bar of 266 to 722 vertices 0.6 to 1.7 times what was measured.
constexpr double kIntegralsOfAnEdge = 6e4, kIntegralsAcrossEdges = 60.0;

/// D, each pair of triangles once.
double integrals_of_hypersingular(const SurfaceMesh& mesh) {
    const double triangles = mesh.n_triangles();
    return kIntegralsOfAPair * triangles * triangles + kIntegralsOfATriangle * triangles + costly_pair_integrals(mesh);
}

/// The single layer is factorised and eliminated from all rows. set: its triangles.
Work work_of_set(const SurfaceMesh& mesh, double set) {
    const double n = 3.0 * mesh.n_vertices(), tractions = 3.0 * set;
    return {.flops = 1.7 * tractions * tractions * tractions + 4.2 * n * tractions * tractions + 330.0 * n * n,
            .integrals = kIntegralsOfASet * mesh.n_triangles() * set};
}

/// Half an LU.
double flops_of_factor(double n) { return 0.2 * n * n * n; }

/// Triangles that finer rims add.
struct ThinTriangles {
    double along_rim = 0.0;    ///< of a usual set
    double along_edges = 0.0;  ///< re-entrant ones, which the body alone has

    ThinTriangles(const SurfaceMesh& mesh, int rows) {
        if (rows == 0) return;
        along_rim = 5.0 * std::sqrt(UsualSet(mesh).vertices) * (std::exp2(rows) - 1.0);
        along_edges = FinerRims(mesh, {}, {}, rows, LoneVertices::kept).surface.mesh.n_triangles() - mesh.n_triangles();
    }
    /// Of the surface with them.
    double n_vertices(const SurfaceMesh& mesh) const { return mesh.n_vertices() + 0.5 * (along_rim + along_edges); }
};

bool is_hierarchical_with(const ThinTriangles& thin, const SurfaceMesh& mesh, const Method& method) {
    return is_hierarchical(static_cast<std::int64_t>(thin.n_vertices(mesh)), method);
}

Work work_of_finer_rims(const SurfaceMesh& mesh, const ThinTriangles& thin) {
    const double n = 3.0 * thin.n_vertices(mesh), triangles = mesh.n_triangles();
    const double rim = thin.along_rim, edges = thin.along_edges;
    const Work as_given = work_of_set(mesh, UsualSet(mesh).triangles);
    return {.flops = 5.0 * as_given.flops + 2.3 * n * n * n,
            .integrals = 5.0 * as_given.integrals +
                         rim * (kIntegralsOfARim + kIntegralsAcrossRims * triangles + kIntegralsBetweenRims * rim) +
                         edges * (kIntegralsOfAnEdge + kIntegralsAcrossEdges * (triangles + 0.5 * edges))};
}

}  // namespace

std::uint64_t hierarchical_memory(const SurfaceMesh& mesh) {
    return predict_hierarchical(mesh, kHierarchical).memory_bytes;
}

std::uint64_t hierarchical_set_memory(std::int64_t n_vertices, std::int64_t n_loaded, std::int64_t n_tractions) {
    const auto n = static_cast<double>(n_vertices), m = static_cast<double>(n_tractions);
    const double factorised = n_tractions <= kMostFactorisedTractions ? m * m : 0.0;
    return static_cast<std::uint64_t>(16e3 * n + 45e3 * static_cast<double>(n_loaded) + 16.0 * factorised);
}

bool has_hierarchical_model(const SurfaceMesh& mesh, const Method& method) {
    return is_hierarchical_with(ThinTriangles(mesh, method.rims), mesh, method);
}

Cost predict_galerkin_bem(const SurfaceMesh& mesh, const Method& method) {
    const ThinTriangles thin(mesh, method.rims);
    if (is_hierarchical_with(thin, mesh, method)) {
        Cost cost = predict_hierarchical(mesh, kHierarchical);
        cost.work.integrals += costly_pair_integrals(mesh);
        const double finer = thin.n_vertices(mesh) / mesh.n_vertices();
        cost.memory_bytes = static_cast<std::uint64_t>(finer * static_cast<double>(cost.memory_bytes));
        cost.work *= finer * std::cbrt(finer);
        return cost;
    }
    const double vertices = mesh.n_vertices(), n = 3.0 * vertices;
    const double waiting =
        std::min(kLeastRowMemory + kRowMemoryPerVertex * vertices, kRowMemoryPerPair * vertices * vertices);
    Cost cost{static_cast<std::int64_t>(n), kLeastMemory + static_cast<std::uint64_t>(waiting)};
    const bool factorises = factorises_ahead(method), keeps_integrals = method.rims > 0;
    if (!factorises && !keeps_integrals) return cost;
    Work work = method.rims > 0 ? work_of_finer_rims(mesh, thin) : work_of_set(mesh, UsualSet(mesh).triangles);
    work.integrals += integrals_of_hypersingular(mesh);
    if (keeps_integrals) cost.memory_bytes += square_bytes(n);
    if (factorises) {
        cost.memory_bytes += square_bytes(n);
        work.flops += flops_of_factor(n);
    }
    if (method.mode != Mode::on_demand) {
        cost.memory_bytes += 4 * square_bytes(n);
        work.flops += 2.5 * n * n * n;
    }
    cost.work = work;
    const auto prescribed = static_cast<std::int64_t>(3.0 * UsualSet(mesh).vertices);
    const auto tractions = static_cast<std::int64_t>(3.0 * UsualSet(mesh).triangles);
    const bool may_be_alone = method.first_set_alone && factorises && method.mode == Mode::on_demand;
    if (may_be_alone && is_sooner_alone(static_cast<std::int64_t>(n), prescribed, tractions))
        cost.work *= kShareOfDirect;
    return cost;
}

std::uint64_t galerkin_answer_memory(const SurfaceMesh& mesh, const Method& method, std::int64_t n_loaded,
                                     std::int64_t n_tractions) {
    return is_hierarchical(mesh, method)
               ? hierarchical_memory(mesh) + hierarchical_set_memory(mesh.n_vertices(), n_loaded, n_tractions)
               : galerkin_direct_memory(3 * std::int64_t{mesh.n_vertices()}, n_tractions);
}

Work predict_galerkin_answer(const SurfaceMesh& mesh, std::int64_t n_constrained, std::int64_t n_loaded) {
    Work work = work_of_set(mesh, static_cast<double>(n_constrained));
    work.flops += flops_of_factor(3.0 * mesh.n_vertices());
    const double triangles = mesh.n_triangles(), loaded = static_cast<double>(n_loaded);
    const double of_both = 2.0 * (static_cast<double>(n_constrained) + loaded) / triangles;  // from either of a pair
    work.integrals += integrals_of_hypersingular(mesh) + kIntegralsOfASet * triangles * loaded +
                      of_both * costly_pair_integrals(mesh);
    return work *= kShareOfDirect;
}

}  // namespace elastolab
