#include "bem/galerkin/residual.hpp"

#include <gtest/gtest.h>

#include <unistd.h>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "bem/galerkin/method.hpp"
#include "bem/galerkin/solvers.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"

namespace elastolab::test {
namespace {

/// A box stretched between two faces, and its Galerkin equations.
struct StretchedBox {
    explicit StretchedBox(int cells) : mesh(make_box(cells)) {
        ends = vertices_where(mesh, [](const auto& x) { return x[0] < kEdge || x[0] > 1.0 - kEdge; });
        tractions = GalerkinTractions(mesh, surfaces, ends);
    }
    NodeSolution solved() {
        StageTimes stages;
        const GalerkinSystem system(std::make_shared<const Boundary>(mesh), material.poisson_ratio,
                                    Method{.kind = kGalerkinBem, .update = Update::direct}, nullptr, stages, control);
        Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * std::ssize(ends));
        for (std::size_t i = 0; i < ends.size(); ++i)
            values[3 * static_cast<Eigen::Index>(i)] = mesh.vertices(0, ends[i]);
        return GalerkinDirectSolver(system, system.hypersingular(control), ends, tractions, {}, control)
            .solve(values, true);
    }
    double residual(const NodeSolution& solution) {
        const auto pairs = std::make_shared<const BoundaryPairs>(std::make_shared<const Boundary>(mesh), 1e-8);
        return galerkin_residual({pairs, pairs->cluster_vertices(kVerticesOfALeaf), surfaces, material}, ends,
                                 tractions, {}, solution, control);
    }

    Control control;
    Material material{1.0, 0.3};
    SurfaceMesh mesh;
    ClosedSurfaces surfaces{mesh};
    std::vector<int> ends;
    GalerkinTractions tractions;
};

TEST(GalerkinResidual, IsLargeForAWrongSolution) {
    StretchedBox box(6);  // more vertices and constrained triangles than are sampled
    const NodeSolution right = box.solved();
    EXPECT_LT(box.residual(right), 1e-9);
    NodeSolution wrong = right;
    wrong.displacements *= 1.01;
    EXPECT_GT(box.residual(wrong), 1e-4);
    wrong = right;
    wrong.loads *= 1.01;
    EXPECT_GT(box.residual(wrong), 1e-4);
    wrong = right;
    wrong.displacements(0) += 0.1;
    EXPECT_GT(box.residual(wrong), 1e-5);
    wrong = right;
    wrong.loads(wrong.loads.size() - 3) += 0.1;
    EXPECT_GT(box.residual(wrong), 1e-5);
}

/// That of this process alone; getrusage's would be its parent's too.
std::uint64_t peak_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string key; status >> key;)
        if (key == "VmHWM:") {
            std::uint64_t kib = 0;
            status >> kib;
            return 1024 * kib;
        }
    return 0;
}

/// D alone has 270 MB. In a process of its own, whose peak nothing else has raised.
void check_the_peak_of_a_large_box() {
    StretchedBox small(2), box(18);
    small.residual(small.solved());  // libraries have what they keep
    NodeSolution solution;
    solution.displacements = Eigen::VectorXd::Ones(3 * box.mesh.n_vertices());
    solution.loads = Eigen::VectorXd::Ones(3 * std::ssize(box.ends) + box.tractions.size());
    const std::uint64_t predicted = galerkin_residual_memory(box.mesh, std::ssize(box.tractions.triangles));
    const std::uint64_t before = peak_bytes();
    const double residual = box.residual(solution);
    const std::uint64_t taken = peak_bytes() - before;
    std::fprintf(stderr, "predicted %g MB, taken %g MB, residual %g\n", 1e-6 * static_cast<double>(predicted),
                 1e-6 * static_cast<double>(taken), residual);
    _exit(taken < predicted + (16u << 20) && predicted < 4 * taken + (16u << 20) && residual > 1e-3 ? 0 : 1);
}

TEST(GalerkinResidual, TakesThePredictedMemory) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(check_the_peak_of_a_large_box(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace elastolab::test
