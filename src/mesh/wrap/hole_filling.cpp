// CGAL's filling of holes: the triangulation of least area and bending (P. Liepa, Filling holes in meshes, 2003),
// refined and faired; the linear system is Eigen's.
#define CGAL_EIGEN3_ENABLED
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <iterator>

#include "mesh/wrap/cgal_mesh.hpp"

namespace elastolab {

Result fill_holes(const Soup& soup, WrapTask how) {
    namespace processing = CGAL::Polygon_mesh_processing;
    Result result;
    result.mesh = mesh_of(soup);
    std::vector<Mesh::Halfedge_index> rims;
    processing::extract_boundary_cycles(result.mesh, std::back_inserter(rims));
    for (const Mesh::Halfedge_index rim : rims) {
        std::vector<Mesh::Face_index> faces;
        std::vector<Mesh::Vertex_index> vertices;
        if (how == WrapTask::fill_smooth)
            processing::triangulate_refine_and_fair_hole(result.mesh, rim, std::back_inserter(faces),
                                                         std::back_inserter(vertices));
        else
            processing::triangulate_hole(result.mesh, rim, std::back_inserter(faces));
        if (!faces.empty()) ++result.n_holes;
    }
    return result;
}

}  // namespace elastolab
