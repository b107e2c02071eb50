#pragma once

#include "bodies/patchwork.hpp"
#include "bodies/solid.hpp"

namespace elastolab::bodies {

/// Makes the triangles of a solid's surface even: edges about as long as solid.edge_length wants, angles near 60
/// degrees, vertices on their sheets. Sharp edges and corners stay. Alternates splitting of long edges, collapsing of
/// short ones, flips and tangential smoothing (M. Botsch, L. Kobbelt, A remeshing approach to multiresolution modeling,
/// SGP 2004), then moves single vertices to raise the smallest angle around them. The same on every machine.
void remesh(Patchwork& surface, const Solid& solid);

}  // namespace elastolab::bodies
