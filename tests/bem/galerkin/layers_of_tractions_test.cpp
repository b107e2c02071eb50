#include "bem/galerkin/layers_of_tractions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "bem/galerkin/given_loads.hpp"
#include "bem/galerkin/hierarchical_system.hpp"
#include "bem/galerkin/method.hpp"
#include "bem/galerkin/solvers.hpp"
#include "bem/galerkin/traction_rows.hpp"
#include "bem/hierarchical/cases.hpp"
#include "mesh/primitives.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

constexpr Material kMaterial{2.0, 0.3};
constexpr double kTolerance = 1e-9;

/// A bent bar, so that its clusters are far from each other but not along an axis.
SurfaceMesh bent_bar() {
    SurfaceMesh bar = make_box(2, {24.0, 1.0, 1.0});
    for (int v = 0; v < bar.n_vertices(); ++v)
        bar.vertices(2, v) += 0.02 * (bar.vertices(0, v) - 12.0) * (bar.vertices(0, v) - 12.0);
    return bar;
}

/// A straight one whose triangles grow from one end to the other, three hundred times as long.
SurfaceMesh graded_bar() {
    SurfaceMesh bar = make_box(2, {24.0, 1.0, 1.0});
    for (int v = 0; v < bar.n_vertices(); ++v) {
        const double along = bar.vertices(0, v) / 24.0;
        bar.vertices(0, v) = 24.0 * along * along * (0.05 + 0.95 * along);
        bar.vertices.col(v).tail<2>() *= 0.1 + along;
    }
    return bar;
}

struct LoadedBar {
    SurfaceMesh mesh = bent_bar();
    BoundaryPairs pairs{std::make_shared<const Boundary>(mesh), kTolerance};

    PiecewiseTractions tractions(int every) const {
        PiecewiseTractions given;
        for (int t = 0; t < mesh.n_triangles(); t += every) given.triangles.push_back(t);
        given.values.resize(3 * std::ssize(given.triangles), 2);
        for (std::size_t i = 0; i < given.triangles.size(); ++i) {
            const Eigen::Vector3d x = mesh.vertices.col(mesh.triangles(0, given.triangles[i]));
            const auto row = 3 * static_cast<Eigen::Index>(i);
            given.values.block<3, 1>(row, 0) = Eigen::Vector3d(1.0 + x[0] / 24.0, std::sin(x[0]), -0.5);
            given.values.block<3, 1>(row, 1) = Eigen::Vector3d(x[1], 0.3 * x[2], std::cos(x[0]));
        }
        return given;
    }
    TractionRows assembled(Control& control) const {
        std::vector<int> all(static_cast<std::size_t>(mesh.n_triangles()));
        std::iota(all.begin(), all.end(), 0);
        return assemble_traction_rows(pairs.boundary(), all, kMaterial, kTolerance, control);
    }
    /// K^T g at the vertices and V g on all triangles, by the assembled matrices.
    static Eigen::MatrixXd truth(const TractionRows& rows, const PiecewiseTractions& given) {
        Eigen::MatrixXd g = Eigen::MatrixXd::Zero(rows.single_layer.rows(), 2);
        for (std::size_t i = 0; i < given.triangles.size(); ++i)
            g.middleRows<3>(3 * given.triangles[i]) = given.values.middleRows<3>(3 * static_cast<Eigen::Index>(i));
        Eigen::MatrixXd layers(rows.double_layer.cols() + g.rows(), 2);
        layers << rows.double_layer.transpose() * g, rows.single_layer * g;
        return layers;
    }
};

TEST(LayersOfTractions, AreThoseOfTheAssembledMatricesToTheirTolerance) {
    const LoadedBar bar;
    Control control;
    const TractionRows rows = bar.assembled(control);
    for (const int every : {1, 3, 100}) {
        const PiecewiseTractions given = bar.tractions(every);
        const Eigen::MatrixXd truth = LoadedBar::truth(rows, given);
        const Eigen::Index n = 3 * bar.mesh.n_vertices(), n_tests = 3 * bar.mesh.n_triangles();
        for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
            const Eigen::MatrixXd layers =
                layers_of_tractions(bar.pairs, kMaterial, given, {bar.pairs.integrals(), tolerance}, control);
            EXPECT_LT(off(layers.topRows(n), truth.topRows(n)), tolerance) << every;
            EXPECT_LT(off(layers.bottomRows(n_tests), truth.bottomRows(n_tests)), tolerance) << every;
            if (every < 100 && tolerance > 1e-3) {
                EXPECT_GT(off(layers, truth), 1e-8) << "nothing is far, " << every;
            }
        }
    }
}

TEST(LayersOfTractions, KeepTheirToleranceWithLargeTrianglesAmongSmallOnes) {
    const LoadedBar bar{graded_bar()};
    Control control;
    const PiecewiseTractions given = bar.tractions(1);
    const Eigen::MatrixXd truth = LoadedBar::truth(bar.assembled(control), given);
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
        const Eigen::MatrixXd layers =
            layers_of_tractions(bar.pairs, kMaterial, given, {bar.pairs.integrals(), tolerance}, control);
        const Eigen::Index n = 3 * bar.mesh.n_vertices(), n_tests = 3 * bar.mesh.n_triangles();
        EXPECT_LT(off(layers.topRows(n), truth.topRows(n)), tolerance);
        EXPECT_LT(off(layers.bottomRows(n_tests), truth.bottomRows(n_tests)), tolerance);
    }
}

TEST(LayersOfTractions, AreTheSameWhereLoadsWaitForMemory) {
    const LoadedBar bar;
    Control control;
    const PiecewiseTractions given = bar.tractions(1);
    const auto layers = [&](std::size_t most_bytes) {
        return layers_of_tractions(bar.pairs, kMaterial, given, {bar.pairs.integrals(), 1e-4, most_bytes}, control);
    };
    EXPECT_LT(off(layers(1), layers(1u << 30)), 1e-13);
}

TEST(LayersOfTractions, AreZeroWithoutTractions) {
    const LoadedBar bar;
    Control control;
    const Eigen::MatrixXd layers =
        layers_of_tractions(bar.pairs, kMaterial, {{}, Eigen::MatrixXd(0, 2)}, {bar.pairs.integrals(), 1e-5}, control);
    EXPECT_EQ(layers, Eigen::MatrixXd::Zero(3 * (bar.mesh.n_vertices() + bar.mesh.n_triangles()), 2));
}

/// A body that is held at its foot and hangs under its weight: the same with dense and with hierarchical matrices,
/// whose layers of loads are less exact.
TEST(LayersOfTractions, OfLargeSurfacesLeaveTheAnswerAsItIs) {
    const OrganicBody body = make_rabbit(500);
    const std::vector<UnitLoad> loads = {body_force_along(0)};
    const Method method{.kind = kGalerkinBem, .update = Update::direct};
    StageTimes stages;
    Control control;
    const GalerkinSystem dense(std::make_shared<const Boundary>(body.surface), 0.3, method, nullptr, stages, control);
    const auto large = std::make_shared<const HierarchicalSystem>(body.surface, 0.3, method, stages, control);
    const GalerkinTractions tractions(body.surface, dense.surfaces(), body.fixed);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * std::ssize(body.fixed) + 1);
    values.tail<1>()[0] = 1.0;
    const NodeSolution exact =
        GalerkinDirectSolver(dense, dense.hypersingular(control), body.fixed, tractions, loads, control)
            .solve(values, true);
    const NodeSolution answer =
        HierarchicalSolver(large, body.fixed, tractions, loads, true, control).solve(values, true);
    EXPECT_LT(off(answer.displacements, exact.displacements), 1e-6);
    EXPECT_LT(off(answer.loads, exact.loads), 1e-4);
    const Eigen::MatrixXd far = large->given_nodal_forces(loads, control),
                          all = dense.given_nodal_forces(loads, control);
    EXPECT_LT(off(far, all), large->options().tolerance);
    EXPECT_GT(off(far, all), 1e-9) << "nothing was far";
}

}  // namespace
}  // namespace elastolab::test
