#include "findings/cost.hpp"

#include <cmath>
#include <Eigen/Geometry>
#include <string>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/timer.hpp"

namespace elastolab {

namespace {

/// Arithmetic per pair of source and triangle, in flops at the speed of the matrix product: about 0.1 us on a core.
constexpr double kFlopsPerPair = 3000.0;

/// Flops a second of a matrix product on this machine, measured once.
double product_speed() {
    static const double speed = [] {
        constexpr Eigen::Index n = 512;
        const Eigen::MatrixXd A = Eigen::MatrixXd::Constant(n, n, 1.0);
        Eigen::MatrixXd B = A * A;  // wakes the threads
        const Stopwatch watch;
        B.noalias() = A * A;
        return 2.0 * n * n * n / std::max(watch.seconds(), 1e-6);
    }();
    return speed;
}

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

std::uint64_t square_bytes(double n) { return static_cast<std::uint64_t>(8.0 * n * n); }

Cost predict_bem(const SurfaceMesh& mesh, const Method& method) {
    const double nodes = method.kind == MethodKind::constant_bem ? mesh.n_triangles() : mesh.n_vertices();
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

Cost predict_fem(const SurfaceMesh& mesh, const Method& method) {
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

std::string in_gigabytes(std::uint64_t bytes) {
    std::string text = std::to_string(static_cast<double>(bytes) / 1e9);
    return text.substr(0, text.find('.') + 2) + " GB";
}

}  // namespace

Cost predict_cost(const SurfaceMesh& mesh, const Method& method) {
    return method.kind == MethodKind::fem ? predict_fem(mesh, method) : predict_bem(mesh, method);
}

void require_memory(const Cost& cost, const Method& method) {
    const std::uint64_t available = available_memory_bytes();
    if (cost.memory_bytes <= available) return;
    const char* cheaper = method.mode == Mode::full_volume          ? "the mode full"
                          : method.mode == Mode::full               ? "the mode on-demand"
                          : method.kind == MethodKind::constant_bem ? "linear-bem, which needs a quarter"
                          : method.kind == MethodKind::linear_bem   ? "fem, whose matrix is sparse"
                                                                    : "a coarser mesh";
    throw SolveError(std::string(name(method.kind)) + ", mode " + std::string(name(method.mode)) + ": needs " +
                     in_gigabytes(cost.memory_bytes) + " of memory, " + in_gigabytes(available) + " are free. Choose " +
                     cheaper + ".");
}

}  // namespace elastolab
