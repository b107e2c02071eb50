#pragma once

// CGAL's types, for the sources of the helper program elastolab-wrap alone.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <vector>

#include "mesh/wrap/wrap_protocol.hpp"

namespace elastolab {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Soup {
    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> triangles;
};

struct Result {
    Mesh mesh;
    double alpha = 0.0, offset = 0.0;
    int n_holes = 0;  ///< that were filled
};

/// The mesh of these triangles, numbered alike. Throws std::runtime_error when they are no oriented 2-manifold.
Mesh mesh_of(const Soup& soup);

/// Fills every hole of an oriented manifold: with triangles as fine as those around it that go on smoothly, or with
/// none but those that join the vertices of its rim. Vertices that are there stay where they are and come first.
Result fill_holes(const Soup& soup, WrapTask how);

}  // namespace elastolab
