// Betti's theorem at the nodes of finite elements: the work of the reactions to a load, in a motion of the handles, is
// minus that of the load in what the motion causes (docs/formulation.md section 13). The work of a load is integrated
// here, by quadrature of the elements' own displacements.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/assembly.hpp"
#include "fem/load_vectors.hpp"
#include "fem/nonlinear/bodies.hpp"
#include "fem/nonlinear/solver.hpp"
#include "fem/solvers.hpp"
#include "mesh/measures.hpp"

namespace elastolab {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// A bar, held at x = 0 and moved at x = 2; on the rest of its surface a pressure, a force and its weight.
struct LoadedBar {
    explicit LoadedBar(ElementDegree degree) {
        Control control;
        const TetMesh tets = test::make_tet_box({4, 2, 2}, {2.0, 1.0, 0.8}, 0.1);
        surface = test::boundary(tets);
        mesh = std::make_shared<FemMesh>(make_fem_mesh(tets, surface.triangles, degree, control));
        mesh->analysis = std::make_unique<CholeskyAnalysis>(mesh->parts.mu);
        const auto nodes_at = [&](double x) {
            return test::vertices_where(mesh->tets.vertices, mesh->n_surface_nodes,
                                        [=](const Vector3d& p) { return p[0] == x; });
        };
        fixed = nodes_at(0.0);
        moved = nodes_at(2.0);
        const auto side = [&](int axis, double at) {
            std::vector<int> found;
            for (int t = 0; t < surface.n_triangles(); ++t)
                if ((surface.vertices(axis, surface.triangles.col(t)).array() == at).all()) found.push_back(t);
            return found;
        };
        loads = {unit_pressure(surface, side(2, 0.8)), unit_force(surface, side(1, 0.0), {0.3, -1.0, 0.5}),
                 body_force_along(1)};
    }
    std::vector<int> nodes() const {
        std::vector<int> all = fixed;
        all.insert(all.end(), moved.begin(), moved.end());
        return all;
    }
    Vector3d at(const VectorXd& u, int node) const { return u.segment<3>(3 * node); }

    /// int g . u over the loaded triangles, by the three points of degree 2.
    double surface_work(const UnitLoad& load, const VectorXd& u) const {
        double work = 0.0;
        for (std::size_t k = 0; k < load.triangles.size(); ++k) {
            const int t = load.triangles[k];
            const double area = 0.5 * area_vector(triangle_points(surface, t)).norm();
            for (int point = 0; point < 3; ++point) {
                Vector3d L = Vector3d::Constant(1.0 / 6.0), there = Vector3d::Zero();
                L[point] = 2.0 / 3.0;
                for (int a = 0; a < 3; ++a) {
                    const bool ten = mesh->degree() == ElementDegree::quadratic;
                    there += (ten ? L[a] * (2.0 * L[a] - 1.0) : L[a]) * at(u, surface.triangles(a, t));
                    if (ten) there += 4.0 * L[a] * L[(a + 1) % 3] * at(u, mesh->surface_midpoints(a, t));
                }
                work += area / 3.0 * load.tractions.col(static_cast<Eigen::Index>(k)).dot(there);
            }
        }
        return work;
    }
    /// int b . u, by the four points of degree 2.
    double volume_work(const UnitLoad& load, const VectorXd& u) const {
        const Eigen::MatrixXi elements = mesh->elements();
        double work = 0.0;
        for (const auto& element : elements.colwise()) {
            Eigen::Matrix3d edges;
            for (int i = 0; i < 3; ++i)
                edges.col(i) = mesh->tets.vertices.col(element[i + 1]) - mesh->tets.vertices.col(element[0]);
            for (int point = 0; point < 4; ++point) {
                Eigen::Vector4d L = Eigen::Vector4d::Constant((5.0 - std::sqrt(5.0)) / 20.0);
                L[point] = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
                Vector3d there = Vector3d::Zero();
                const VectorXd shapes = elements.rows() == 10 ? VectorXd(quadratic_shapes(L)) : VectorXd(L);
                for (Eigen::Index a = 0; a < elements.rows(); ++a) there += shapes[a] * at(u, element[a]);
                work += edges.determinant() / 24.0 * load.body_force.dot(there);
            }
        }
        return work;
    }
    double work(const UnitLoad& load, const VectorXd& u) const {
        return load.is_body_force() ? volume_work(load, u) : surface_work(load, u);
    }
    /// Values of the nodes and the loads' factors, of which one group is not zero: a motion that turns and stretches.
    VectorXd motion() const {
        VectorXd values = VectorXd::Zero(3 * std::ssize(nodes()) + std::ssize(loads));
        for (std::size_t k = 0; k < moved.size(); ++k) {
            const Vector3d& p = mesh->tets.vertices.col(moved[k]);
            values.segment<3>(3 * static_cast<Eigen::Index>(fixed.size() + k)) =
                Vector3d(0.1, -0.2, 0.15) + Vector3d(0.3, 0.1, -0.2).cross(p - Vector3d(2.0, 0.5, 0.4));
        }
        return values;
    }
    VectorXd factor(std::size_t load) const {
        VectorXd values = VectorXd::Zero(3 * std::ssize(nodes()) + std::ssize(loads));
        values[3 * std::ssize(nodes()) + static_cast<Eigen::Index>(load)] = 1.0;
        return values;
    }

    SurfaceMesh surface;
    std::shared_ptr<FemMesh> mesh;
    std::vector<int> fixed, moved;
    std::vector<UnitLoad> loads;
};

class ReciprocityOfDegree : public testing::TestWithParam<ElementDegree> {};
INSTANTIATE_TEST_SUITE_P(LoadReciprocity, ReciprocityOfDegree,
                         testing::Values(ElementDegree::linear, ElementDegree::quadratic), [](const auto& degree) {
                             return degree.param == ElementDegree::linear ? "FourNodes" : "TenNodes";
                         });

TEST_P(ReciprocityOfDegree, OfLoadsAndHandlesToRounding) {
    const LoadedBar bar(GetParam());
    Control control;
    const auto system =
        std::make_shared<FemSystem>(FemSystem{bar.mesh, stiffness(bar.mesh->parts, Material{1.0, 0.3})});
    const SparseDirectSolver solver(system, bar.nodes(), load_vectors(*bar.mesh, bar.loads), control);
    const VectorXd motion = bar.motion();
    const VectorXd caused = solver.solve(motion, false).displacements.col(0);
    for (std::size_t k = 0; k < bar.loads.size(); ++k) {
        const NodeSolution loaded = solver.solve(bar.factor(k), true);
        const double work = bar.work(bar.loads[k], caused);
        EXPECT_GT(std::abs(work), 1e-3);
        EXPECT_NEAR(loaded.loads.col(0).dot(motion.head(loaded.loads.rows())), -work, 1e-11 * std::abs(work)) << k;
        for (std::size_t other = 0; other < k; ++other) {
            const double mutual = bar.work(bar.loads[other], loaded.displacements.col(0));
            EXPECT_NEAR(bar.work(bar.loads[k], solver.solve(bar.factor(other), false).displacements.col(0)), mutual,
                        1e-11 * std::abs(mutual));
        }
    }
}

/// About an equilibrium far from rest: how the reactions change with a dead load, and the displacements with a motion.
TEST_P(ReciprocityOfDegree, OfSmallChangesOfABarThatIsBentFar) {
    LoadedBar bar(GetParam());
    bar.loads.erase(bar.loads.begin());  // a pressure follows the surface: where its rim is free it has no energy
    Control control;
    const auto elements = std::make_shared<FiniteElements>(bar.mesh->tets.vertices, bar.mesh->elements());
    const NonlinearSolver solver(elements, {1.0, 0.3}, {bar.nodes(), static_cast<int>(bar.fixed.size()), true}, control,
                                 {elements, bar.surface.triangles, bar.mesh->surface_midpoints, bar.loads});
    const VectorXd motion = bar.motion();
    Eigen::MatrixXd changes(motion.size(), 3);
    changes << motion, bar.factor(0), bar.factor(1);
    const NodeSolution answer =
        solver.solve_task({.prescribed = 3.0 * motion + 0.02 * bar.factor(0) + 0.03 * bar.factor(1),
                           .changes = changes,
                           .want_loads = true},
                          1e-12, control);
    ASSERT_GT(answer.displacements.col(0).cwiseAbs().maxCoeff(), 0.5) << "a large deformation";
    const VectorXd caused = answer.displacements.col(1);
    for (std::size_t k = 0; k < bar.loads.size(); ++k) {
        const double work = bar.work(bar.loads[k], caused);
        const VectorXd reactions = answer.loads.col(2 + static_cast<Eigen::Index>(k));
        EXPECT_NEAR(reactions.dot(motion.head(reactions.size())), -work, 1e-9 * std::abs(work)) << k;
    }
}

}  // namespace
}  // namespace elastolab
