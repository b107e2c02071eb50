#include "bem/error_estimate.hpp"

#include "bem/source_strips.hpp"

namespace elastolab {

namespace {

/// Of the integrals: far below what an estimate within a factor of two needs.
constexpr double kTolerance = 1e-4;

}  // namespace

Eigen::VectorXd residual_between_nodes(const BemSystem& system, const TractionSpace& space,
                                       const NodeSolution& solution, Control& control) {
    const Boundary& boundary = system.boundary();
    const SurfaceMesh& mesh = boundary.mesh();
    const Eigen::VectorXd u = solution.displacements.col(0), q = solution.loads.col(0);
    Eigen::VectorXd at_centroids(3 * mesh.n_triangles());
    for_source_strips(linear_centroid_sources(boundary), [&](int first, const Sources& strip) {
        at_centroids.segment(3 * first, 3 * strip.size()) =
            system.double_layer(strip, control, kTolerance) * u -
            system.single_layer(strip, space.elements, control, kTolerance) * q;
        control.set_progress(static_cast<double>(first) / mesh.n_triangles());
    });
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(3 * mesh.n_vertices()),
                    area = Eigen::VectorXd::Zero(mesh.n_vertices());
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (const int v : mesh.triangles.col(t)) {
            mean.segment<3>(3 * v) += 0.75 * boundary.area(t) * at_centroids.segment<3>(3 * t);
            area[v] += boundary.area(t);
        }
    for (int v = 0; v < mesh.n_vertices(); ++v) mean.segment<3>(3 * v) /= area[v];
    return mean;
}

Eigen::VectorXd spread_around_vertices(const BemSystem& system, const SparseRows& display,
                                       const NodeSolution& solution) {
    const Eigen::VectorXd u = solution.displacements.col(0), shown = display * u;
    Eigen::VectorXd spread = Eigen::VectorXd::Zero(shown.size());
    for (int v = 0; v < system.boundary().mesh().n_vertices(); ++v)
        for (const int t : system.triangles_of_vertex()[v]) {
            const Eigen::Vector3d off = u.segment<3>(3 * t) - shown.segment<3>(3 * v);
            if (off.norm() > spread.segment<3>(3 * v).norm()) spread.segment<3>(3 * v) = off;
        }
    return spread;
}

}  // namespace elastolab
