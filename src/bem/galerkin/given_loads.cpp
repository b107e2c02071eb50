#include "bem/galerkin/given_loads.hpp"

#include <algorithm>
#include <vector>

#include "bem/given_loads.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

/// The loaded triangles and, for each load, the mean traction on each of them.
PiecewiseTractions mean_tractions(const Boundary& boundary, std::span<const UnitLoad> loads) {
    PiecewiseTractions mean;
    std::vector<int>& triangles = mean.triangles;
    const std::vector<GivenTractions> kinds = given_tractions(boundary, loads);
    for (const GivenTractions& given : kinds)
        for (const auto& element : given.elements.elements) triangles.push_back(element.triangle);
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    std::vector<int> place(static_cast<std::size_t>(boundary.n_triangles()), -1);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        place[static_cast<std::size_t>(triangles[i])] = static_cast<int>(i);
    mean.values.setZero(3 * std::ssize(triangles), std::ssize(loads));
    for (const GivenTractions& given : kinds) {
        const int n_corners = given.elements.order == Elements::Order::linear ? 3 : 1;
        for (const auto& element : given.elements.elements)
            for (int corner = 0; corner < n_corners; ++corner)
                for (std::size_t c = 0; c < given.columns.size(); ++c)
                    mean.values.block<3, 1>(3 * place[static_cast<std::size_t>(element.triangle)], given.columns[c]) +=
                        given.coefficients.block<3, 1>(3 * element.slots[static_cast<std::size_t>(corner)],
                                                       static_cast<Eigen::Index>(c)) /
                        n_corners;
    }
    return mean;
}

/// B^T g, exactly: int phi_a g over each triangle.
Eigen::MatrixXd tested_with_hats(const Boundary& boundary, std::span<const UnitLoad> loads) {
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(boundary.mesh().vertices.size(), std::ssize(loads));
    for (const GivenTractions& given : given_tractions(boundary, loads)) {
        const bool linear = given.elements.order == Elements::Order::linear;
        for (const auto& element : given.elements.elements)
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < (linear ? 3u : 1u); ++b) {
                    const double weight =
                        boundary.area(element.triangle) * (!linear ? 1.0 / 3.0 : (a == b ? 2.0 : 1.0) / 12.0);
                    const int v = boundary.mesh().triangles(static_cast<Eigen::Index>(a), element.triangle);
                    for (std::size_t c = 0; c < given.columns.size(); ++c)
                        f.block<3, 1>(3 * v, given.columns[c]) +=
                            weight * given.coefficients.block<3, 1>(3 * element.slots[b], static_cast<Eigen::Index>(c));
                }
    }
    return f;
}

}  // namespace

Eigen::MatrixXd given_layers(const BoundaryPairs& pairs, const Material& material, std::span<const UnitLoad> loads,
                             const LayerOptions& options, Control& control) {
    const Boundary& boundary = pairs.boundary();
    Eigen::MatrixXd sums = layers_of_tractions(pairs, material, mean_tractions(boundary, loads), options, control);
    // K is freed of the rigid motions of the body, as in the equations.
    auto layer = sums.topRows(boundary.mesh().vertices.size());
    const Eigen::MatrixXd modes = rigid_modes(boundary.mesh().vertices);
    layer -= modes * (modes.transpose() * layer).eval();
    layer = tested_with_hats(boundary, loads) - layer;
    return sums;
}

Eigen::MatrixXd given_single_layer(const Eigen::MatrixXd& layers, const Boundary& boundary,
                                   const ClosedSurfaces& surfaces, const GalerkinTractions& tractions) {
    const auto of_triangles = layers.bottomRows(3 * boundary.n_triangles());
    Eigen::MatrixXd rows(tractions.size(), layers.cols());
    Eigen::Index to = 0;
    for (const int t : tractions.triangles) {
        rows.middleRows<3>(to) = of_triangles.middleRows<3>(3 * t);
        to += 3;
    }
    for (const int s : tractions.free_surfaces) {
        const std::vector<int>& triangles = surfaces.triangles[static_cast<std::size_t>(s)];
        const Eigen::MatrixXd fields = rigid_tractions(boundary, triangles);
        rows.middleRows<6>(to).setZero();
        for (std::size_t i = 0; i < triangles.size(); ++i)
            rows.middleRows<6>(to) += fields.middleRows<3>(3 * static_cast<Eigen::Index>(i)).transpose() *
                                      of_triangles.middleRows<3>(3 * triangles[i]);
        to += 6;
    }
    return rows;
}

}  // namespace elastolab
