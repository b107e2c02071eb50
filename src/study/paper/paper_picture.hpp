#pragma once

#include <string>
#include <vector>

#include "deform/model.hpp"
#include "study/report/plot.hpp"

namespace elastolab {

/// The paper's Fig. 1: a cube stretched between two faces, by constant and by linear elements. Constant elements show a
/// vertex at the mean of its triangles, which pulls edges and corners in.
struct EdgeArtefact {
    std::string method;
    SurfaceMesh deformed;
    /// Largest error of a vertex as a share of the stretch: on the edges of the cube, and inside its faces.
    double on_edges = 0.0, on_faces = 0.0;
};
EdgeArtefact edge_artefact(MethodKind kind, int cells, Control& control);

/// The deformed cubes side by side, hidden faces left out, shaded; drawn by gnuplot from plain polygons.
Plot edge_picture(const std::vector<EdgeArtefact>& artefacts);

}  // namespace elastolab
