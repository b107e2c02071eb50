#include <numeric>

#include "bem/collocation/constant_constraints.hpp"
#include "bem/collocation/element.hpp"

namespace elastolab {

namespace {

class ConstantElement final : public BoundaryElement {
public:
    CollocationPoints nodes(const Boundary& boundary) const override { return centroid_collocation_points(boundary); }

    Elements shape_functions(const Boundary& boundary) const override {
        std::vector<int> triangles(static_cast<std::size_t>(boundary.n_triangles()));
        std::iota(triangles.begin(), triangles.end(), 0);
        return constant_elements(triangles);
    }

    bool has_stiffness(Tractions) const override { return true; }

    BemConstraints constrain(const Boundary& boundary, const VertexTriangles& triangles_of_vertex, Tractions,
                             std::span<const int> fixed, std::span<const int> handles) const override {
        const std::vector<int> vertices = joined(fixed, handles);
        ConstrainedNodes nodes = constrain_triangles(boundary.mesh(), triangles_of_vertex, vertices);
        TractionSpace space = constant_traction_space(boundary, nodes.nodes, nodes.prescribe);
        // Triangles may have corners of the fixed set and of a handle; none of them counts as resting then.
        return {std::move(nodes), std::move(space), 0};
    }

    std::shared_ptr<const SparseRows> display(const SurfaceMesh& mesh,
                                              const VertexTriangles& triangles_of_vertex) const override {
        return std::make_shared<const SparseRows>(average_of_triangles(mesh, triangles_of_vertex));
    }
};

}  // namespace

const BoundaryElement& constant_element() {
    static const ConstantElement element;
    return element;
}

}  // namespace elastolab
