#pragma once

#include <string>

#include "base/control.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab {

/// A surface that was made to stand for another.
struct WrapResult {
    SurfaceMesh surface;
    double alpha = 0.0;   ///< of a wrap: into openings narrower than about this it does not go [L]
    double offset = 0.0;  ///< of a wrap: distance of its vertices from the other's triangles [L]
    int n_holes = 0;      ///< that were filled
    std::string failure;  ///< empty on success; else what went wrong
};

/// A closed, oriented 2-manifold without self-intersections around any triangles: the alpha wrap of CGAL (C. Portaneri,
/// M. Rouxel-Labbe, M. Hemmer, D. Cohen-Steiner, P. Alliez, Alpha wrapping with an offset, ACM Trans. Graph. 41, 2022),
/// in a process of its own. Coordinates are finite and at most 1e3 or so; triangles without area do not count. Throws
/// MeshError only when the helper program is missing; Cancelled.
WrapResult alpha_wrap(const SurfaceMesh& triangles, double alpha, Control& control);
/// The same of so many vertices within that factor if a few attempts reach it, the first of them rather too rough than
/// too fine. `known`: an earlier wrap of the same triangles, which tells how many vertices go to a square of alpha.
WrapResult alpha_wrap(const SurfaceMesh& triangles, int n_vertices, double within, const WrapResult& known,
                      Control& control);

/// A closed manifold surface with edges collapsed until it has so many vertices, its volume kept (P. Lindstrom, G.
/// Turk, Fast and memory efficient polygonal simplification, 1998), in the same process. Parts of the result may cross.
WrapResult collapse_edges(const SurfaceMesh& surface, int n_vertices, Control& control);

/// The surface with its holes filled, in the same process (P. Liepa, Filling holes in meshes, 2003): with triangles as
/// fine as those around that go on smoothly, or with those alone that join the vertices of a rim. Vertices and
/// triangles that are there come first. Parts of the result may cross.
enum class HoleFilling { smooth, flat };
WrapResult fill_holes(const SurfaceMesh& surface, HoleFilling how, Control& control);

}  // namespace elastolab
