#include "bem/galerkin/hypersingular.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/zero_buffers.hpp"
#include "bem/galerkin/hat_curls.hpp"
#include "bem/space_curve.hpp"
#include "elasticity/pair_integrals.hpp"

namespace elastolab {

namespace {

constexpr int kPacksPerTask = 4;
constexpr std::size_t kRowBytes = 1u << 25;     ///< of rows that wait to be added: what a cache holds
constexpr int kLeastPacks = 8 * kPacksPerTask;  ///< whose rows wait, so that every thread has some

/// D = alpha sum P (2 c_b c_a^T - c_a c_b^T) + beta sum [c_a]^T (P I - Q) [c_b].
struct Factors {
    double alpha, beta;
};

/// A matrix to assemble: zero at first.
struct Wanted {
    Factors factors;
    Eigen::Ref<Eigen::MatrixXd> matrix;
};

/// The rows of the vertices of a pack of consecutive triangles, from their pairs with themselves and all later ones.
struct PackRows {
    int first = 0;  ///< position of its first triangle
    std::vector<int> vertices = {};
    std::size_t begin = 0;  ///< of its numbers in WaitingRows::numbers
};

/// Rows that wait to be added.
struct WaitingRows {
    std::vector<PackRows> packs;
    /// Of each matrix, pack by pack: [vertex of the mesh][vertex of the pack][3 x 3 by rows]; those of vertices whose
    /// triangles are all earlier are unset. All packs share one allocation: many small ones would have small pages.
    std::vector<Eigen::VectorXd> numbers;
};

class HypersingularAssembly {
public:
    HypersingularAssembly(const Boundary& boundary, double tolerance, std::span<Wanted> wanted)
        : boundary_(boundary),
          wanted_(wanted),
          n_(boundary.n_triangles()),
          order_(triangles_along_a_curve(boundary)),
          triangles_(triangles_of(boundary)),
          integrals_(triangles_, tolerance),
          last_(static_cast<std::size_t>(boundary.mesh().n_vertices()), 0) {
        for (const TriangleGeometry& T : triangles_) curls_.push_back(hat_curls(T));
        for (int position = 0; position < n_; ++position)
            for (int k = 0; k < 3; ++k) last_[vertex(position, k)] = position;
    }

    void run(Control& control) const {
        for (Wanted& wanted : wanted_) set_zero(wanted.matrix, control);
        const int n_packs = (n_ + integrals_.lanes() - 1) / integrals_.lanes();
        ZeroBuffers all_sums(kCurlNumbers * last_.size() * static_cast<std::size_t>(integrals_.lanes()));
        WaitingRows rows;
        rows.numbers.resize(wanted_.size());
        for (int first = 0; first < n_packs; first += packs_at_once()) {
            begin_rows(first, std::min(first + packs_at_once(), n_packs), rows);
            parallel_blocks(static_cast<int>(rows.packs.size()), kPacksPerTask, control, [&](int begin, int end) {
                std::vector<double> sums = all_sums.take();
                for (int i = begin; i < end; ++i) make_rows(rows.packs[static_cast<std::size_t>(i)], sums, rows);
                all_sums.give_back(std::move(sums));
            });
            for (std::size_t w = 0; w < wanted_.size(); ++w) add(rows, w, control);
        }
        for (Wanted& wanted : wanted_) add_transpose(wanted.matrix, control);
    }

private:
    static std::vector<TriangleGeometry> triangles_of(const Boundary& boundary) {
        std::vector<TriangleGeometry> triangles;
        for (int t = 0; t < boundary.n_triangles(); ++t) triangles.push_back(boundary.triangle(t));
        return triangles;
    }
    int triangle(int position) const { return order_[static_cast<std::size_t>(position)]; }
    std::size_t vertex(int position, int k) const {
        return static_cast<std::size_t>(boundary_.mesh().triangles(k, triangle(position)));
    }

    int packs_at_once() const {
        const std::size_t n_rows =
            3 * static_cast<std::size_t>(integrals_.lanes());  // at most: most corners are shared
        const std::size_t bytes = sizeof(double) * 9 * last_.size() * n_rows * wanted_.size();
        return static_cast<int>(std::clamp<std::size_t>(kRowBytes / bytes, kLeastPacks, 4096));
    }

    /// Which vertices the packs have rows of, and where; what rows held before is given up.
    void begin_rows(int first_pack, int end_pack, WaitingRows& rows) const {
        std::size_t n_numbers = 0;
        rows.packs.clear();
        for (int pack = first_pack; pack < end_pack; ++pack) {
            PackRows own{.first = pack * integrals_.lanes(), .begin = n_numbers};
            for (int position = own.first; position < end_of(own); ++position)
                for (int k = 0; k < 3; ++k) own.vertices.push_back(static_cast<int>(vertex(position, k)));
            std::sort(own.vertices.begin(), own.vertices.end());
            own.vertices.erase(std::unique(own.vertices.begin(), own.vertices.end()), own.vertices.end());
            n_numbers += 9 * own.vertices.size() * last_.size();
            rows.packs.push_back(std::move(own));
        }
        for (Eigen::VectorXd& numbers : rows.numbers)
            if (numbers.size() < static_cast<Eigen::Index>(n_numbers))
                numbers.resize(static_cast<Eigen::Index>(n_numbers));
    }

    int end_of(const PackRows& pack) const { return std::min(n_, pack.first + integrals_.lanes()); }

    /// The pairs of the pack's triangles with themselves and all later ones. `sums` are zero before and after.
    void make_rows(const PackRows& own, std::vector<double>& sums, WaitingRows& rows) const {
        const int first = own.first, end = end_of(own);
        const auto tests =
            std::span(order_).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
        const PairIntegrals::Pack pack = integrals_.pack(tests);
        for (int position = first; position < n_; ++position) add_field(pack, first, end, position, sums);
        contract(pack, own, sums, rows);
    }

    double* sums_of(std::vector<double>& sums, std::size_t vertex) const {
        return sums.data() + kCurlNumbers * static_cast<std::size_t>(integrals_.lanes()) * vertex;
    }

    void add_field(const PairIntegrals::Pack& pack, int first, int end, int position, std::vector<double>& sums) const {
        const int lanes = integrals_.lanes();
        double Q[kPairNumbers * kMaxLanes];
        integrals_.integrate(pack, triangle(position), false, Q);
        if (position < first + lanes)  // each pair once; that of a triangle with itself is half
            for (int lane = 0; lane < lanes; ++lane) {
                const int test = first + lane;
                const double share = test >= end || test > position ? 0.0 : test == position ? 0.5 : 1.0;
                for (int k = 0; k < kPairTensorNumbers; ++k) Q[k * lanes + lane] *= share;
            }
        const Eigen::Matrix3d& c = curls_[static_cast<std::size_t>(triangle(position))];
        const double curls[3][3] = {
            {c(0, 0), c(1, 0), c(2, 0)}, {c(0, 1), c(1, 1), c(2, 1)}, {c(0, 2), c(1, 2), c(2, 2)}};
        double* const into[3] = {sums_of(sums, vertex(position, 0)), sums_of(sums, vertex(position, 1)),
                                 sums_of(sums, vertex(position, 2))};
        kernels_.add_curls(Q, kHypersingularFactors, curls, into);
    }

    void contract(const PairIntegrals::Pack& pack, const PackRows& own, std::vector<double>& sums,
                  WaitingRows& rows) const {
        const auto lanes = static_cast<std::size_t>(integrals_.lanes());
        double curls[9 * kMaxLanes];
        std::size_t row_of[3 * kMaxLanes];
        for (std::size_t lane = 0; lane < lanes; ++lane)
            for (std::size_t k = 0; k < 3; ++k) {
                const Eigen::Matrix3d& c = curls_[static_cast<std::size_t>(pack.triangles[lane])];
                for (std::size_t i = 0; i < 3; ++i)
                    curls[(3 * k + i) * lanes + lane] = c(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
                const int v = boundary_.mesh().triangles(static_cast<Eigen::Index>(k), pack.triangles[lane]);
                const auto at = std::lower_bound(own.vertices.begin(), own.vertices.end(), v);
                row_of[3 * lane + k] = static_cast<std::size_t>(at - own.vertices.begin());
            }
        double blocks[27 * kMaxLanes];
        const std::size_t n_own = own.vertices.size(), n_tests = static_cast<std::size_t>(end_of(own) - own.first);
        for (std::size_t b = 0; b < last_.size(); ++b) {
            if (last_[b] < own.first) continue;
            for (std::size_t w = 0; w < wanted_.size(); ++w) {
                const Factors& factors = wanted_[w].factors;
                kernels_.contract_curls(factors.alpha, factors.beta, curls, sums_of(sums, b), blocks);
                double* row = rows.numbers[w].data() + own.begin + 9 * n_own * b;
                std::fill(row, row + 9 * n_own, 0.0);
                for (std::size_t lane = 0; lane < n_tests; ++lane)
                    for (std::size_t k = 0; k < 3; ++k)
                        for (std::size_t i = 0; i < 9; ++i)
                            row[9 * row_of[3 * lane + k] + i] += blocks[(9 * k + i) * lanes + lane];
            }
            std::fill_n(sums_of(sums, b), kCurlNumbers * lanes, 0.0);
        }
    }

    /// Each column of a matrix takes the packs in their order.
    void add(const WaitingRows& rows, std::size_t w, Control& control) const {
        Eigen::Ref<Eigen::MatrixXd>& D = wanted_[w].matrix;
        parallel_blocks(static_cast<int>(last_.size()), 16, control, [&](int begin, int end) {
            for (int b = begin; b < end; ++b)
                for (const PackRows& pack : rows.packs) {
                    if (last_[static_cast<std::size_t>(b)] < pack.first) continue;
                    const double* block =
                        rows.numbers[w].data() + pack.begin + 9 * pack.vertices.size() * static_cast<std::size_t>(b);
                    for (const int a : pack.vertices) {
                        for (int i = 0; i < 3; ++i)
                            for (int j = 0; j < 3; ++j) D(3 * a + i, 3 * b + j) += block[3 * i + j];
                        block += 9;
                    }
                }
        });
    }

    static void set_zero(Eigen::Ref<Eigen::MatrixXd> D, Control& control) {
        parallel_blocks(static_cast<int>(D.cols()), 64, control,
                        [&](int begin, int end) { D.middleCols(begin, end - begin).setZero(); });
    }

    static void add_transpose(Eigen::Ref<Eigen::MatrixXd> D, Control& control) {
        constexpr int kTile = 96;
        const int n = static_cast<int>(D.rows()), n_tiles = (n + kTile - 1) / kTile;
        parallel_blocks(n_tiles, 1, control, [&](int tile, int) {
            const int i = tile * kTile, rows = std::min(kTile, n - i);
            Eigen::MatrixXd sum;
            for (int j = i; j < n; j += kTile) {
                const int columns = std::min(kTile, n - j);
                sum = D.block(i, j, rows, columns) + D.block(j, i, columns, rows).transpose();
                D.block(i, j, rows, columns) = sum;
                D.block(j, i, columns, rows) = sum.transpose();
            }
        });
    }

    const Boundary& boundary_;
    std::span<Wanted> wanted_;
    int n_;
    std::vector<int> order_;
    std::vector<TriangleGeometry> triangles_;
    PairIntegrals integrals_;
    const PairKernels& kernels_ = best_pair_kernels();
    std::vector<Eigen::Matrix3d> curls_;
    std::vector<int> last_;  ///< last position of a triangle at each vertex
};

constexpr double kFactor = 0.25 * std::numbers::inv_pi;

}  // namespace

void assemble_hypersingular(const Boundary& boundary, const Material& material, double tolerance,
                            Eigen::Ref<Eigen::MatrixXd> D, Control& control) {
    assert(D.rows() == 3 * boundary.mesh().n_vertices() && D.cols() == D.rows());
    const double factor = kFactor * material.shear_modulus();
    Wanted wanted{{factor, factor / (1.0 - material.poisson_ratio)}, D};
    HypersingularAssembly(boundary, tolerance, std::span(&wanted, 1)).run(control);
}

HypersingularParts::HypersingularParts(const Boundary& boundary, double tolerance, Control& control) {
    const Eigen::Index n = 3 * boundary.mesh().n_vertices();
    without_nu.resize(n, n);
    with_nu.resize(n, n);
    std::array<Wanted, 2> wanted{Wanted{{kFactor, 0.0}, without_nu}, Wanted{{0.0, kFactor}, with_nu}};
    HypersingularAssembly(boundary, tolerance, wanted).run(control);
}

void HypersingularParts::evaluate(const Material& material, Eigen::Ref<Eigen::MatrixXd> D) const {
    const double mu = material.shear_modulus();
    D = mu * without_nu + (mu / (1.0 - material.poisson_ratio)) * with_nu;
}

}  // namespace elastolab
