#include "bem/galerkin/refined_hypersingular.hpp"

#include "base/parallel.hpp"
#include "bem/hierarchical/cluster_tree.hpp"

namespace elastolab {

namespace {

/// Vertices whose columns are integrated at once: neighbours share triangles, most of them lie at a rim.
constexpr int kVerticesAtOnce = 16;

}  // namespace

Eigen::MatrixXd refined_hypersingular(const Eigen::MatrixXd& coarse, const RefinedSurface& fine,
                                      const std::shared_ptr<const BoundaryPairs>& pairs, const Material& material,
                                      Control& control) {
    const int n = fine.mesh.n_vertices(), n_old = static_cast<int>(coarse.cols() / 3);
    const Eigen::Index n_new = 3 * Eigen::Index{n - n_old};
    const auto tree = pairs->cluster_vertices(kVerticesAtOnce);
    const HypersingularEntries entries(pairs, tree, material);
    Eigen::MatrixXd D(3 * n, 3 * n);
    parallel_blocks(static_cast<int>(tree->leaves().size()), 1, control, [&](int leaf, int) {
        const PositionRange range = tree->cluster(tree->leaves()[static_cast<std::size_t>(leaf)]).range;
        const auto vertex = [&](int position) { return tree->order()[static_cast<std::size_t>(position)]; };
        Eigen::MatrixXd rows;
        for (int position = range.begin; position < range.end; ++position) {
            if (vertex(position) < n_old) continue;
            if (rows.size() == 0) {
                rows.resize(3 * range.size(), 3 * n);
                entries.fill(range, {0, n}, rows);
            }
            for (int other = 0; other < n; ++other)
                D.block<3, 3>(3 * vertex(other), 3 * vertex(position)) =
                    rows.block<3, 3>(3 * (position - range.begin), 3 * other).transpose();
        }
    });
    auto D_nn = D.bottomRightCorner(n_new, n_new);
    D_nn = (0.5 * (D_nn + D_nn.transpose())).eval();  // equal but for the tolerance of the integrals
    D.bottomLeftCorner(n_new, coarse.cols()) = D.topRightCorner(coarse.rows(), n_new).transpose();

    // (D_on + P^T D_nn / 2) P and its transpose are what D_oo lacks.
    const SurfaceWeights weights = fine.weights();
    const auto for_parents = [&](const auto& use) {
        for (int v = n_old; v < n; ++v)
            for (SurfaceWeights::InnerIterator at(weights, v); at; ++at)
                use(3 * Eigen::Index{v - n_old}, 3 * static_cast<Eigen::Index>(at.col()), at.value());
    };
    Eigen::MatrixXd half = D.topRightCorner(coarse.rows(), n_new),
                    lacking = Eigen::MatrixXd::Zero(coarse.rows(), coarse.cols());
    for_parents([&](Eigen::Index v, Eigen::Index parent, double weight) {
        half.middleRows<3>(parent) += 0.5 * weight * D_nn.middleRows<3>(v);
    });
    for_parents([&](Eigen::Index v, Eigen::Index parent, double weight) {
        lacking.middleCols<3>(parent) += weight * half.middleCols<3>(v);
    });
    D.topLeftCorner(coarse.rows(), coarse.cols()) = coarse - (lacking + lacking.transpose());
    return D;
}

}  // namespace elastolab
