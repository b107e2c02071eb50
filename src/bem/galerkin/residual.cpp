#include "bem/galerkin/residual.hpp"

#include <algorithm>
#include <cmath>

#include "base/blas.hpp"
#include "base/parallel.hpp"
#include "bem/galerkin/close_cost.hpp"
#include "bem/hierarchical/item_rows.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

constexpr int kSampleVertices = 128, kSampleTriangles = 64;
/// Where slivers or thin walls make rows take more integrals than this together, fewer are looked at, but some always.
constexpr double kMostCloseIntegrals = 7e6, kLeastShare = 0.125;

/// Of the sample that is looked at.
double affordable_share(const SurfaceMesh& mesh) {
    constexpr double kTrianglesAround = 6.0, kTimesOfAPair = 2.0;  // integrated once for all rows, and for either of it
    const double of_a_row = kTrianglesAround * kTimesOfAPair * costly_pair_integrals(mesh) / mesh.n_triangles();
    const double rows = std::min<double>(kSampleVertices, mesh.n_vertices());
    return of_a_row > 0.0 ? std::clamp(kMostCloseIntegrals / (rows * of_a_row), kLeastShare, 1.0) : 1.0;
}

/// What is off in some equations, and the size of their terms.
struct EquationBalance {
    Eigen::VectorXd off, size;
    explicit EquationBalance(int n) : off(Eigen::VectorXd::Zero(3 * n)), size(Eigen::VectorXd::Zero(3 * n)) {}
    /// x: freed of what the row annihilates; whole: not.
    void add(int i, const Eigen::MatrixXd& row, const Eigen::VectorXd& x, const Eigen::VectorXd& whole, double sign) {
        off.segment<3>(3 * i) += sign * (row * x);
        size.segment<3>(3 * i) += row.cwiseAbs() * whole.cwiseAbs();
    }
    double relative() const { return size.norm() > 0.0 ? off.norm() / size.norm() : 0.0; }
};

/// Every triangle that carries a traction, and that traction.
struct LoadedTriangles {
    std::vector<int> triangles;
    Eigen::VectorXd values;

    LoadedTriangles(const GalerkinEquations& equations, std::size_t n_vertices, const GalerkinTractions& tractions,
                    const NodeSolution& solution)
        : triangles(tractions.triangles) {
        Eigen::Index next = 3 * static_cast<Eigen::Index>(n_vertices);
        const auto take = [&](Eigen::Index count) {
            next += count;
            return solution.loads.col(0).segment(next - count, count);
        };
        values = take(3 * std::ssize(triangles));
        for (const int s : tractions.free_surfaces) {
            const std::vector<int>& all = equations.surfaces.triangles[static_cast<std::size_t>(s)];
            const Eigen::VectorXd field = rigid_tractions(equations.pairs->boundary(), all) * take(6);
            triangles.insert(triangles.end(), all.begin(), all.end());
            values.conservativeResize(values.size() + field.size());
            values.tail(field.size()) = field;
        }
    }
};

/// Evenly spread numbers below n.
int sample(int i, int n_samples, int n) { return static_cast<int>(static_cast<std::int64_t>(i) * n / n_samples); }

}  // namespace

double galerkin_residual(const GalerkinEquations& equations, const std::vector<int>& vertices,
                         const GalerkinTractions& tractions, const GivenTerms& given, const NodeSolution& solution,
                         Control& control) {
    const ClusterTree& tree = *equations.tree;
    const int n = tree.size();
    Eigen::VectorXd reactions = Eigen::VectorXd::Zero(3 * n);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        reactions.segment<3>(3 * vertices[i]) = solution.loads.col(0).segment<3>(3 * static_cast<Eigen::Index>(i));
    const Eigen::VectorXd u = to_tree_order(tree, solution.displacements.col(0)), R = to_tree_order(tree, reactions);
    const auto without = [&](const Eigen::MatrixXd& motions) {
        const Eigen::VectorXd whole = solution.displacements.col(0);
        return Eigen::VectorXd(to_tree_order(tree, whole - motions * (motions.transpose() * whole)));
    };
    const Eigen::VectorXd u_of_D = without(equations.surfaces.rigid),
                          u_of_K = without(rigid_modes(equations.pairs->boundary().mesh().vertices));
    const LoadedTriangles loaded(equations, vertices.size(), tractions, solution);
    const auto triangle_tree = equations.pairs->cluster_triangles(loaded.triangles, 64);
    const Eigen::VectorXd t = to_tree_order(*triangle_tree, loaded.values);
    const HypersingularEntries D(equations.pairs, equations.tree, equations.material);
    const DoubleLayerEntries K(equations.pairs, loaded.triangles, *triangle_tree, equations.tree, equations.material);
    const std::vector<int> ordered = in_order(loaded.triangles, *triangle_tree);
    const SingleLayerEntries V(equations.pairs, ordered, ordered, equations.material);

    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    Eigen::VectorXd given_forces;
    if (given.nodal_forces.size() > 0) given_forces = to_tree_order(tree, given.nodal_forces);
    const double share = affordable_share(equations.pairs->boundary().mesh());
    const auto sampled = [&](int n_all, int most) {
        return std::min(n_all, static_cast<int>(std::ceil(share * std::min(n_all, most))));
    };
    const int n_rows = sampled(n, kSampleVertices), n_loads = static_cast<int>(loaded.triangles.size());
    EquationBalance forces(n_rows);
    parallel_blocks(n_rows, 1, control, [&](int i, int) {
        const int at = sample(i, n_rows, n);
        Eigen::MatrixXd row(3, 3 * n), column(3 * n_loads, 3);
        D.fill({at, at + 1}, {0, n}, row);
        forces.add(i, row, u_of_D, u, 1.0);
        forces.off.segment<3>(3 * i) -= R.segment<3>(3 * at);
        if (given_forces.size() > 0)
            forces.add(i, one, given_forces.segment<3>(3 * at), given_forces.segment<3>(3 * at), -1.0);
        if (n_loads == 0) return;
        K.fill({0, n_loads}, {at, at + 1}, column);
        forces.add(i, column.transpose(), t, t, 1.0);
    });
    const int n_triangles = static_cast<int>(tractions.triangles.size()),
              n_tests = sampled(n_triangles, kSampleTriangles);
    EquationBalance tests(n_tests);
    parallel_blocks(n_tests, 1, control, [&](int i, int) {
        const int at = triangle_tree->positions()[static_cast<std::size_t>(sample(i, n_tests, n_triangles))];
        Eigen::MatrixXd of_u(3, 3 * n), of_t(3, 3 * n_loads);
        K.fill({at, at + 1}, {0, n}, of_u);
        V.fill({at, at + 1}, {0, n_loads}, of_t);
        tests.add(i, of_u, u_of_K, u, 1.0);
        tests.add(i, of_t, t, t, -1.0);
        const Eigen::Index row = 3 * static_cast<Eigen::Index>(sample(i, n_tests, n_triangles));
        if (given.single_layer.size() > 0)
            tests.add(i, one, given.single_layer.segment<3>(row), given.single_layer.segment<3>(row), -1.0);
    });
    return std::max(forces.relative(), tests.relative());
}

/// The triangles with their rules' points, and for each thread what the vertices collect and the rows.
std::uint64_t galerkin_residual_memory(const SurfaceMesh& mesh, std::int64_t n_loaded) {
    const auto n = static_cast<std::uint64_t>(mesh.n_vertices()), f = static_cast<std::uint64_t>(mesh.n_triangles());
    const auto m = static_cast<std::uint64_t>(n_loaded), threads = static_cast<std::uint64_t>(thread_count());
    constexpr std::uint64_t kOfATriangle = 4096;
    constexpr std::uint64_t kOfAVertex = 8 * kMaxLanes * (kCurlNumbers + 1) + 100;
    return kOfATriangle * f + threads * (kOfAVertex * n + 200 * m);
}

}  // namespace elastolab
