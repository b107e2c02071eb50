// Betti's theorem in the equations of Galerkin BEM (docs/formulation.md section 13).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bem/galerkin/method.hpp"
#include "bem/galerkin/solvers.hpp"
#include "bem/given_loads.hpp"
#include "mesh/measures.hpp"
#include "methods/problem.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

/// A load g on a body that is fixed and held at a patch, and a motion of the patch without the load.
struct LoadAndMotion {
    explicit LoadAndMotion(int n_vertices) : body(make_rabbit(n_vertices)), vertices(body.fixed) {
        vertices.insert(vertices.end(), body.pull.begin(), body.pull.end());
        std::vector<char> is_constrained(static_cast<std::size_t>(body.surface.n_vertices()), 0);
        for (const int v : vertices) is_constrained[static_cast<std::size_t>(v)] = 1;
        std::vector<int> pressed;
        for (int t = 0; t < body.surface.n_triangles(); ++t) {
            const auto corners = body.surface.triangles.col(t);
            const auto is_free = [&](int v) { return is_constrained[static_cast<std::size_t>(v)] == 0; };
            if (std::all_of(corners.begin(), corners.end(), is_free) && body.surface.vertices(0, corners[0]) < 0.0)
                pressed.push_back(t);
        }
        load = {unit_pressure(body.surface, pressed)};
        tractions = GalerkinTractions(body.surface, surfaces, vertices);
        const GalerkinDirectSolver solver(system, system.hypersingular(control), vertices, tractions, load, control);
        Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(3 * std::ssize(vertices) + 1);
        prescribed.segment(3 * std::ssize(body.fixed), 3 * std::ssize(body.pull)) =
            Eigen::Vector3d(0.3, -0.1, 0.2).replicate(std::ssize(body.pull), 1);
        motion = prescribed.head(3 * std::ssize(vertices));
        moved = solver.solve(prescribed, true);
        prescribed.setZero();
        prescribed[3 * std::ssize(vertices)] = 1.0;
        loaded = solver.solve(prescribed, true);
    }
    /// Of the load's reactions, in the motion.
    double work_of_reactions() const { return motion.dot(loaded.loads.col(0).head(motion.size())); }
    /// Of the load in what the motion causes, as the equations have it: v^T (B - H)^T g + s^T G g.
    double work_in_equations() {
        const Eigen::VectorXd s = moved.loads.col(0).tail(tractions.size());
        return moved.displacements.col(0).dot(system.given_nodal_forces(load, control).col(0)) +
               s.dot(system.given_single_layer(tractions, load, control).col(0));
    }
    /// The same, int g . v.
    double work_on_surface() const {
        double work = 0.0;
        for (std::size_t k = 0; k < load[0].triangles.size(); ++k) {
            const double area = 0.5 * area_vector(triangle_points(body.surface, load[0].triangles[k])).norm();
            for (const int v : body.surface.triangles.col(load[0].triangles[k]))
                work += area / 3.0 *
                        load[0]
                            .tractions.col(static_cast<Eigen::Index>(k))
                            .dot(moved.displacements.col(0).segment<3>(3 * v));
        }
        return work;
    }

    Control control;
    OrganicBody body;
    std::vector<int> vertices;
    std::vector<UnitLoad> load;
    StageTimes stages;
    GalerkinSystem system{std::make_shared<const Boundary>(body.surface),
                          0.3,
                          Method{.kind = kGalerkinBem, .update = Update::direct},
                          nullptr,
                          stages,
                          control};
    ClosedSurfaces surfaces{body.surface};
    GalerkinTractions tractions;
    Eigen::VectorXd motion;
    NodeSolution moved, loaded;
};

TEST(GalerkinLoads, AreReciprocalWithMotionsInTheEquations) {
    LoadAndMotion problem(200);
    const double work = problem.work_in_equations();
    EXPECT_NEAR(problem.work_of_reactions(), -work, 1e-9 * std::abs(work));
}

TEST(GalerkinLoads, AreIntegratedOnce) {
    LoadAndMotion problem(100);
    const Eigen::MatrixXd first = problem.system.given_nodal_forces(problem.load, problem.control);
    Control no_time;
    no_time.cancel();  // any integration would be given up
    EXPECT_TRUE(problem.system.given_nodal_forces(problem.load, no_time) == first);
    EXPECT_GT(problem.system.given_single_layer(problem.tractions, problem.load, no_time).norm(), 0.0);
    EXPECT_THROW(problem.system.given_nodal_forces(std::vector{body_force_along(0)}, no_time), Cancelled);
}

/// K^T g and V g of loads on some triangles and of a body force, against products with the assembled layers of all
/// triangles.
TEST(GalerkinLoads, AreTheProductsOfTheAssembledLayers) {
    LoadAndMotion problem(100);
    const SurfaceMesh& surface = problem.body.surface;
    GalerkinTractions all;
    for (int t = 0; t < surface.n_triangles(); ++t) all.triangles.push_back(t);
    const GalerkinOperators operators = problem.system.operators(all, problem.control);
    const std::vector<UnitLoad> loads = {problem.load[0], unit_pressure(surface, {3, 40}), body_force_along(2)};
    const Eigen::MatrixXd forces = problem.system.given_nodal_forces(loads, problem.control);
    const Eigen::MatrixXd single = problem.system.given_single_layer(all, loads, problem.control);
    const BodyForceField weight(surface, 0.3);
    for (std::size_t l = 0; l < loads.size(); ++l) {
        Eigen::VectorXd g = Eigen::VectorXd::Zero(all.size()), on_vertices = Eigen::VectorXd::Zero(forces.rows());
        for (std::size_t k = 0; k < loads[l].triangles.size(); ++k) {
            const int t = loads[l].triangles[k];
            g.segment<3>(3 * t) = loads[l].tractions.col(static_cast<Eigen::Index>(k));
            const double third = area_vector(triangle_points(surface, t)).norm() / 6.0;
            for (const int v : surface.triangles.col(t)) on_vertices.segment<3>(3 * v) += third * g.segment<3>(3 * t);
        }
        for (int t = 0; loads[l].is_body_force() && t < surface.n_triangles(); ++t) {
            const Eigen::Vector3d vector_area = area_vector(triangle_points(surface, t)) / 2.0;
            const auto potential = [&](const Eigen::Vector3d& at) { return weight.potential(at, loads[l].body_force); };
            const Eigen::Matrix3d corners = surface.vertices(Eigen::all, surface.triangles.col(t));
            const double mean = potential(corners.rowwise().mean());
            g.segment<3>(3 * t) = mean * vector_area.normalized();
            for (int a = 0; a < 3; ++a)  // int phi_a (b . x) n: a quarter of its corner's value, three of the mean
                on_vertices.segment<3>(3 * surface.triangles(a, t)) +=
                    (potential(corners.col(a)) / 12.0 + mean / 4.0) * vector_area;
        }
        const auto column = static_cast<Eigen::Index>(l);
        on_vertices -= operators.double_layer.transpose() * g;
        EXPECT_LT((forces.col(column) - on_vertices).norm(), 1e-8 * on_vertices.norm());
        const Eigen::VectorXd on_triangles = operators.single_layer * g;
        EXPECT_LT((single.col(column) - on_triangles).norm(), 1e-8 * on_triangles.norm());
    }
}

/// H v = G s is asked on constrained triangles only; elsewhere it holds to the error of the discretisation.
TEST(GalerkinLoads, WorkOnTheSurfaceIsThatOfTheEquationsButForTheDiscretisation) {
    const auto off = [](int n_vertices) {
        LoadAndMotion problem(n_vertices);
        return std::abs(problem.work_on_surface() / problem.work_in_equations() - 1.0);
    };
    const double coarse = off(200), fine = off(800);
    EXPECT_LT(coarse, 1e-2);
    EXPECT_LT(fine, 0.5 * coarse);
}

}  // namespace
}  // namespace elastolab::test
