#pragma once

#include "deform/method.hpp"

namespace elastolab {

/// Whether Galerkin and linear BEM keep their operators as hierarchical matrices: on demand, on surfaces for which that
/// is cheaper.
bool is_hierarchical(const SurfaceMesh& surface, const Method& method);
bool is_hierarchical(std::int64_t n_vertices, const Method& method);

/// The constrained set that predictions reckon with: a tenth of the vertices, in two patches.
struct UsualSet {
    double vertices, triangles;  ///< triangles: those with a constrained corner

    explicit UsualSet(const SurfaceMesh& surface);
};

/// Bytes that every boundary method needs besides its matrices.
constexpr std::uint64_t kLeastMemory = 12u << 20;

/// Levels of clusters of hierarchical matrices.
double cluster_levels(std::int64_t n_vertices);
/// What a method with hierarchical matrices takes. Time was measured to grow with the power 4/3 of sizes.
struct HierarchicalPrices {
    double bytes;           ///< for a vertex and level of clusters
    double precomputation;  ///< integrals over that power of the vertices
    double set;             ///< the same for a constrained set
    double set_triangles;   ///< and over that power of the set's triangles
};
Cost predict_hierarchical(const SurfaceMesh& surface, const HierarchicalPrices& prices);

}  // namespace elastolab
