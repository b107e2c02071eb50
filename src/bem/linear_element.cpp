#include "bem/element.hpp"
#include "bem/error_estimate.hpp"
#include "bem/responses.hpp"
#include "deform/reduced_solver.hpp"

namespace elastolab {

namespace {

class LinearElement final : public BoundaryElement {
public:
    Sources nodes(const Boundary& boundary) const override { return vertex_sources(boundary); }
    Elements shape_functions(const Boundary& boundary) const override { return vertex_elements(boundary); }
    bool has_stiffness(Tractions tractions) const override { return tractions == Tractions::continuous; }

    BemConstraints constrain(const Boundary& boundary, const VertexTriangles& triangles_of_vertex, Tractions tractions,
                             std::span<const int> base, std::span<const int> handles) const override {
        std::vector<int> vertices(base.begin(), base.end());
        vertices.insert(vertices.end(), handles.begin(), handles.end());
        return {constrain_vertices(vertices), linear_traction_space(boundary, triangles_of_vertex, tractions, vertices),
                static_cast<int>(base.size())};
    }

    std::shared_ptr<const SparseRows> display(const SurfaceMesh&, const VertexTriangles&) const override {
        return nullptr;
    }

    /// What an averaged (Galerkin) instead of a collocated equation would add.
    Eigen::VectorXd error(const std::shared_ptr<const BemSystem>& system, const SparseRows*, const TractionSpace& space,
                          const std::vector<int>& nodes, const NodeSolver& solver, const NodeSolution& solution,
                          Control& control) const override {
        const Eigen::VectorXd residual = -residual_between_nodes(*system, space, solution, control);
        Eigen::VectorXd error = solver.response_to_residual(residual, control);
        if (error.size() > 0) return error;
        return ReducedSolver(reduced_system(system, space, nodes, control), control)  // Eqns. 7 and 9 on K
            .response_to_residual(residual, control);
    }
};

}  // namespace

const BoundaryElement& linear_element() {
    static const LinearElement element;
    return element;
}

}  // namespace elastolab
