// What estimates of finite elements are made of: products without the matrix, and the second answers.
#include <gtest/gtest.h>

#include "fem/error_estimate.hpp"
#include "fem/fem_body.hpp"
#include "fem/load_vectors.hpp"
#include "fem/prescribed.hpp"
#include "fem/stiffness_product.hpp"
#include "mesh/tets/boundary.hpp"

namespace elastolab {
namespace {

using test::make_tet_box;
using test::relative_error;

constexpr double kPulledNu = 0.3;
const Material kPulledMaterial{1.0, kPulledNu};

TEST(StiffnessProduct, IsThatOfTheMatrix) {
    const QuadraticMesh mesh(make_tet_box({3, 2, 2}, {1.0, 2.0, 0.5}, 0.15));
    Control control;
    for (const double nu : {-0.4, 0.0, 0.49}) {
        const SparseMatrix K = stiffness(assemble_stiffness_parts(mesh, control), {2.0, nu});
        const StiffnessProduct product(mesh, {2.0, nu});
        const Eigen::VectorXd u = Eigen::VectorXd::Random(K.rows());
        EXPECT_LT(relative_error(product(u), K * u), 1e-13) << nu;
        const Eigen::Matrix3Xd diagonal = product.diagonal();
        for (int node = 0; node < mesh.n_nodes(); ++node) {
            const Eigen::Matrix3d block = K.block(3 * node, 3 * node, 3, 3);
            EXPECT_LT((diagonal.middleCols<3>(3 * node) - block).norm(), 1e-13 * block.norm()) << nu;
        }
    }
}

/// A box held at one end, pulled at the other and loaded above.
struct Pulled {
    TetMesh tets = make_tet_box({4, 2, 2}, {3.0, 1.0, 1.0}, 0.1);
    Triangles surface = boundary_triangles(tets);
    std::vector<int> ends;
    Eigen::VectorXd values;  ///< and the factor of the load
    std::vector<UnitLoad> loads;

    Pulled() {
        const SurfaceMesh mesh{tets.vertices.leftCols(tets.n_surface_vertices), surface};
        for (int v = 0; v < tets.n_surface_vertices; ++v)
            if (const double x = tets.vertices(0, v); x == 0.0 || x == 3.0) ends.push_back(v);
        values = Eigen::VectorXd::Zero(3 * std::ssize(ends) + 1);
        for (std::size_t i = 0; i < ends.size(); ++i)
            if (tets.vertices(0, ends[i]) == 3.0)
                values.segment<3>(3 * static_cast<Eigen::Index>(i)) << 0.02, -0.03 * tets.vertices(2, ends[i]), 0.05;
        std::vector<int> above;
        for (int t = 0; t < mesh.n_triangles(); ++t)
            if ((tets.vertices(2, Eigen::all)(surface.col(t)).array() == 1.0).all()) above.push_back(t);
        loads = {unit_force(mesh, above, {0, 1, 0}), body_force_along(2)};
        values.conservativeResize(values.size() + 1);
        values.tail<2>() << 0.02, -0.01;
    }
};

FemSystem system_on(FemMesh mesh) {
    SparseMatrix K = stiffness(mesh.parts, kPulledMaterial);
    mesh.analysis = std::make_unique<const CholeskyAnalysis>(K);
    return {std::make_shared<const FemMesh>(std::move(mesh)), std::move(K)};
}

struct PulledAnswer {
    Eigen::VectorXd displacements;  ///< of all nodes
    Eigen::Vector3d force;          ///< at x = 0
};

PulledAnswer pulled_answer(const FemSystem& system, std::span<const int> vertices, const Eigen::VectorXd& values,
                           const Eigen::VectorXd& given) {
    const ConstrainedFemNodes nodes = constrain_nodes(system.positions(), system.mesh->midpoints, {}, vertices);
    Control control;
    const PrescribedSolution solution = solve_prescribed(system.K, *system.mesh->analysis, nodes.prescribed.nodes,
                                                         nodes.prescribed.prescribe * values, control, given);
    PulledAnswer answer{solution.displacements, Eigen::Vector3d::Zero()};
    for (std::size_t i = 0; i < nodes.prescribed.nodes.size(); ++i)
        if (system.positions()(0, nodes.prescribed.nodes[i]) == 0.0)
            answer.force += solution.forces.block<3, 1>(3 * static_cast<Eigen::Index>(i), 0);
    return answer;
}

/// The second answer of quadratic elements is theirs on the tetrahedra with halved edges, solved by a factorisation
/// here, but for what the iterations leave: a few per cent of what it changes, and more of a total force, which it
/// changes by little.
TEST(HalvedReference, IsTheAnswerOnHalvedEdges) {
    const Pulled body;
    Control control;
    const FemSystem coarse = system_on(make_fem_mesh(body.tets, body.surface, ElementDegree::quadratic, control));
    const Eigen::VectorXd factors = body.values.tail<2>(), moved = body.values.head(body.values.size() - 2);
    const PulledAnswer first =
        pulled_answer(coarse, body.ends, moved, load_vectors(*coarse.mesh, body.loads) * factors);
    const ReferenceAnswer second =
        halved_reference(coarse, kPulledNu, body.ends, body.loads, body.values, first.displacements, nullptr, control)
            .value();

    TetMesh halved = coarse.mesh->tets;
    halved.n_surface_vertices = coarse.mesh->n_surface_nodes;
    const FemSystem fine =
        system_on(make_fem_mesh(halved, boundary_triangles(halved), ElementDegree::quadratic, control));
    const SurfaceMesh fine_surface{halved.vertices.leftCols(halved.n_surface_vertices), fine.mesh->surface};
    std::vector<int> above;
    for (int t = 0; t < fine_surface.n_triangles(); ++t)
        if ((halved.vertices(2, Eigen::all)(fine_surface.triangles.col(t)).array() == 1.0).all()) above.push_back(t);
    const std::vector<UnitLoad> loads = {unit_force(fine_surface, above, {0, 1, 0}), body_force_along(2)};
    const ConstrainedFemNodes nodes = constrain_nodes(coarse.positions(), coarse.mesh->midpoints, {}, body.ends);
    const PulledAnswer truth = pulled_answer(fine, nodes.prescribed.nodes, nodes.prescribed.prescribe * moved,
                                             load_vectors(*fine.mesh, loads) * factors);

    const Eigen::Index n = 3 * body.tets.n_surface_vertices;
    const Eigen::VectorXd change = truth.displacements.head(n) - first.displacements.head(n);
    EXPECT_GT(change.norm(), 1e-3 * first.displacements.head(n).norm());
    EXPECT_LT((second.displacements - truth.displacements.head(n)).norm(), 0.06 * change.norm());
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < body.ends.size(); ++i)
        if (body.tets.vertices(0, body.ends[i]) == 0.0)
            force += second.reactions.forces.col(static_cast<Eigen::Index>(i));
    EXPECT_GT((truth.force - first.force).norm(), 1e-3 * truth.force.norm());
    EXPECT_LT((force - truth.force).norm(), 0.8 * (truth.force - first.force).norm());
}

}  // namespace
}  // namespace elastolab
