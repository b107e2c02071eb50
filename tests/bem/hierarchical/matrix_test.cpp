#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <Eigen/SparseCore>
#include <memory>
#include <numeric>

#include "base/blas.hpp"
#include "bem/common.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "bem/galerkin/hypersingular.hpp"
#include "bem/galerkin/traction_rows.hpp"
#include "bem/hierarchical/hierarchical_matrix.hpp"
#include "mesh/primitives.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab {
namespace {

using test::kUnitMaterial;

constexpr double kIntegrals = 1e-8;

/// A dense matrix over items in the order of trees.
Eigen::MatrixXd reordered(const Eigen::MatrixXd& A, const ClusterTree& rows, const ClusterTree& cols) {
    Eigen::MatrixXd B(A.rows(), A.cols());
    for (int j = 0; j < cols.size(); ++j)
        for (int i = 0; i < rows.size(); ++i)
            B.block<3, 3>(3 * i, 3 * j) = A.block<3, 3>(3 * rows.order()[static_cast<std::size_t>(i)],
                                                        3 * cols.order()[static_cast<std::size_t>(j)]);
    return B;
}

/// A rabbit with its dense operators in the order of the trees.
struct Problem {
    std::shared_ptr<const Boundary> boundary = std::make_shared<const Boundary>(make_rabbit(500).surface);
    std::shared_ptr<const BoundaryPairs> pairs = std::make_shared<const BoundaryPairs>(boundary, kIntegrals);
    std::shared_ptr<const ClusterTree> tree = pairs->cluster_vertices(20), triangle_tree;
    std::vector<int> triangles;
    Eigen::MatrixXd D, V, K;

    Problem() {
        for (int t = 0; t < boundary->n_triangles(); ++t)
            if (boundary->triangle(t).centroid[2] < 0.0) triangles.push_back(t);
        triangle_tree = pairs->cluster_triangles(triangles, 20);
        Control control;
        Eigen::MatrixXd dense(3 * tree->size(), 3 * tree->size());
        assemble_hypersingular(*boundary, kUnitMaterial, kIntegrals, dense, control);
        D = reordered(dense, *tree, *tree);
        const TractionRows rows = assemble_traction_rows(*boundary, triangles, kUnitMaterial, kIntegrals, control);
        V = reordered(rows.single_layer, *triangle_tree, *triangle_tree);
        K = reordered(rows.double_layer, *triangle_tree, *tree);
    }
    HypersingularEntries hypersingular(bool keep = false) const {
        Control control;
        return {pairs, tree, kUnitMaterial, keep ? pairs->keep_close_pairs(control) : nullptr};
    }
    DoubleLayerEntries double_layer() const { return {pairs, triangles, *triangle_tree, tree, kUnitMaterial}; }
    SingleLayerEntries single_layer() const {
        const std::vector<int> ordered = in_order(triangles, *triangle_tree);
        return {pairs, ordered, ordered, kUnitMaterial};
    }
};

const Problem& problem() {
    static const Problem the_problem;
    return the_problem;
}

double relative(const Eigen::MatrixXd& A, const Eigen::MatrixXd& truth) { return (A - truth).norm() / truth.norm(); }

TEST(BoundaryEntries, AreThoseOfTheDenseOperators) {
    const Problem& p = problem();
    const PositionRange some{30, 75}, others{60, 130}, one{7, 8}, all{0, p.tree->size()};
    const auto error = [](const BlockEntries& entries, const Eigen::MatrixXd& truth, PositionRange rows,
                          PositionRange cols) {
        Eigen::MatrixXd block(3 * rows.size(), 3 * cols.size());
        entries.fill(rows, cols, block);
        return relative(block, truth.block(3 * rows.begin, 3 * cols.begin, block.rows(), block.cols()));
    };
    for (const auto& [rows, cols] : {std::pair(some, others), std::pair(one, all), std::pair(all, one)}) {
        EXPECT_LT(error(p.hypersingular(), p.D, rows, cols), 1e-7);
        EXPECT_LT(error(p.hypersingular(true), p.D, rows, cols), 1e-7);
    }
    for (const auto& [rows, cols] : {std::pair(some, others), std::pair(one, all), std::pair(others, one)})
        EXPECT_LT(error(p.double_layer(), p.K, rows, cols), 1e-7);
    for (const auto& [rows, cols] : {std::pair(some, others), std::pair(one, others), std::pair(others, one)})
        EXPECT_LT(error(p.single_layer(), p.V, rows, cols), 1e-7);
}

TEST(CrossApproximation, KeepsItsToleranceOnFarBlocksOfEveryOperator) {
    const Problem& p = problem();
    int n_blocks = 0;
    std::vector<double> worst;
    const auto check = [&](const BlockEntries& entries, const Eigen::MatrixXd& truth, const ClusterTree& rows,
                           const ClusterTree& cols, double tolerance) {
        for (const ClusterPair& pair : cover_matrix(rows, cols, 1.5)) {
            const PositionRange r = rows.cluster(pair.row).range, c = cols.cluster(pair.col).range;
            if (!pair.admissible || n_blocks++ % 7 != 0) continue;
            const LowRankMatrix A = cross_approximation(entries, r, c, tolerance), B = recompressed(A, tolerance);
            const Eigen::MatrixXd block = truth.block(3 * r.begin, 3 * c.begin, 3 * r.size(), 3 * c.size());
            // The stopping rule estimates: a block here and there is off by some times the tolerance.
            const double of_cross = relative(A.U * A.V.transpose(), block) / tolerance;
            const double of_least = relative(B.U * B.V.transpose(), block) / tolerance;
            EXPECT_LT(of_cross, 20.0);
            EXPECT_LT(of_least, of_cross + 1.5);
            worst.push_back(of_cross);
            EXPECT_LE(B.rank(), A.rank());
            EXPECT_LT(B.rank(), std::min(block.rows(), block.cols()));
        }
    };
    for (const double tolerance : {1e-3, 1e-5}) {
        check(p.hypersingular(), p.D, *p.tree, *p.tree, tolerance);
        check(p.double_layer(), p.K, *p.triangle_tree, *p.tree, tolerance);
        check(p.single_layer(), p.V, *p.triangle_tree, *p.triangle_tree, tolerance);
    }
    EXPECT_GT(n_blocks, 100);
    std::sort(worst.begin(), worst.end());
    EXPECT_LT(worst[worst.size() * 9 / 10], 1.0);
}

/// Two parts that do not see each other.
class TwoParts : public BlockEntries {
public:
    void fill(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const override {
        for (int i = 0; i < rows.size(); ++i)
            for (int j = 0; j < cols.size(); ++j)
                out.block<3, 3>(3 * i, 3 * j) = entry(rows.begin + i, cols.begin + j) * Eigen::Matrix3d::Identity();
    }
    static double entry(int i, int j) { return (i < 20) == (j < 20) ? 1.0 / (30.0 + i + 2.0 * j) : 0.0; }
};

TEST(CrossApproximation, FindsPartsThatItsPivotsDoNotLeadTo) {
    const TwoParts entries;
    const LowRankMatrix A = cross_approximation(entries, {0, 40}, {0, 40}, 1e-6);
    Eigen::MatrixXd truth(120, 120);
    entries.fill({0, 40}, {0, 40}, truth);
    EXPECT_LT(relative(A.U * A.V.transpose(), truth), 1e-5);
    EXPECT_LT(A.rank(), 60);
}

/// A triangle or two have nothing that pivots could leave out.
TEST(CrossApproximation, OfAFewRowsKeepsItsTolerance) {
    const Problem& p = problem();
    int n_blocks = 0;
    for (const ClusterPair& pair : cover_matrix(*p.triangle_tree, *p.tree, 1.5)) {
        const PositionRange all = p.triangle_tree->cluster(pair.row).range, c = p.tree->cluster(pair.col).range;
        const PositionRange some{all.begin, all.begin + 1 + n_blocks % 5};
        if (!pair.admissible || some.end > all.end || n_blocks++ > 100) continue;
        const LowRankMatrix A = cross_approximation(p.double_layer(), some, c, 1e-5);
        const Eigen::MatrixXd truth = p.K.block(3 * some.begin, 3 * c.begin, 3 * some.size(), 3 * c.size());
        EXPECT_LT(relative(A.U * A.V.transpose(), truth), 1e-4) << some.size() << " rows, " << c.size() << " columns";
        EXPECT_LE(A.rank(), 3 * some.size());
    }
    EXPECT_GT(n_blocks, 50);
}

TEST(CrossApproximation, OfNothingHasNoRank) {
    class Nothing : public BlockEntries {
        void fill(PositionRange, PositionRange, Eigen::Ref<Eigen::MatrixXd> out) const override { out.setZero(); }
    };
    const LowRankMatrix A = cross_approximation(Nothing(), {0, 9}, {0, 7}, 1e-6);
    EXPECT_EQ(A.rank(), 0);
    EXPECT_EQ(A.U.rows(), 27);
    EXPECT_EQ(recompressed(A, 1e-6).rank(), 0);
}

TEST(HierarchicalMatrix, ActsAsTheDenseOperators) {
    const Problem& p = problem();
    Control control;
    const HierarchicalOptions options{.tolerance = 1e-5};
    const HierarchicalMatrix D(p.tree, p.tree, true, p.hypersingular(true), options, control);
    const HierarchicalMatrix K(p.triangle_tree, p.tree, false, p.double_layer(), options, control);
    const HierarchicalMatrix V(p.triangle_tree, p.triangle_tree, true, p.single_layer(), options, control);
    const Eigen::MatrixXd X = Eigen::MatrixXd::Random(D.cols(), 3), T = Eigen::MatrixXd::Random(K.rows(), 2);
    EXPECT_LT(relative(D.product(X), p.D * X), 1e-5);
    EXPECT_LT(relative(D.transposed_product(X), p.D * X), 1e-5);
    EXPECT_LT(relative(K.product(X), p.K * X), 1e-5);
    EXPECT_LT(relative(K.transposed_product(T), p.K.transpose() * T), 1e-5);
    EXPECT_LT(relative(V.product(T), p.V * T), 1e-5);
    // Symmetric as the dense one is: conjugate gradients rely on it.
    const Eigen::VectorXd a = Eigen::VectorXd::Random(D.cols()), b = Eigen::VectorXd::Random(D.cols());
    EXPECT_NEAR(a.dot(D.product(b).col(0)), b.dot(D.product(a).col(0)), 1e-12 * a.norm() * b.norm() * p.D.norm());
    EXPECT_LT(D.memory_bytes(), 8u * static_cast<unsigned>(p.D.size()));
}

/// Every n-th position, and the rows of a matrix that belong to them.
struct Some {
    std::vector<int> positions;
    std::vector<Eigen::Index> rows;

    Some(int first, int n, int size) {
        for (int i = first; i < size; i += n) {
            positions.push_back(i);
            for (int k = 0; k < 3; ++k) rows.push_back(3 * i + k);
        }
    }
};

/// 29 columns, each with entries in a few runs of 20 positions.
SparseColumns sparse_columns(Eigen::Index n_rows) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n_rows; ++i)
        for (int k = 0; k < 2; ++k) entries.emplace_back(i, (7 * (i / 60) + 3 * k + i % 3) % 29, 1.0 + 0.1 * (i % 13));
    SparseColumns Z(n_rows, 29);
    Z.setFromTriplets(entries.begin(), entries.end());
    return Z;
}

/// Inverse distances of points on a line.
class InverseDistances : public BlockEntries {
public:
    explicit InverseDistances(const ClusterTree& tree) : tree_(tree) {}
    void fill(PositionRange rows, PositionRange cols, Eigen::Ref<Eigen::MatrixXd> out) const override {
        for (int i = 0; i < rows.size(); ++i)
            for (int j = 0; j < cols.size(); ++j) {
                const int at = tree_.order()[static_cast<std::size_t>(rows.begin + i)];
                const int to = tree_.order()[static_cast<std::size_t>(cols.begin + j)];
                out.block<3, 3>(3 * i, 3 * j) = Eigen::Matrix3d::Identity() / (1.0 + std::abs(at - to));
            }
    }

private:
    const ClusterTree& tree_;
};

/// Single precision would leave 3e-8.
TEST(HierarchicalMatrix, KeepsTolerancesBelowSinglePrecision) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (int i = 0; i < 400; ++i) boxes.emplace_back(Eigen::Vector3d(i, 0, 0), Eigen::Vector3d(i, 0, 0));
    const auto tree = std::make_shared<const ClusterTree>(boxes, 16);
    const InverseDistances entries(*tree);
    Eigen::MatrixXd truth(1200, 1200);
    entries.fill({0, 400}, {0, 400}, truth);
    const Eigen::MatrixXd X = Eigen::MatrixXd::Random(1200, 2);
    std::vector<int> even;
    for (int i = 0; i < 400; i += 2) even.push_back(i);
    Control control;
    for (const double tolerance : {1e-5, 1e-11}) {
        const HierarchicalMatrix A(tree, tree, false, entries, {.tolerance = tolerance}, control);
        EXPECT_LT(relative(A.product(X), truth * X), tolerance);
        EXPECT_LT(relative(A.transposed_product(X), truth.transpose() * X), tolerance);
        std::vector<int> of_even;
        for (const int i : even)
            for (int k = 0; k < 3; ++k) of_even.push_back(3 * i + k);
        EXPECT_LT(relative(A.submatrix(even, even), truth(of_even, of_even)), tolerance);
    }
}

TEST(HierarchicalMatrix, GivesPartsAndProductsWithSparseColumns) {
    const Problem& p = problem();
    Control control;
    const HierarchicalOptions options{.tolerance = 1e-5};
    const HierarchicalMatrix D(p.tree, p.tree, true, p.hypersingular(true), options, control);
    const HierarchicalMatrix K(p.triangle_tree, p.tree, false, p.double_layer(), options, control);
    const Some vertices(3, 11, p.tree->size()), triangles(1, 7, p.triangle_tree->size());
    EXPECT_LT(relative(D.submatrix(vertices.positions, vertices.positions), p.D(vertices.rows, vertices.rows)), 1e-5);
    EXPECT_LT(relative(K.submatrix(triangles.positions, vertices.positions), p.K(triangles.rows, vertices.rows)), 1e-5);
    const SparseColumns Z = sparse_columns(D.rows());
    EXPECT_LT(relative(D.galerkin_product(Z, control), Z.transpose() * (p.D * Z)), 1e-5);
    EXPECT_LT(relative(K.sparse_product(Z, control), p.K * Z), 1e-5);
}

TEST(HierarchicalMatrix, DoesNotDependOnTheNumberOfThreads) {
    const Problem& p = problem();
    Control control;
    const int n_threads = thread_count();
    std::vector<Eigen::MatrixXd> products;
    for (const int threads : {1, 3}) {
        set_thread_count(threads);
        const HierarchicalMatrix D(p.tree, p.tree, true, p.hypersingular(true), {.tolerance = 1e-4}, control);
        products.push_back(D.product(Eigen::MatrixXd::Ones(D.cols(), 2)));
    }
    set_thread_count(n_threads);
    EXPECT_EQ(products[0], products[1]);
}

TEST(HierarchicalMatrix, CanBeCancelled) {
    const Problem& p = problem();
    Control control;
    control.cancel();
    EXPECT_THROW(HierarchicalMatrix(p.tree, p.tree, true, p.hypersingular(), {}, control), Cancelled);
}

}  // namespace
}  // namespace elastolab
