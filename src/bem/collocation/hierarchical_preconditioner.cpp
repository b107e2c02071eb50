#include <algorithm>
#include <cmath>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <vector>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/lapack.hpp"
#include "base/parallel.hpp"
#include "bem/collocation/hierarchical.hpp"

namespace elastolab {

namespace {

constexpr int kPointsOfAPatch = 48;               ///< before it grows
constexpr double kGrowth = 1.5;                   ///< in units of the distance of its points
constexpr int kMostPoints = 4 * kPointsOfAPatch;  ///< after that: beside finer triangles its box holds many
constexpr int kParts = 16;                        ///< of the coarse level; more save hardly an iteration
constexpr double kIndependent = 1e-6;

Eigen::AlignedBox3d box_around(const Positions& points, const ClusterTree& tree, PositionRange range) {
    Eigen::AlignedBox3d box;
    for (int position = range.begin; position < range.end; ++position)
        box.extend(points.col(tree.order()[static_cast<std::size_t>(position)]));
    return box;
}

/// Numbers of the points in a box, ascending.
std::vector<int> points_in(const Eigen::AlignedBox3d& box, const Positions& points, const ClusterTree& tree) {
    std::vector<int> inside, waiting = {0};
    while (!waiting.empty()) {
        const ClusterTree::Cluster& cluster = tree.cluster(waiting.back());
        waiting.pop_back();
        if (!cluster.box.intersects(box)) continue;
        if (!cluster.is_leaf()) {
            waiting.push_back(cluster.first_child);
            waiting.push_back(cluster.first_child + 1);
            continue;
        }
        for (int position = cluster.range.begin; position < cluster.range.end; ++position)
            if (const int number = tree.order()[static_cast<std::size_t>(position)]; box.contains(points.col(number)))
                inside.push_back(number);
    }
    std::sort(inside.begin(), inside.end());
    return inside;
}

/// Of these points at most kMostPoints, those of the core and those next to its box; ascending.
template <class IsCore>
std::vector<int> nearest(std::vector<int> numbers, const Positions& points, const Eigen::AlignedBox3d& box,
                         const IsCore& is_core) {
    if (std::ssize(numbers) <= kMostPoints) return numbers;
    const auto distance = [&](int number) {
        return is_core(number) ? -1.0 : box.squaredExteriorDistance(Eigen::Vector3d(points.col(number)));
    };
    std::stable_sort(numbers.begin(), numbers.end(), [&](int a, int b) { return distance(a) < distance(b); });
    numbers.resize(kMostPoints);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

/// Orthonormal combinations of the columns, as many as are independent.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
    const SingularValues svd = singular_values(columns);
    return svd.U.leftCols((svd.sigma.array() > kIndependent * svd.sigma[0]).count());
}

/// Rigid motions of the free vertices and constant tractions of each part: columns without rows in common, but for
/// those of one part.
SparseColumns columns_of_parts(const CollocationProblem& problem, const ClusterTree& tree) {
    std::vector<Eigen::Triplet<double>> entries;
    int n_columns = 0;
    const auto add = [&](const std::vector<int>& numbers, const Eigen::MatrixXd& columns) {
        if (numbers.empty()) return;
        const Eigen::MatrixXd basis = orthonormal(columns);
        for (Eigen::Index c = 0; c < basis.cols(); ++c, ++n_columns)
            for (std::size_t i = 0; i < numbers.size(); ++i)
                for (int k = 0; k < 3; ++k)
                    entries.emplace_back(3 * numbers[i] + k, n_columns, basis(3 * static_cast<Eigen::Index>(i) + k, c));
    };
    for (const PositionRange& part : clusters_up_to(tree, std::max(kPointsOfAPatch, tree.size() / kParts))) {
        const Eigen::AlignedBox3d box = box_around(problem.points(), tree, part);
        const double scale = 2.0 / std::max(box.diagonal().norm(), 1e-300);
        std::vector<int> vertices, slots;
        for (int position = part.begin; position < part.end; ++position) {
            const int number = tree.order()[static_cast<std::size_t>(position)];
            (number < problem.n_free() ? vertices : slots).push_back(number);
        }
        Eigen::MatrixXd modes(3 * std::ssize(vertices), 6);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Eigen::Vector3d x = scale * (problem.points().col(vertices[i]) - box.center());
            modes.middleRows<3>(3 * static_cast<Eigen::Index>(i)) << Eigen::Matrix3d::Identity(),
                (Eigen::Matrix3d() << 0, x[2], -x[1], -x[2], 0, x[0], x[1], -x[0], 0).finished();
        }
        add(vertices, modes);
        add(slots, Eigen::Matrix3d::Identity().replicate(std::ssize(slots), 1));
    }
    SparseColumns Z(problem.size(), n_columns);
    Z.setFromTriplets(entries.begin(), entries.end());
    return Z;
}

class CollocationPreconditioner : public LinearOperator {
public:
    CollocationPreconditioner(const CollocationProblem& problem, Control& control) : size_(problem.size()) {
        std::vector<Eigen::AlignedBox3d> boxes;
        for (const auto& point : problem.points().colwise()) boxes.emplace_back(Eigen::Vector3d(point));
        const ClusterTree tree(boxes, kPointsOfAPatch / 2);
        make_patches(problem, tree, control);
        Z_ = columns_of_parts(problem, tree);
        make_coarse_level(problem, control);
    }
    Eigen::Index size() const override { return size_; }
    Eigen::MatrixXd product(const Eigen::MatrixXd& X) const override {
        const Eigen::MatrixXd coarse = coarse_factor_.solve(Z_.transpose() * X);
        const Eigen::MatrixXd left = X - (AZ_ * coarse.cast<float>()).cast<double>();
        Eigen::MatrixXd Y = Z_ * coarse;
        std::vector<Eigen::MatrixXf> answers(patches_.size());
        Control control;
        const SerialBlas serial;
        parallel_blocks(static_cast<int>(patches_.size()), 1, control, [&](int p, int) {
            const Patch& patch = patches_[static_cast<std::size_t>(p)];
            Eigen::MatrixXf own(3 * std::ssize(patch.numbers), X.cols());
            for (std::size_t i = 0; i < patch.numbers.size(); ++i)
                own.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
                    left.middleRows<3>(3 * patch.numbers[i]).cast<float>();
            answers[static_cast<std::size_t>(p)] = patch.factor.solve(own);
        });
        for (std::size_t p = 0; p < patches_.size(); ++p)
            for (const auto& [in_patch, number] : patches_[p].core)
                Y.middleRows<3>(3 * number) += answers[p].middleRows<3>(3 * in_patch).cast<double>();
        return Y;
    }

private:
    struct Patch {
        std::vector<int> numbers;               ///< of its points, ascending
        std::vector<std::pair<int, int>> core;  ///< which of them it answers for: place in `numbers`, number
        Eigen::PartialPivLU<Eigen::MatrixXf> factor;
    };

    void make_patches(const CollocationProblem& problem, const ClusterTree& tree, Control& control) {
        const std::vector<PositionRange> cores = clusters_up_to(tree, kPointsOfAPatch);
        patches_.resize(cores.size());
        const SerialBlas serial;
        parallel_blocks(static_cast<int>(cores.size()), 1, control, [&](int p, int) {
            const PositionRange core = cores[static_cast<std::size_t>(p)];
            Patch& patch = patches_[static_cast<std::size_t>(p)];
            const Eigen::AlignedBox3d its_core = box_around(problem.points(), tree, core);
            Eigen::AlignedBox3d box = its_core;
            const double growth = kGrowth * box.diagonal().norm() / std::sqrt(core.size());
            box.extend(Eigen::Vector3d(box.min().array() - growth));
            box.extend(Eigen::Vector3d(box.max().array() + growth));
            const auto is_core = [&](int number) {
                return core.contains(tree.positions()[static_cast<std::size_t>(number)]);
            };
            patch.numbers = nearest(points_in(box, problem.points(), tree), problem.points(), its_core, is_core);
            for (std::size_t i = 0; i < patch.numbers.size(); ++i)
                if (is_core(patch.numbers[i])) patch.core.emplace_back(static_cast<int>(i), patch.numbers[i]);
            patch.factor.compute(problem.block(patch.numbers).cast<float>());
            if (!patch.factor.matrixLU().allFinite())
                throw SolveError(
                    "boundary equations: are singular near a vertex. Check the mesh for slivers and thin walls.");
        });
    }

    void make_coarse_level(const CollocationProblem& problem, Control& control) {
        constexpr Eigen::Index kCoarseColumns = 64;
        const Eigen::SparseMatrix<double> by_columns = Z_;
        AZ_.resize(Z_.rows(), Z_.cols());
        Eigen::MatrixXd E(Z_.cols(), Z_.cols());
        for (Eigen::Index first = 0; first < Z_.cols(); first += kCoarseColumns) {
            const Eigen::Index count = std::min(kCoarseColumns, Z_.cols() - first);
            const Eigen::MatrixXd some = problem.sparse_product(by_columns.middleCols(first, count), control);
            E.middleCols(first, count) = Z_.transpose() * some;
            AZ_.middleCols(first, count) = some.cast<float>();
            control.set_progress(static_cast<double>(first) / static_cast<double>(Z_.cols()));
        }
        coarse_factor_ = LuFactorization(std::move(E), "coarse boundary equations");
    }

    Eigen::Index size_;
    std::vector<Patch> patches_;
    SparseColumns Z_;
    Eigen::MatrixXf AZ_;
    LuFactorization coarse_factor_;
};

}  // namespace

std::unique_ptr<const LinearOperator> make_collocation_preconditioner(const CollocationProblem& problem,
                                                                      Control& control) {
    return std::make_unique<const CollocationPreconditioner>(problem, control);
}

}  // namespace elastolab
