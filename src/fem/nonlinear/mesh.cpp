#include "fem/nonlinear/mesh.hpp"

#include "fem/load_vectors.hpp"
#include "fem/quadratic_mesh.hpp"

namespace elastolab {

std::shared_ptr<const NonlinearMesh> make_nonlinear_mesh(TetMesh tets, const Triangles& surface, ElementDegree degree) {
    auto mesh = std::make_shared<NonlinearMesh>();
    mesh->surface = surface;
    if (degree == ElementDegree::linear) {
        mesh->elements = std::make_shared<const FiniteElements>(tets.vertices, tets.tetrahedra);
        mesh->n_surface_nodes = tets.n_surface_vertices;
        mesh->tets = std::move(tets);
        return mesh;
    }
    QuadraticMesh quadratic(tets);
    mesh->elements = std::make_shared<const FiniteElements>(quadratic.positions, quadratic.elements);
    mesh->linear = std::make_shared<const FiniteElements>(tets.vertices, tets.tetrahedra);
    const int shift = quadratic.n_surface_nodes - quadratic.n_surface_vertices;
    for (int v = 0; v < tets.n_vertices(); ++v)
        mesh->corner_nodes.push_back(v < tets.n_surface_vertices ? v : v + shift);
    mesh->n_surface_nodes = quadratic.n_surface_nodes;
    mesh->surface_midpoints = midpoints_of(surface, quadratic);
    mesh->tets = quadratic.split();
    mesh->midpoints = {std::move(quadratic.triangles), std::move(quadratic.midpoints)};
    return mesh;
}

}  // namespace elastolab
