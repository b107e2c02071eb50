#include "fem/cost.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numbers>

#include "deform/machine_speed.hpp"
#include "mesh/surface_mesh.hpp"
#include "mesh/tets/node_estimate.hpp"

namespace elastolab {

namespace {

/// 36 pi V^2 / A^3: 1 for a ball, small for what is long or thin and has small separators.
double roundness(const SurfaceMesh& mesh) {
    double volume = 0.0, area = 0.0;
    // About a vertex of the body: about the origin the volume of a body far away would be lost in cancellation.
    const Eigen::Vector3d origin = mesh.vertices.leftCols(1).rowwise().sum();
    for (const auto& t : mesh.triangles.colwise()) {
        const Eigen::Vector3d a = mesh.vertices.col(t[0]) - origin, b = mesh.vertices.col(t[1]) - origin,
                              c = mesh.vertices.col(t[2]) - origin;
        volume += a.dot(b.cross(c)) / 6.0;
        area += 0.5 * (b - a).cross(c - a).norm();
    }
    if (!(area > 0.0)) return 1.0;
    const double squared = 36.0 * std::numbers::pi * volume * volume / (area * area * area);
    return std::min(1.0, std::max(squared, 1e-6));
}

/// Until TetGen's process runs [s].
constexpr double kStart = 0.005;

}  // namespace

FactorEstimate::FactorEstimate(const SurfaceMesh& mesh, double nodes, bool quadratic) {
    const double N = std::log(nodes), round = std::log(roundness(mesh)), inside = std::log(nodes / mesh.n_vertices());
    if (quadratic) {
        entries = 1e6 * std::exp(-7.878 + 1.4935 * N + 0.4956 * round + 0.1344 * inside);
        flops = 1e9 * std::exp(-11.309 + 2.0683 * N + 1.0013 * round - 0.1498 * inside);
        nonzeros = std::exp(6.721 + 1.1148 * N + 0.1653 * round + 0.0168 * inside);
    } else {
        entries = 1e6 * std::exp(-10.884 + 1.3441 * N + 0.1874 * round + 1.2735 * inside);
        flops = 1e9 * std::exp(-13.930 + 1.6799 * N + 0.4645 * round + 1.3856 * inside);
        nonzeros = std::exp(4.2565 + 1.0423 * N + 0.0504 * round + 0.3334 * inside);
    }
}

/// Measured: half the speed of a product; copies, the estimate of the condition and the first columns by entries.
Work FactorEstimate::work() const { return {.flops = 2.4 * flops + 1500.0 * entries}; }

Cost predict_sparse(const FactorEstimate& factor, double unknowns, double elements_work) {
    Cost cost{static_cast<std::int64_t>(unknowns)};
    // The factor with its blocks' corners; K, its two parts and K with the fixed set eliminated; tetrahedra and
    // columns; what the allocator keeps.
    cost.memory_bytes =
        static_cast<std::uint64_t>(10.5 * factor.entries + 4.0 * 13.0 * factor.nonzeros + 200.0 * unknowns + 8e6);
    cost.work = factor.work();
    cost.work += {.scalars = elements_work, .waiting = kStart};
    return cost;
}

Cost predict_linear_fem(const SurfaceMesh& mesh, const Method& method) {
    const double all = estimated_tet_nodes(mesh), n = 3.0 * all, surface = 3.0 * mesh.n_vertices();
    const FactorEstimate factor(mesh, all, false);
    Cost cost = predict_sparse(factor, n, kNodeWork * all);
    if (method.mode == Mode::on_demand) return cost;
    const double dense = method.mode == Mode::full ? surface : n;
    cost.memory_bytes += 4 * square_bytes(dense + 6.0);
    cost.work.flops += 2.0 * dense * dense * dense + 4.0 * surface * factor.entries;
    return cost;
}

}  // namespace elastolab
