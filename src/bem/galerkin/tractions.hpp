#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <span>
#include <vector>

#include "bem/galerkin/surfaces.hpp"

namespace elastolab {

/// The traction space of one constrained set: constant on each triangle whose vertices are all constrained, and the six
/// rigid fields on each closed surface that has no such triangle while another has (of several surfaces without any,
/// all but the first). The latter fix how a surface moves against the others, which the hypersingular operator does not
/// know.
struct GalerkinTractions {
    std::vector<int> triangles;      ///< constrained, ascending
    std::vector<int> free_surfaces;  ///< that carry rigid fields

    GalerkinTractions() = default;
    GalerkinTractions(const SurfaceMesh& mesh, const ClosedSurfaces& surfaces, std::span<const int> vertices);
    /// Triangles that carry tractions, those of whole surfaces too.
    std::int64_t n_loaded(const ClosedSurfaces& surfaces) const {
        std::int64_t n = std::ssize(triangles);
        for (const int s : free_surfaces) n += std::ssize(surfaces.triangles[static_cast<std::size_t>(s)]);
        return n;
    }
    /// Scalar unknowns: those of the triangles, then those of the surfaces.
    Eigen::Index size() const { return 3 * std::ssize(triangles) + 6 * std::ssize(free_surfaces); }
};

/// The operators of such a space.
struct GalerkinOperators {
    Eigen::MatrixXd single_layer;  ///< size() square, symmetric
    Eigen::MatrixXd double_layer;  ///< size() x 3V; annihilates rigid motions of the whole body to rounding
};

}  // namespace elastolab
