#include "bem/collocation/element.hpp"

namespace elastolab {

namespace {

class LinearElement final : public BoundaryElement {
public:
    CollocationPoints nodes(const Boundary& boundary) const override { return vertex_collocation_points(boundary); }
    Elements shape_functions(const Boundary& boundary) const override { return vertex_elements(boundary); }
    bool has_stiffness(Tractions tractions) const override { return tractions == Tractions::continuous; }

    BemConstraints constrain(const Boundary& boundary, const VertexTriangles& triangles_of_vertex, Tractions tractions,
                             std::span<const int> fixed, std::span<const int> handles) const override {
        const std::vector<int> vertices = joined(fixed, handles);
        return {constrain_vertices(vertices), linear_traction_space(boundary, triangles_of_vertex, tractions, vertices),
                static_cast<int>(fixed.size())};
    }

    std::shared_ptr<const SparseRows> display(const SurfaceMesh&, const VertexTriangles&) const override {
        return nullptr;
    }
};

}  // namespace

const BoundaryElement& linear_element() {
    static const LinearElement element;
    return element;
}

}  // namespace elastolab
