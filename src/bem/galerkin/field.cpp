#include "bem/galerkin/field.hpp"

#include <array>
#include <utility>

#include "bem/given_loads.hpp"

namespace elastolab {

namespace {

/// Tractions of the vertices that have no constrained triangle, from their forces.
void add_lone_forces(const Boundary& boundary, const std::vector<int>& vertices, const std::vector<int>& constrained,
                     const Eigen::MatrixXd& forces, SurfaceTractions& tractions) {
    const SurfaceMesh& mesh = boundary.mesh();
    std::vector<int> slot(static_cast<std::size_t>(mesh.n_vertices()), -1);
    for (std::size_t i = 0; i < vertices.size(); ++i) slot[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
    for (const int t : constrained)
        for (const int v : mesh.triangles.col(t)) slot[static_cast<std::size_t>(v)] = -1;
    Elements hats{Elements::Order::linear, static_cast<int>(vertices.size()), {}};
    Eigen::VectorXd integrals = Eigen::VectorXd::Zero(hats.n_slots);
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        Elements::Element element{t, {-1, -1, -1}};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const int s = slot[static_cast<std::size_t>(mesh.triangles(static_cast<Eigen::Index>(corner), t))];
            element.slots[corner] = s;
            if (s >= 0) integrals[s] += boundary.area(t) / 3.0;
        }
        if (element.slots != std::array{-1, -1, -1}) hats.elements.push_back(element);
    }
    Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
    for (Eigen::Index s = 0; s < hats.n_slots; ++s)
        if (integrals[s] > 0.0) coefficients.middleRows<3>(3 * s) = forces.middleRows<3>(3 * s) / integrals[s];
    tractions.add(hats, coefficients);
}

}  // namespace

std::shared_ptr<const InteriorField> galerkin_field(const std::shared_ptr<const Boundary>& boundary,
                                                    double poisson_ratio, const std::vector<int>& vertices,
                                                    const GalerkinTractions& space, std::span<const UnitLoad> loads,
                                                    NodeSolution&& solution) {
    SurfaceTractions tractions(solution.displacements.cols());
    const Eigen::Index n_forces = 3 * std::ssize(vertices), n_tractions = 3 * std::ssize(space.triangles);
    tractions.add(constant_elements(space.triangles), solution.loads.middleRows(n_forces, n_tractions));
    add_lone_forces(*boundary, vertices, space.triangles, solution.loads.topRows(n_forces), tractions);
    if (!space.free_surfaces.empty()) {
        const ClosedSurfaces surfaces(boundary->mesh());
        Eigen::Index next = n_forces + n_tractions;
        for (const int s : space.free_surfaces) {
            const std::vector<int>& all = surfaces.triangles[static_cast<std::size_t>(s)];
            tractions.add(constant_elements(all), rigid_tractions(*boundary, all) * solution.loads.middleRows(next, 6));
            next += 6;
        }
    }
    add_given(*boundary, loads, solution.factors, tractions);
    return with_body_forces(std::make_shared<const BoundaryField>(
                                boundary, poisson_ratio, std::move(solution.displacements), std::move(tractions)),
                            boundary->mesh(), poisson_ratio, loads, solution.factors);
}

}  // namespace elastolab
