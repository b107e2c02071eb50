#pragma once

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <thread>

#include "base/control.hpp"
#include "bem/collocation/method.hpp"
#include "deform/solid_model.hpp"

namespace elastolab::test {

/// Who computed with the slow method.
struct SlowCalls {
    std::atomic<std::thread::id> watcher{};
    std::atomic<int> by_watcher{0}, by_others{0};

    void restart() {
        watcher = std::this_thread::get_id();
        by_watcher = by_others = 0;
    }
    void count() { ++(std::this_thread::get_id() == watcher.load() ? by_watcher : by_others); }
};
inline SlowCalls slow_calls;

/// Counts its caller, and takes its time; longer than a frame may.
inline void take_long() {
    slow_calls.count();
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
}

/// Moves every vertex by the mean of what is prescribed, and resists every prescribed vertex as a spring does.
class SlowSolver : public NodeSolver {
public:
    SlowSolver(int n_vertices, bool iterates) : n_vertices_(n_vertices), iterates_(iterates) {}
    NodeSolution solve(const Eigen::MatrixXd& prescribed, bool want_loads) const override {
        take_long();
        const Eigen::Index n = prescribed.rows() / 3, m = prescribed.cols();
        NodeSolution solution{
            .displacements = Eigen::MatrixXd::Zero(3 * n_vertices_, m), .loads = {}, .prescribed = {}};
        for (Eigen::Index row = 0; row < 3 * n_vertices_; ++row)
            for (Eigen::Index i = 0; i < n; ++i)
                solution.displacements.row(row) += prescribed.row(3 * i + row % 3) / static_cast<double>(n);
        if (want_loads) solution.loads = prescribed;
        return solution;
    }
    bool iterates() const override { return iterates_; }

private:
    Eigen::Index n_vertices_;
    bool iterates_;
};

/// Everything that is asked of it takes long.
class SlowModel : public SolidModel {
public:
    SlowModel(const SurfaceMesh& surface, bool iterates) : vertices_(surface.vertices), iterates_(iterates) {
        take_long();
        facts_.n_vertices = surface.n_vertices();
        facts_.n_triangles = surface.n_triangles();
    }
    std::unique_ptr<ConstrainedSolid> constrain(std::span<const int> fixed, std::span<const int> handles,
                                                std::span<const UnitLoad>, Control& control) const override {
        take_long();
        control.checkpoint();
        SolutionChecks checks;
        checks.residual = [](const NodeSolution&, Control&) { return 0.0; };
        return std::make_unique<ConstrainedSolid>(facts_.n_vertices, constrain_vertices(joined(fixed, handles)),
                                                  nodal_shares(vertices_, joined(fixed, handles)), nullptr,
                                                  std::make_unique<SlowSolver>(facts_.n_vertices, iterates_),
                                                  std::move(checks));
    }
    std::uint64_t constrain_memory(std::span<const int>, std::span<const int>) const override {
        take_long();
        return 1000;
    }
    std::uint64_t check_memory(std::span<const int>, std::span<const int>) const override {
        take_long();
        return 100;
    }
    void visit_matrices(const std::function<void(const NamedMatrix&)>&) const override {}

private:
    Positions vertices_;
    bool iterates_;
};

template <bool iterates>
Method slow_method() {
    static const MethodTraits traits = [] {
        MethodTraits its = kLinearBemTraits;
        its.precompute = [](const SurfaceMesh& surface, const std::string&, double, const Method&, const SolidModel*,
                            Control&) -> std::shared_ptr<const SolidModel> {
            return std::make_shared<SlowModel>(surface, iterates);
        };
        return its;
    }();
    return {.kind = &traits};
}

}  // namespace elastolab::test
