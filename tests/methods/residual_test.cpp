#include <gtest/gtest.h>

#include <cmath>

#include "bem/collocation/method.hpp"
#include "bem/collocation/mixed_solver.hpp"
#include "elasticity/exact_fields.hpp"
#include "fem/assembly.hpp"
#include "fem/method.hpp"
#include "fem/solvers.hpp"
#include "mesh/primitives.hpp"
#include "mesh/tets/tetrahedralize.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

/// A stretched cube by boundary elements, from the equations that the residual is about.
struct StretchedCube {
    explicit StretchedCube(const Method& method)
        : mesh(make_box(5)),
          left_and_right(vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9 || x[0] > 1.0 - 1e-9; })),
          element(method.kind == kConstantBem ? constant_element() : linear_element()),
          system(element, std::make_shared<const Boundary>(mesh), 0.3, method, BemSystem::Storage::dense, stages,
                 control),
          constraints(
              element.constrain(system.boundary(), system.triangles_of_vertex(), method.tractions, {}, left_and_right)),
          nodes(constraints.nodes),
          space(constraints.space) {
        Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * std::ssize(left_and_right));
        for (std::size_t i = 0; i < left_and_right.size(); ++i)
            values[3 * static_cast<Eigen::Index>(i)] = mesh.vertices(0, left_and_right[i]);
        solution = MixedSolver(system, space, nodes.nodes, 0, {}, control).solve(nodes.prescribe * values, true);
    }
    double residual() { return boundary_residual(system, space, {}, solution, control); }

    Control control;
    StageTimes stages;
    SurfaceMesh mesh;
    std::vector<int> left_and_right;
    const BoundaryElement& element;
    BemSystem system;
    BemConstraints constraints;
    ConstrainedNodes& nodes;
    TractionSpace& space;
    NodeSolution solution;
};

std::vector<Method> boundary_methods() {
    std::vector<Method> methods = method_variants(Mode::on_demand, Update::direct);
    std::erase_if(methods,
                  [](const Method& method) { return method.kind != kConstantBem && method.kind != kLinearBem; });
    return methods;
}

TEST(Residual, IsLargeForAWrongSolutionOfTheBoundaryEquation) {
    for (const Method& method : boundary_methods()) {
        StretchedCube cube(method);
        EXPECT_LT(cube.residual(), 1e-13) << describe(method);
        const NodeSolution right = cube.solution;
        cube.solution.displacements *= 1.01;  // all a percent too large
        EXPECT_GT(cube.residual(), 1e-4) << describe(method);
        cube.solution = right;
        cube.solution.loads *= 1.01;
        EXPECT_GT(cube.residual(), 1e-4) << describe(method);
        cube.solution = right;
        cube.solution.displacements(0) += 0.1;  // one number of one node
        EXPECT_GT(cube.residual(), 1e-5) << describe(method);
        cube.solution = right;
        cube.solution.loads(cube.solution.loads.size() - 1) *= -1.0;
        cube.solution.loads(cube.solution.loads.size() - 3) += 0.1;
        EXPECT_GT(cube.residual(), 1e-5) << describe(method);
    }
}

TEST(Residual, IsLargeForAWrongSolutionOfTheStiffness) {
    Control control;
    const TetMesh tets = tetrahedralize(make_box(4), "cube", {}, control);
    const SparseMatrix K = stiffness(assemble_stiffness_parts(tets, control), Material{1.0, 0.3});
    std::vector<int> surface(static_cast<std::size_t>(tets.n_surface_vertices));
    for (int v = 0; v < tets.n_surface_vertices; ++v) surface[static_cast<std::size_t>(v)] = v;
    Eigen::VectorXd u(K.rows());  // a uniaxial stretch, which linear tetrahedra reproduce
    for (int v = 0; v < tets.n_vertices(); ++v)
        u.segment<3>(3 * v) = UniaxialStretch{{1.0, 0.3}}.displacement(tets.vertices.col(v));
    Eigen::VectorXd forces = nodal_forces(K, u, surface);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(u.size());
    EXPECT_LT(stiffness_residual(K, u, surface, forces, none), 1e-14);
    EXPECT_GT(stiffness_residual(K, 1.01 * u, surface, forces, none), 1e-4);
    u[0] += 0.1;
    EXPECT_GT(stiffness_residual(K, u, surface, forces, none), 1e-3);
}

/// Forces at the vertices that a field of tractions exerts on a triangulated sphere: int psi t dS, t interpolated.
template <class Field>
Eigen::Matrix3Xd exact_forces(const SurfaceMesh& mesh, const Field& field) {
    Eigen::Matrix3Xd traction(3, mesh.n_vertices()), forces = Eigen::Matrix3Xd::Zero(3, mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v)
        traction.col(v) = field.stress(mesh.vertices.col(v)) * mesh.vertices.col(v).normalized();
    const Boundary boundary(mesh);
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Eigen::Vector3i corners = mesh.triangles.col(t);
        const Eigen::Vector3d sum = traction(Eigen::all, corners).rowwise().sum();
        for (const int v : corners) forces.col(v) += boundary.area(t) / 12.0 * (sum + traction.col(v));
    }
    return forces;
}

/// A sphere whose whole surface is displaced as a point force outside would: the tractions are the unknowns. They are
/// derivatives of displacements known to the second order (the faces lie that much inside the sphere): an order of one.
TEST(Tractions, OfAPointForceOutsideConvergeToTheExactOnes) {
    const Material material{1.0, 0.3};
    const PointForceField field{material, {1.8, 0.4, 0.6}, {1.0, 0.5, -0.2}};
    for (const auto& [kind, order] : {std::pair{kLinearBem, 1.0}, {kConstantBem, 1.0}, {kFem, 1.0}}) {
        std::vector<double> errors;
        for (const int cells : {4, 8}) {
            const SurfaceMesh mesh = make_sphere(cells);
            std::vector<int> all = vertices_where(mesh, [](const auto&) { return true; });
            Control control;
            Deformer deformer(precomputed(make_body(mesh, material), make_method(kind)));
            deformer.constrain({{}, all}, control);
            const Eigen::Matrix3Xd exact = exact_forces(mesh, field);
            const Eigen::Matrix3Xd forces = deformer.reactions(exact_displacements(mesh, field)).forces;
            errors.push_back((forces - exact).norm() / exact.norm());
        }
        const double observed = std::log2(errors[0] / errors[1]);
        print_measured("tractions of a point force, " + std::string(name(kind)) + ", relative error", errors[1]);
        print_measured("tractions of a point force, " + std::string(name(kind)) + ", observed order", observed);
        EXPECT_GT(observed, order) << name(kind);
    }
}

}  // namespace
}  // namespace elastolab::test
