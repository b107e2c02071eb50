#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "bem/boundary.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "bem/hierarchical/cluster_tree.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

std::shared_ptr<const ClusterTree> clustered(const SurfaceMesh& mesh, int leaf_size) {
    return BoundaryPairs(std::make_shared<const Boundary>(mesh), 1e-6).cluster_vertices(leaf_size);
}

TEST(ClusterTree, OrdersEveryVertexOnce) {
    const auto tree = clustered(make_torus(4), 20);
    std::vector<int> sorted = tree->order();
    std::sort(sorted.begin(), sorted.end());
    for (int v = 0; v < tree->size(); ++v) {
        EXPECT_EQ(sorted[static_cast<std::size_t>(v)], v);
        EXPECT_EQ(tree->order()[static_cast<std::size_t>(tree->positions()[static_cast<std::size_t>(v)])], v);
    }
    int next = 0;
    for (const int leaf : tree->leaves()) {
        EXPECT_EQ(tree->cluster(leaf).range.begin, next);
        EXPECT_LE(tree->cluster(leaf).range.size(), 20);
        next = tree->cluster(leaf).range.end;
    }
    EXPECT_EQ(next, tree->size());
}

Eigen::MatrixXi times_covered(const ClusterTree& rows, const ClusterTree& cols, const std::vector<ClusterPair>& pairs,
                              bool mirrored) {
    Eigen::MatrixXi times = Eigen::MatrixXi::Zero(rows.size(), cols.size());
    for (const ClusterPair& pair : pairs) {
        const PositionRange r = rows.cluster(pair.row).range, c = cols.cluster(pair.col).range;
        times.block(r.begin, c.begin, r.size(), c.size()).array() += 1;
        if (mirrored && pair.row != pair.col) times.block(c.begin, r.begin, c.size(), r.size()).array() += 1;
    }
    return times;
}

TEST(ClusterTree, PairsCoverAMatrixOnceAndAdmissibleOnesAreApart) {
    const auto fine = clustered(make_sphere(10), 12), coarse = clustered(make_sphere(4), 30);
    const std::vector<ClusterPair> all = cover_matrix(*fine, *coarse, 1.5), half = cover_symmetric_matrix(*fine, 1.5);
    EXPECT_TRUE((times_covered(*fine, *coarse, all, false).array() == 1).all());
    EXPECT_TRUE((times_covered(*fine, *fine, half, true).array() == 1).all());
    int n_admissible = 0;
    for (const ClusterPair& pair : half) {
        if (!pair.admissible) continue;
        ++n_admissible;
        const auto &a = fine->cluster(pair.row).box, &b = fine->cluster(pair.col).box;
        EXPECT_LE(std::min(a.diagonal().norm(), b.diagonal().norm()), 1.5 * a.exteriorDistance(b));
    }
    EXPECT_GT(n_admissible, 10);
}

TEST(ClusterTree, RowsGoToTheOrderOfTheTreeAndBack) {
    const auto tree = clustered(make_sphere(4), 10);
    const Eigen::MatrixXd X = Eigen::MatrixXd::Random(3 * tree->size(), 2), Y = to_tree_order(*tree, X);
    EXPECT_EQ(to_item_order(*tree, Y), X);
    EXPECT_EQ(Y.topRows(3), X.middleRows(3 * tree->order().front(), 3));
}

}  // namespace
}  // namespace elastolab
