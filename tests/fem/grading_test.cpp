// Tetrahedra that grow towards the inside: what they cost in accuracy, and what they save.
#include <gtest/gtest.h>

#include <cstdio>

#include "elasticity/exact_fields.hpp"
#include "fem/assembly.hpp"
#include "fem/fem_body.hpp"
#include "fem/prescribed.hpp"
#include "mesh/primitives.hpp"
#include "mesh/tets/tetrahedralize.hpp"

namespace elastolab {
namespace {

struct Bent {
    int n_nodes = 0;
    double error = 0.0;  // rms over the surface, relative
};

/// A bar 4 times as long as thick, bent by its ends; its sides are free.
Bent bend(int cells, const TetOptions& options) {
    const Material material{.young_modulus = 1.0, .poisson_ratio = 0.3};
    const SurfaceMesh solid = make_box(cells, {4.0, 1.0, 1.0});
    Control control;
    const TetMesh mesh = tetrahedralize(solid, "bar", options, control);
    const SparseMatrix K = stiffness(assemble_stiffness_parts(mesh, control), material);
    const auto ends = test::vertices_where(mesh.vertices, mesh.n_surface_vertices,
                                           [](const Eigen::Vector3d& x) { return x[0] == 0.0 || x[0] == 4.0; });
    Positions exact(3, mesh.n_surface_vertices);
    for (int v = 0; v < mesh.n_surface_vertices; ++v)
        exact.col(v) = PureBending{material}.displacement(mesh.vertices.col(v) - Eigen::Vector3d(2.0, 0.5, 0.5));
    const Positions values = exact(Eigen::all, ends);
    const Eigen::VectorXd u =
        solve_prescribed(K, CholeskyAnalysis(K), ends, values.reshaped(), control).displacements.topRows(exact.size());
    return {mesh.n_vertices(), (u - exact.reshaped()).norm() / exact.norm()};
}

TEST(GradedTetrahedra, BendABarNearlyAsWellAsThoseOfTheSizeOfItsSurface) {
    for (const int cells : {4, 8}) {
        const Bent uniform = bend(cells, {.growth = 0.0}), graded = bend(cells, {.growth = 0.1}),
                   unbounded = bend(cells, {.relative_volume = 0.0});
        std::printf("[ measured ] %d cells: uniform %d nodes %.3g, graded %d %.3g, unbounded %d %.3g\n", cells,
                    uniform.n_nodes, uniform.error, graded.n_nodes, graded.error, unbounded.n_nodes, unbounded.error);
        EXPECT_LT(graded.error, 1.35 * uniform.error) << cells;
        EXPECT_LT(graded.n_nodes, 0.93 * uniform.n_nodes) << cells;
        EXPECT_GT(unbounded.error, 1.3 * graded.error) << cells;  // or the bound would be good for nothing
    }
}

}  // namespace
}  // namespace elastolab
