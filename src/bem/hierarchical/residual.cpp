#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "bem/given_loads.hpp"
#include "bem/hierarchical/system.hpp"

namespace elastolab {

namespace {

constexpr int kSampleVertices = 128, kSampleTriangles = 64;

/// What is off in some equations, and the size of their terms.
struct EquationBalance {
    Eigen::VectorXd off, size;
    explicit EquationBalance(int n) : off(Eigen::VectorXd::Zero(3 * n)), size(Eigen::VectorXd::Zero(3 * n)) {}
    void add(int i, const Eigen::MatrixXd& row, const Eigen::VectorXd& x, double sign) {
        off.segment<3>(3 * i) += sign * (row * x);
        size.segment<3>(3 * i) += row.cwiseAbs() * x.cwiseAbs();
    }
    double relative() const { return size.norm() > 0.0 ? off.norm() / size.norm() : 0.0; }
};

/// Evenly spread numbers below n.
int sample(int i, int n_samples, int n) { return static_cast<int>(static_cast<std::int64_t>(i) * n / n_samples); }

}  // namespace

double hierarchical_residual(const HierarchicalSystem& system, const std::vector<int>& vertices,
                             const GalerkinTractions& tractions, std::span<const UnitLoad> loads,
                             const NodeSolution& solution, Control& control) {
    const ClusterTree& tree = *system.tree();
    const int n = tree.size(), n_triangles = static_cast<int>(tractions.triangles.size());
    Eigen::VectorXd reactions = Eigen::VectorXd::Zero(system.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        reactions.segment<3>(3 * vertices[i]) = solution.loads.col(0).segment<3>(3 * static_cast<Eigen::Index>(i));
    const Eigen::VectorXd u = to_tree_order(tree, solution.displacements), R = to_tree_order(tree, reactions);
    // Every triangle that carries a traction, and that traction.
    std::vector<int> triangles = tractions.triangles;
    std::vector<double> values(solution.loads.col(0).data() + 3 * std::ssize(vertices),
                               solution.loads.col(0).data() + 3 * std::ssize(vertices) + 3 * n_triangles);
    Eigen::Index next = 3 * std::ssize(vertices) + 3 * n_triangles;
    for (const int s : tractions.free_surfaces) {
        const std::vector<int>& all = system.surfaces().triangles[static_cast<std::size_t>(s)];
        const Eigen::VectorXd field = rigid_tractions(system.boundary(), all) * solution.loads.col(0).segment<6>(next);
        triangles.insert(triangles.end(), all.begin(), all.end());
        values.insert(values.end(), field.data(), field.data() + field.size());
        next += 6;
    }
    const auto triangle_tree = system.pairs()->cluster_triangles(triangles, 64);
    const Eigen::VectorXd t =
        to_tree_order(*triangle_tree, Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)));
    const HypersingularEntries D(system.pairs(), system.tree(), system.material());
    const DoubleLayerEntries K(system.pairs(), triangles, *triangle_tree, system.tree(), system.material());
    const std::vector<int> ordered = in_order(triangles, *triangle_tree);
    const SingleLayerEntries V(system.pairs(), ordered, ordered, system.material());

    Eigen::VectorXd given_forces = Eigen::VectorXd::Zero(system.size());
    Eigen::VectorXd given_layer = Eigen::VectorXd::Zero(tractions.size());
    if (!loads.empty()) {
        given_forces = system.given_nodal_forces(loads, control) * solution.factors.col(0);
        given_layer =
            given_single_layer(system.pairs(), system.surfaces(), tractions, system.material(), loads, control) *
            solution.factors.col(0);
    }

    const int n_rows = std::min(n, kSampleVertices), n_loads = static_cast<int>(triangles.size());
    EquationBalance forces(n_rows);
    parallel_blocks(n_rows, 1, control, [&](int i, int) {
        const int at = sample(i, n_rows, n);
        Eigen::MatrixXd row(3, system.size()), column(3 * n_loads, 3);
        D.fill({at, at + 1}, {0, n}, row);
        forces.add(i, row, u, 1.0);
        forces.off.segment<3>(3 * i) -= R.segment<3>(3 * at);
        forces.add(i, Eigen::Matrix3d::Identity(), given_forces.segment<3>(3 * at), -1.0);
        if (n_loads == 0) return;
        K.fill({0, n_loads}, {at, at + 1}, column);
        forces.add(i, column.transpose(), t, 1.0);
    });
    const int n_tests = std::min(n_triangles, kSampleTriangles);
    EquationBalance tests(n_tests);
    parallel_blocks(n_tests, 1, control, [&](int i, int) {
        const int at = triangle_tree->positions()[static_cast<std::size_t>(sample(i, n_tests, n_triangles))];
        Eigen::MatrixXd of_u(3, system.size()), of_t(3, 3 * n_loads);
        K.fill({at, at + 1}, {0, n}, of_u);
        V.fill({at, at + 1}, {0, n_loads}, of_t);
        tests.add(i, of_u, u, 1.0);
        tests.add(i, of_t, t, -1.0);
        tests.add(i, Eigen::Matrix3d::Identity(), given_layer.segment<3>(3 * sample(i, n_tests, n_triangles)), -1.0);
    });
    return std::max(forces.relative(), tests.relative());
}

}  // namespace elastolab
