#include "bem/hierarchical/schwarz.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/lapack.hpp"
#include "base/parallel.hpp"
#include "bem/hierarchical/free_modes.hpp"
#include "bem/hierarchical/item_rows.hpp"

namespace elastolab {

namespace {

constexpr int kCoreVertices = 96;  ///< at most, of a patch before it grows
constexpr int kRings = 1;          ///< by how many it grows
constexpr int kSmoothings = 2;     ///< of the weights of the rigid motions
constexpr double kCoarseShift = 1e-9;
constexpr double kNoEnergy = 1e-10;  ///< of a loose motion, over the largest of a patch's

/// Vertices with an edge in common with each, by position in the tree.
std::vector<std::vector<int>> neighbours_of(const SurfaceMesh& mesh, const ClusterTree& tree) {
    std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(tree.size()));
    for (int t = 0; t < mesh.n_triangles(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int a = tree.positions()[static_cast<std::size_t>(mesh.triangles(k, t))];
            const int b = tree.positions()[static_cast<std::size_t>(mesh.triangles((k + 1) % 3, t))];
            neighbours[static_cast<std::size_t>(a)].push_back(b);  // each edge has two triangles, one for each end
        }
    return neighbours;
}

std::vector<int> grown(PositionRange core, const std::vector<std::vector<int>>& neighbours,
                       const std::vector<char>& is_free) {
    std::vector<int> all;
    for (int position = core.begin; position < core.end; ++position) all.push_back(position);
    for (int ring = 0; ring < kRings; ++ring) {
        std::vector<int> more = all;
        for (const int a : all)
            for (const int b : neighbours[static_cast<std::size_t>(a)]) more.push_back(b);
        std::sort(more.begin(), more.end());
        more.erase(std::unique(more.begin(), more.end()), more.end());
        all = std::move(more);
    }
    std::erase_if(all, [&](int position) { return !is_free[static_cast<std::size_t>(position)]; });
    return all;
}

/// A partition of unity: weights of the cores at each vertex, 1 in the core, then smoothed.
std::vector<std::vector<std::pair<int, double>>> weights_of(const std::vector<PositionRange>& cores,
                                                            const std::vector<std::vector<int>>& neighbours) {
    std::vector<std::vector<std::pair<int, double>>> weights(neighbours.size());
    for (std::size_t p = 0; p < cores.size(); ++p)
        for (int position = cores[p].begin; position < cores[p].end; ++position)
            weights[static_cast<std::size_t>(position)] = {{static_cast<int>(p), 1.0}};
    for (int pass = 0; pass < kSmoothings; ++pass) {
        auto smooth = weights;
        for (std::size_t a = 0; a < weights.size(); ++a) {
            const double share = 0.5 / static_cast<double>(neighbours[a].size());
            for (auto& [p, weight] : smooth[a]) weight *= 0.5;
            const auto add = [&](int p, double weight) {
                for (auto& entry : smooth[a])
                    if (entry.first == p) {
                        entry.second += weight;
                        return;
                    }
                smooth[a].emplace_back(p, weight);
            };
            for (const int b : neighbours[a])
                for (const auto& [p, weight] : weights[static_cast<std::size_t>(b)]) add(p, share * weight);
        }
        weights = std::move(smooth);
    }
    return weights;
}

/// The rigid motions of each core about its middle, times its weights: 6 columns a core.
Eigen::SparseMatrix<double, Eigen::RowMajor> coarse_motions(const SurfaceMesh& mesh, const ClusterTree& tree,
                                                            const std::vector<PositionRange>& cores,
                                                            const std::vector<std::vector<int>>& neighbours,
                                                            const std::vector<char>& is_free) {
    const auto point = [&](int position) -> Eigen::Vector3d {
        return mesh.vertices.col(tree.order()[static_cast<std::size_t>(position)]);
    };
    std::vector<Eigen::Vector3d> middles;
    std::vector<double> scales;
    for (const PositionRange& core : cores) {
        Eigen::AlignedBox3d box;
        for (int position = core.begin; position < core.end; ++position) box.extend(point(position));
        middles.push_back(box.center());
        scales.push_back(2.0 / std::max(box.diagonal().norm(), 1e-300));
    }
    const auto weights = weights_of(cores, neighbours);
    std::vector<Eigen::Triplet<double>> entries;
    for (int position = 0; position < tree.size(); ++position) {
        if (!is_free[static_cast<std::size_t>(position)]) continue;
        for (const auto& [p, weight] : weights[static_cast<std::size_t>(position)]) {
            const auto core = static_cast<std::size_t>(p);
            const Eigen::Vector3d x = scales[core] * (point(position) - middles[core]);
            for (int i = 0; i < 3; ++i) {
                const int j = (i + 1) % 3, k = (i + 2) % 3;  // rotation about i: e_i x x
                entries.emplace_back(3 * position + i, 6 * p + i, weight);
                entries.emplace_back(3 * position + j, 6 * p + 3 + i, -weight * x[k]);
                entries.emplace_back(3 * position + k, 6 * p + 3 + i, weight * x[j]);
            }
        }
    }
    Eigen::SparseMatrix<double, Eigen::RowMajor> Z(3 * tree.size(), 6 * std::ssize(cores));
    Z.setFromTriplets(entries.begin(), entries.end());
    return Z;
}

/// The vertices of each closed surface, by position in the tree, ascending: where its motions are not zero.
std::vector<std::vector<int>> positions_of_surfaces(const Eigen::MatrixXd& surface_modes) {
    std::vector<std::vector<int>> positions(static_cast<std::size_t>(surface_modes.cols() / 6));
    for (std::size_t s = 0; s < positions.size(); ++s)
        for (Eigen::Index p = 0; p < surface_modes.rows() / 3; ++p)
            if (!surface_modes.block<3, 6>(3 * p, 6 * static_cast<Eigen::Index>(s)).isZero(0.0))
                positions[s].push_back(static_cast<int>(p));
    return positions;
}

/// A closed surface that a patch has all of, but for so many vertices at most, may move in it without energy.
constexpr std::ptrdiff_t kMostOutside = 8;

/// Adds an energy to the rigid motions of closed surfaces that vanish outside these positions: D has none for them.
void regularise(Eigen::MatrixXd& D, const std::vector<int>& patch, const std::vector<std::vector<int>>& surfaces,
                const Eigen::MatrixXd& surface_modes) {
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        std::vector<int> outside;
        std::set_difference(surfaces[s].begin(), surfaces[s].end(), patch.begin(), patch.end(),
                            std::back_inserter(outside));
        if (std::ssize(outside) > kMostOutside || outside.size() == surfaces[s].size()) continue;
        const auto motions = surface_modes.middleCols<6>(6 * static_cast<Eigen::Index>(s));
        const Eigen::MatrixXd unseen = rows_of(unseen_modes(motions, outside), patch);
        D.noalias() += D.diagonal().mean() * unseen * unseen.transpose();
    }
}

/// Combinations of motions of unit energy, of those with more than rounding leaves.
Eigen::MatrixXd of_unit_energy(const Eigen::MatrixXd& motions, const Eigen::MatrixXd& energies, double rounding) {
    if (motions.cols() == 0) return motions;
    const SymmetricEigen eigen = symmetric_eigen(0.5 * (energies + energies.transpose()));
    const Eigen::Index n_with = (eigen.values.array() > rounding).count();
    return motions * eigen.vectors.rightCols(n_with) *
           eigen.values.tail(n_with).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace

SchwarzPreconditioner::SchwarzPreconditioner(const HierarchicalMatrix& D, const Boundary& boundary,
                                             std::vector<char> is_free, const Eigen::MatrixXd& surface_modes,
                                             const Eigen::MatrixXd& loose, const Eigen::MatrixXd& loose_energies,
                                             Control& control)
    : is_free_(std::move(is_free)) {
    const ClusterTree& tree = D.row_tree();
    const std::vector<std::vector<int>> surfaces = positions_of_surfaces(surface_modes);
    const std::vector<PositionRange> cores = clusters_up_to(tree, kCoreVertices);
    const auto neighbours = neighbours_of(boundary.mesh(), tree);
    patches_.resize(cores.size());
    {
        const SerialBlas serial;
        parallel_blocks(static_cast<int>(cores.size()), 1, control, [&](int p, int) {
            Patch& patch = patches_[static_cast<std::size_t>(p)];
            patch.positions = grown(cores[static_cast<std::size_t>(p)], neighbours, is_free_);
            if (patch.positions.empty()) return;
            Eigen::MatrixXd own = D.submatrix(patch.positions, patch.positions);
            regularise(own, patch.positions, surfaces, surface_modes);
            patch.factor.compute(own.cast<float>());
            if (patch.factor.info() != Eigen::Success)
                throw SolveError(
                    "hypersingular matrix: is not positive definite near a vertex. Check the mesh for slivers and thin "
                    "walls.");
        });
    }
    coarse_ = coarse_motions(boundary.mesh(), tree, cores, neighbours, is_free_);
    Eigen::MatrixXd E = D.galerkin_product(coarse_, control);
    // Motions of patches that are constrained as a whole are zero, loose ones cost no energy.
    const double largest = E.cols() > 0 ? E.diagonal().maxCoeff() : 0.0;
    if (!(largest > 0.0)) {  // all is constrained: nothing moves
        coarse_.resize(coarse_.rows(), 0);
        return;
    }
    E.diagonal().array() += kCoarseShift * largest;
    loose_ = of_unit_energy(loose, loose_energies, kNoEnergy * largest);
    if (loose.cols() > 0) {
        const Eigen::MatrixXd seen = coarse_.transpose() * loose;
        E.noalias() += (largest * static_cast<double>(loose.cols()) / seen.squaredNorm()) * seen * seen.transpose();
    }
    coarse_factor_.compute(E);
    if (coarse_factor_.info() != Eigen::Success)
        throw SolveError("hypersingular matrix: is not positive definite. Check the mesh for slivers and thin walls.");
}

Eigen::MatrixXd SchwarzPreconditioner::product(const Eigen::MatrixXd& X) const {
    const SerialBlas serial;
    Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(X.rows(), X.cols());
    if (coarse_.cols() > 0) Y = coarse_ * coarse_factor_.solve(coarse_.transpose() * X);
    if (loose_.cols() > 0) Y.noalias() += loose_ * (loose_.transpose() * X).eval();
    std::vector<Eigen::MatrixXf> answers(patches_.size());
    Control control;
    parallel_blocks(static_cast<int>(patches_.size()), 1, control, [&](int p, int) {
        const Patch& patch = patches_[static_cast<std::size_t>(p)];
        if (patch.positions.empty()) return;
        Eigen::MatrixXf own(3 * std::ssize(patch.positions), X.cols());
        for (Eigen::Index i = 0; i < std::ssize(patch.positions); ++i)
            own.middleRows<3>(3 * i) = X.middleRows<3>(3 * patch.positions[static_cast<std::size_t>(i)]).cast<float>();
        patch.factor.solveInPlace(own);
        answers[static_cast<std::size_t>(p)] = std::move(own);
    });
    for (std::size_t p = 0; p < patches_.size(); ++p)
        for (std::size_t i = 0; i < patches_[p].positions.size(); ++i)
            Y.middleRows<3>(3 * patches_[p].positions[i]) +=
                answers[p].middleRows<3>(3 * static_cast<Eigen::Index>(i)).cast<double>();
    return Y;
}

}  // namespace elastolab
