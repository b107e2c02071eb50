#include "bem/galerkin/boundary_entries.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <span>

#include "bem/galerkin/hat_curls.hpp"

namespace elastolab {

namespace {

constexpr double kFarIntegrals = 100.0;

std::vector<TriangleGeometry> all_triangles_of(const Boundary& boundary) {
    std::vector<TriangleGeometry> triangles;
    for (int t = 0; t < boundary.n_triangles(); ++t) triangles.push_back(boundary.triangle(t));
    return triangles;
}

Eigen::AlignedBox3d box_of(const Boundary& boundary, int triangle) {
    Eigen::AlignedBox3d box;
    for (const int v : boundary.mesh().triangles.col(triangle)) box.extend(boundary.mesh().vertices.col(v));
    return box;
}

/// The triangles around the vertices of a range, each once, and where their corners are in it.
struct Star {
    std::vector<int> triangles;
    std::vector<std::array<int, 3>> corners;  ///< positions of the corners from the begin of the range, -1: outside

    Star(const BoundaryPairs& pairs, const ClusterTree& tree, PositionRange range) {
        for (int position = range.begin; position < range.end; ++position)
            for (const int t : pairs.triangles_at(tree.order()[static_cast<std::size_t>(position)])) {
                std::array<int, 3> corner;
                int first = position;
                for (std::size_t k = 0; k < 3; ++k) {
                    const int v = pairs.boundary().mesh().triangles(static_cast<Eigen::Index>(k), t);
                    const int at = tree.positions()[static_cast<std::size_t>(v)];
                    corner[k] = range.contains(at) ? at - range.begin : -1;
                    if (corner[k] >= 0) first = std::min(first, at);
                }
                if (first != position) continue;  // came with the vertex at `first`
                triangles.push_back(t);
                corners.push_back(corner);
            }
    }
    int size() const { return static_cast<int>(triangles.size()); }
};

/// What the vertices of a range have collected: [vertex][number][lane], and a place for vertices outside.
class CurlSums {
public:
    CurlSums(int n_vertices, int lanes)
        : stride_(static_cast<std::size_t>(kCurlNumbers * lanes)),
          values_(stride_ * static_cast<std::size_t>(n_vertices + 1)),
          outside_(n_vertices) {}
    double* at(int vertex) {
        return values_.data() + stride_ * static_cast<std::size_t>(vertex < 0 ? outside_ : vertex);
    }
    void clear() { std::fill(values_.begin(), values_.end(), 0.0); }

private:
    std::size_t stride_;
    std::vector<double> values_;
    int outside_;
};

struct CurlRows {
    double values[3][3];
    explicit CurlRows(const Eigen::Matrix3d& c)
        : values{{c(0, 0), c(1, 0), c(2, 0)}, {c(0, 1), c(1, 1), c(2, 1)}, {c(0, 2), c(1, 2), c(2, 2)}} {}
};

}  // namespace

BoundaryPairs::BoundaryPairs(std::shared_ptr<const Boundary> boundary, double tolerance)
    : boundary_(std::move(boundary)),
      triangles_(all_triangles_of(*boundary_)),
      at_vertex_(static_cast<std::size_t>(boundary_->mesh().n_vertices())),
      integrals_(triangles_, tolerance),
      far_integrals_(triangles_, std::min(kFarIntegrals * tolerance, 1e-5)) {
    for (int t = 0; t < boundary_->n_triangles(); ++t) {
        curls_.push_back(hat_curls(triangle(t)));
        for (const int v : boundary_->mesh().triangles.col(t)) at_vertex_[static_cast<std::size_t>(v)].push_back(t);
    }
}

std::shared_ptr<const ClusterTree> BoundaryPairs::cluster_vertices(int leaf_size) const {
    std::vector<Eigen::AlignedBox3d> boxes(at_vertex_.size());
    for (std::size_t v = 0; v < boxes.size(); ++v)
        for (const int t : at_vertex_[v]) boxes[v].extend(box_of(*boundary_, t));
    return std::make_shared<const ClusterTree>(boxes, leaf_size);
}

std::shared_ptr<const ClusterTree> BoundaryPairs::cluster_triangles(std::span<const int> triangles,
                                                                    int leaf_size) const {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const int t : triangles) boxes.push_back(box_of(*boundary_, t));
    return std::make_shared<const ClusterTree>(boxes, leaf_size);
}

std::shared_ptr<const KeptClosePairs> BoundaryPairs::keep_close_pairs(Control& control) const {
    std::vector<int> all(triangles_.size());
    std::iota(all.begin(), all.end(), 0);
    return std::make_shared<const KeptClosePairs>(integrals_, triangles_, *cluster_triangles(all, 16), control);
}

HypersingularEntries::HypersingularEntries(std::shared_ptr<const BoundaryPairs> pairs,
                                           std::shared_ptr<const ClusterTree> tree, const Material& material,
                                           std::shared_ptr<const KeptClosePairs> close)
    : PairEntries(std::move(pairs)), tree_(std::move(tree)), close_(std::move(close)) {
    alpha_ = 0.25 * std::numbers::inv_pi * material.shear_modulus();
    beta_ = alpha_ / (1.0 - material.poisson_ratio);
}

namespace {

/// Tensor numbers, those of close pairs from what was kept, if it was.
void integrate_tensor(const PairIntegrals& integrals, const KeptClosePairs* close, const PairIntegrals::Pack& pack,
                      int field, double* Q) {
    if (close == nullptr) return integrals.integrate(pack, field, false, Q);
    const unsigned others = integrals.integrate_far(pack, field, false, Q);
    if (others == 0) return;
    const int lanes = integrals.lanes();
    for (int lane = 0; lane < lanes; ++lane) {
        if ((others >> lane & 1u) == 0) continue;
        const KeptClosePairs::Numbers& numbers = close->of(pack.triangles[static_cast<std::size_t>(lane)], field);
        for (int k = 0; k < kPairTensorNumbers; ++k) Q[k * lanes + lane] = numbers[static_cast<std::size_t>(k)];
    }
}

}  // namespace

void HypersingularEntries::fill_with(const PairIntegrals& integrals, PositionRange rows, PositionRange cols,
                                     Eigen::Ref<Eigen::MatrixXd> out) const {
    if (rows.size() > 4 * cols.size()) {  // test triangles are integrated several at once: let them be the fewer
        Eigen::MatrixXd transposed(out.cols(), out.rows());
        fill_with(integrals, cols, rows, transposed);
        out = transposed.transpose();
        return;
    }
    out.setZero();
    const KeptClosePairs* close = &integrals == &pairs().integrals() ? close_.get() : nullptr;  // far blocks have none
    const PairKernels& kernels = best_pair_kernels();
    const int lanes = integrals.lanes();
    const auto n_lanes = static_cast<std::size_t>(lanes);
    const Star tests(pairs(), *tree_, rows), fields(pairs(), *tree_, cols);
    CurlSums sums(cols.size(), lanes);
    for (int first = 0; first < tests.size(); first += lanes) {
        const int count = std::min(lanes, tests.size() - first);
        const PairIntegrals::Pack pack = integrals.pack(
            std::span(tests.triangles).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)));
        sums.clear();
        for (std::size_t f = 0; f < fields.triangles.size(); ++f) {
            double Q[kPairNumbers * kMaxLanes];
            integrate_tensor(integrals, close, pack, fields.triangles[f], Q);
            const CurlRows curls(pairs().curls(fields.triangles[f]));
            const auto& corner = fields.corners[f];
            double* const into[3] = {sums.at(corner[0]), sums.at(corner[1]), sums.at(corner[2])};
            kernels.add_curls(Q, kHypersingularFactors, curls.values, into);
        }
        double curls[9 * kMaxLanes];
        for (std::size_t lane = 0; lane < n_lanes; ++lane)
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t i = 0; i < 3; ++i)
                    curls[(3 * k + i) * n_lanes + lane] =
                        pairs().curls(pack.triangles[lane])(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
        double blocks[27 * kMaxLanes];
        for (int b = 0; b < cols.size(); ++b) {
            kernels.contract_curls(alpha_, beta_, curls, sums.at(b), blocks);
            for (int lane = 0; lane < count; ++lane)
                for (int k = 0; k < 3; ++k) {
                    const int a = tests.corners[static_cast<std::size_t>(first + lane)][static_cast<std::size_t>(k)];
                    if (a < 0) continue;
                    for (int i = 0; i < 3; ++i)
                        for (int j = 0; j < 3; ++j)
                            out(3 * a + i, 3 * b + j) += blocks[(9 * k + 3 * i + j) * lanes + lane];
                }
        }
    }
}

std::vector<int> in_order(const std::vector<int>& triangles, const ClusterTree& tree) {
    std::vector<int> ordered;
    for (const int item : tree.order()) ordered.push_back(triangles[static_cast<std::size_t>(item)]);
    return ordered;
}

SingleLayerEntries::SingleLayerEntries(std::shared_ptr<const BoundaryPairs> pairs, std::vector<int> rows,
                                       std::vector<int> cols, const Material& material)
    : PairEntries(std::move(pairs)), rows_(std::move(rows)), cols_(std::move(cols)), material_(material) {}

void SingleLayerEntries::fill_with(const PairIntegrals& integrals, PositionRange rows, PositionRange cols,
                                   Eigen::Ref<Eigen::MatrixXd> out) const {
    const bool swap = rows.size() < cols.size();  // the longer side fills the lanes; a pair is symmetric
    const PositionRange tests = swap ? cols : rows, fields = swap ? rows : cols;
    const std::vector<int>&test_triangles = swap ? cols_ : rows_, &field_triangles = swap ? rows_ : cols_;
    const int lanes = integrals.lanes();
    const double factor = 1.0 / (16.0 * std::numbers::pi * material_.shear_modulus() * (1.0 - material_.poisson_ratio));
    for (int first = tests.begin; first < tests.end; first += lanes) {
        const int count = std::min(lanes, tests.end - first);
        const PairIntegrals::Pack pack = integrals.pack(
            std::span(test_triangles).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)));
        for (int f = fields.begin; f < fields.end; ++f) {
            double numbers[kPairNumbers * kMaxLanes];
            integrals.integrate(pack, field_triangles[static_cast<std::size_t>(f)], false, numbers);
            for (int lane = 0; lane < count; ++lane) {
                const auto q = [&](int k) { return factor * numbers[k * lanes + lane]; };
                Eigen::Matrix3d block;
                block << q(0), q(3), q(4), q(3), q(1), q(5), q(4), q(5), q(2);
                block.diagonal().array() += (3.0 - 4.0 * material_.poisson_ratio) * block.trace();
                const int test = 3 * (first + lane - tests.begin), field = 3 * (f - fields.begin);
                out.block<3, 3>(swap ? field : test, swap ? test : field) = block;
            }
        }
    }
}

DoubleLayerEntries::DoubleLayerEntries(std::shared_ptr<const BoundaryPairs> pairs, const std::vector<int>& triangles,
                                       const ClusterTree& triangle_tree, std::shared_ptr<const ClusterTree> vertex_tree,
                                       const Material& material)
    : PairEntries(std::move(pairs)),
      ordered_(in_order(triangles, triangle_tree)),
      vertex_tree_(std::move(vertex_tree)),
      nu_(material.poisson_ratio) {}

void DoubleLayerEntries::fill_with(const PairIntegrals& integrals, PositionRange rows, PositionRange cols,
                                   Eigen::Ref<Eigen::MatrixXd> out) const {
    const PairKernels& kernels = best_pair_kernels();
    const int lanes = integrals.lanes();
    const Star fields(pairs(), *vertex_tree_, cols);
    CurlSums sums(cols.size(), lanes);
    std::vector<double> normals(static_cast<std::size_t>(lanes * (cols.size() + 1)));
    const auto normals_at = [&](int v) { return normals.data() + lanes * (v < 0 ? cols.size() : v); };
    const double factor = 1.0 / (8.0 * std::numbers::pi * (1.0 - nu_));
    for (int first = rows.begin; first < rows.end; first += lanes) {
        const int count = std::min(lanes, rows.end - first);
        const PairIntegrals::Pack pack = integrals.pack(
            std::span(ordered_).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)));
        sums.clear();
        std::fill(normals.begin(), normals.end(), 0.0);
        for (std::size_t f = 0; f < fields.triangles.size(); ++f) {
            double numbers[kPairNumbers * kMaxLanes];
            integrals.integrate(pack, fields.triangles[f], true, numbers);
            const auto& corner = fields.corners[f];
            for (std::size_t k = 0; k < 3; ++k)
                for (int lane = 0; lane < lanes; ++lane)
                    normals_at(corner[k])[lane] += numbers[(kPairTensorNumbers + static_cast<int>(k)) * lanes + lane];
            const CurlRows curls(pairs().curls(fields.triangles[f]));
            double* const into[3] = {sums.at(corner[0]), sums.at(corner[1]), sums.at(corner[2])};
            kernels.add_curls(numbers, double_layer_factors(nu_), curls.values, into);
        }
        for (int lane = 0; lane < count; ++lane) {
            const int test = first + lane;
            for (int b = 0; b < cols.size(); ++b) {
                const double* M = sums.at(b) + 3 * lanes + lane;
                auto block = out.block<3, 3>(3 * (test - rows.begin), 3 * b);
                for (int j = 0; j < 3; ++j)
                    for (int i = 0; i < 3; ++i) block(i, j) = factor * M[(3 * j + i) * lanes];
                block.diagonal().array() -= normals_at(b)[lane] / (4.0 * std::numbers::pi);
            }
            const int t = ordered_[static_cast<std::size_t>(test)];
            for (const int v : pairs().boundary().mesh().triangles.col(t)) {
                const int at = vertex_tree_->positions()[static_cast<std::size_t>(v)];
                if (cols.contains(at))
                    out.block<3, 3>(3 * (test - rows.begin), 3 * (at - cols.begin)).diagonal().array() +=
                        pairs().boundary().area(t) / 6.0;
            }
        }
    }
}

}  // namespace elastolab
