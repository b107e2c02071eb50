#include "bem/galerkin/surfaces.hpp"

#include "elasticity/rigid_motion.hpp"
#include "mesh/topology.hpp"

namespace elastolab {

ClosedSurfaces::ClosedSurfaces(const SurfaceMesh& mesh)
    : triangles(connected_components(mesh, EdgeTable(mesh)).triangles()),
      surface_of_triangle(static_cast<std::size_t>(mesh.n_triangles())) {
    rigid = Eigen::MatrixXd::Zero(3 * mesh.n_vertices(), 6 * size());
    for (int s = 0; s < size(); ++s) {
        std::vector<char> on_surface(static_cast<std::size_t>(mesh.n_vertices()), 0);
        for (const int t : triangles[static_cast<std::size_t>(s)]) {
            surface_of_triangle[static_cast<std::size_t>(t)] = s;
            for (const int v : mesh.triangles.col(t)) on_surface[static_cast<std::size_t>(v)] = 1;
        }
        std::vector<int> vertices;
        for (int v = 0; v < mesh.n_vertices(); ++v)
            if (on_surface[static_cast<std::size_t>(v)]) vertices.push_back(v);
        const Eigen::MatrixXd modes = rigid_modes(mesh.vertices(Eigen::all, vertices));
        for (std::size_t i = 0; i < vertices.size(); ++i)
            rigid.block<3, 6>(3 * vertices[i], 6 * s) = modes.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    }
}

Eigen::MatrixXd rigid_tractions(const Boundary& boundary, const std::vector<int>& triangles) {
    Eigen::Matrix3Xd centroids(3, std::ssize(triangles));
    for (std::size_t i = 0; i < triangles.size(); ++i)
        centroids.col(static_cast<Eigen::Index>(i)) =
            Eigen::Map<const Eigen::Vector3d>(boundary.triangle(triangles[i]).centroid);
    return rigid_modes(centroids);
}

}  // namespace elastolab
