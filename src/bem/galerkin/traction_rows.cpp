#include "bem/galerkin/traction_rows.hpp"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/zero_buffers.hpp"
#include "bem/galerkin/hat_curls.hpp"
#include "bem/space_curve.hpp"
#include "elasticity/pair_integrals.hpp"

namespace elastolab {

namespace {

/// Integrates some test triangles at once with all triangles of the surface.
class RowAssembly {
public:
    RowAssembly(const Boundary& boundary, std::span<const int> tests, const Material& material, double tolerance)
        : boundary_(boundary),
          tests_(tests),
          nu_(material.poisson_ratio),
          mu_(material.shear_modulus()),
          row_of_(static_cast<std::size_t>(boundary.n_triangles()), -1),
          triangles_(triangles_of(boundary)),
          integrals_(triangles_, tolerance) {
        for (std::size_t i = 0; i < tests.size(); ++i)
            row_of_[static_cast<std::size_t>(tests[i])] = static_cast<int>(i);
        order_ = triangles_along_a_curve(boundary, tests);
    }

    int n_packs() const { return (static_cast<int>(order_.size()) + integrals_.lanes() - 1) / integrals_.lanes(); }

    /// Numbers that run() adds up.
    std::size_t n_sums() const {
        return (kCurlNumbers + 1) * static_cast<std::size_t>(integrals_.lanes() * boundary_.mesh().n_vertices());
    }

    /// Both layers. `memory`: n_sums() zeros, before and after.
    void run(int number, std::vector<double>& memory, TractionRows& rows) const {
        const std::span<const int> tests = tests_of(number);
        const auto lanes = static_cast<std::size_t>(integrals_.lanes());
        const PairIntegrals::Pack pack = integrals_.pack(tests);
        Sums sums(boundary_.mesh().vertices.cols(), lanes, memory);
        for (int s = 0; s < boundary_.n_triangles(); ++s) {
            double numbers[kPairNumbers * kMaxLanes];
            integrals_.integrate(pack, s, true, numbers);
            write_single(tests, s, numbers, rows.single_layer);
            add_field(s, numbers, sums);
        }
        for (std::size_t lane = 0; lane < tests.size(); ++lane)
            write_double(tests[lane], lane, sums, rows.double_layer);
        std::fill(memory.begin(), memory.end(), 0.0);
    }

    /// The single layer.
    void run(int number, Eigen::MatrixXd& V) const {
        const std::span<const int> tests = tests_of(number);
        const PairIntegrals::Pack pack = integrals_.pack(tests);
        for (const int s : order_) {
            double numbers[kPairNumbers * kMaxLanes];
            integrals_.integrate(pack, s, false, numbers);
            write_single(tests, s, numbers, V);
        }
    }

private:
    std::span<const int> tests_of(int number) const {
        const auto lanes = static_cast<std::size_t>(integrals_.lanes());
        const std::size_t first = static_cast<std::size_t>(number) * lanes;
        return std::span(order_).subspan(first, std::min(lanes, order_.size() - first));
    }

    /// What the vertices have collected: [vertex][number][lane].
    struct Sums {
        Sums(Eigen::Index n_vertices, std::size_t n_lanes, std::vector<double>& memory)
            : lanes(n_lanes),
              curls(memory.data()),
              normals(memory.data() + kCurlNumbers * n_lanes * static_cast<std::size_t>(n_vertices)) {}
        double* curls_of(int vertex) const { return curls + kCurlNumbers * lanes * static_cast<std::size_t>(vertex); }
        double* normals_of(int vertex) const { return normals + lanes * static_cast<std::size_t>(vertex); }
        std::size_t lanes;
        double *curls, *normals;
    };

    static std::vector<TriangleGeometry> triangles_of(const Boundary& boundary) {
        std::vector<TriangleGeometry> triangles;
        for (int t = 0; t < boundary.n_triangles(); ++t) triangles.push_back(boundary.triangle(t));
        return triangles;
    }

    /// iint U, for test triangles at or after the field triangle in the list: the others are its transpose.
    void write_single(std::span<const int> tests, int field, const double* numbers, Eigen::MatrixXd& V) const {
        const int column = row_of_[static_cast<std::size_t>(field)], lanes = integrals_.lanes();
        if (column < 0) return;
        const double factor = 1.0 / (16.0 * std::numbers::pi * mu_ * (1.0 - nu_));
        for (std::size_t lane = 0; lane < tests.size(); ++lane) {
            const int row = row_of_[static_cast<std::size_t>(tests[lane])];
            if (row < column) continue;
            const auto q = [&](int k) { return factor * numbers[static_cast<std::size_t>(k * lanes) + lane]; };
            Eigen::Matrix3d block;
            block << q(0), q(3), q(4), q(3), q(1), q(5), q(4), q(5), q(2);
            block.diagonal().array() += (3.0 - 4.0 * nu_) * block.trace();
            V.block<3, 3>(3 * row, 3 * column) = block;
            V.block<3, 3>(3 * column, 3 * row) = block.transpose();
        }
    }

    void add_field(int field, const double* numbers, const Sums& sums) const {
        const int lanes = integrals_.lanes();
        const double* normal = numbers + kPairTensorNumbers * lanes;
        const Eigen::Matrix3d c = hat_curls(triangles_[static_cast<std::size_t>(field)]);
        const double curls[3][3] = {
            {c(0, 0), c(1, 0), c(2, 0)}, {c(0, 1), c(1, 1), c(2, 1)}, {c(0, 2), c(1, 2), c(2, 2)}};
        double* into[3];
        for (int k = 0; k < 3; ++k) {
            const int vertex = boundary_.mesh().triangles(k, field);
            into[k] = sums.curls_of(vertex);
            for (int lane = 0; lane < lanes; ++lane) sums.normals_of(vertex)[lane] += normal[k * lanes + lane];
        }
        kernels_.add_curls(numbers, double_layer_factors(nu_), curls, into);
    }

    void write_double(int test, std::size_t lane, const Sums& sums, Eigen::MatrixXd& K) const {
        const int row = 3 * row_of_[static_cast<std::size_t>(test)];
        const double pi = std::numbers::pi, factor = 1.0 / (8.0 * pi * (1.0 - nu_));
        for (int b = 0; b < boundary_.mesh().n_vertices(); ++b) {
            const double* M = sums.curls_of(b) + 3 * sums.lanes + lane;
            Eigen::Matrix3d block;
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i) block(i, j) = factor * M[static_cast<std::size_t>(3 * j + i) * sums.lanes];
            block.diagonal().array() -= sums.normals_of(b)[lane] / (4.0 * pi);
            K.block<3, 3>(row, 3 * b) = block;
        }
        for (int k = 0; k < 3; ++k)
            K.block<3, 3>(row, 3 * boundary_.mesh().triangles(k, test)).diagonal().array() +=
                boundary_.area(test) / 6.0;
    }

    const Boundary& boundary_;
    std::span<const int> tests_;
    double nu_, mu_;
    std::vector<int> row_of_, order_;
    std::vector<TriangleGeometry> triangles_;
    PairIntegrals integrals_;
    const PairKernels& kernels_ = best_pair_kernels();
};

}  // namespace

TractionRows assemble_traction_rows(const Boundary& boundary, std::span<const int> triangles, const Material& material,
                                    double tolerance, Control& control) {
    const auto n = static_cast<Eigen::Index>(3 * triangles.size());
    TractionRows rows{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, 3 * boundary.mesh().n_vertices())};
    if (triangles.empty()) return rows;
    const RowAssembly assembly(boundary, triangles, material, tolerance);
    ZeroBuffers buffers(assembly.n_sums());
    parallel_blocks(assembly.n_packs(), 1, control, [&](int begin, int end) {
        std::vector<double> memory = buffers.take();
        for (int pack = begin; pack < end; ++pack) assembly.run(pack, memory, rows);
        buffers.give_back(std::move(memory));
    });
    return rows;
}

Eigen::MatrixXd assemble_single_layer(const Boundary& boundary, std::span<const int> triangles,
                                      const Material& material, double tolerance, Control& control) {
    const auto n = static_cast<Eigen::Index>(3 * triangles.size());
    Eigen::MatrixXd V(n, n);
    if (triangles.empty()) return V;
    const RowAssembly assembly(boundary, triangles, material, tolerance);
    parallel_blocks(assembly.n_packs(), 1, control, [&](int begin, int end) {
        for (int pack = begin; pack < end; ++pack) assembly.run(pack, V);
    });
    return V;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> traction_mass(const Boundary& boundary, std::span<const int> triangles) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t row = 0; row < triangles.size(); ++row)
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i)
                entries.emplace_back(static_cast<int>(3 * row) + i,
                                     3 * boundary.mesh().triangles(k, triangles[row]) + i,
                                     boundary.area(triangles[row]) / 3.0);
    Eigen::SparseMatrix<double, Eigen::RowMajor> mass(static_cast<Eigen::Index>(3 * triangles.size()),
                                                      3 * boundary.mesh().n_vertices());
    mass.setFromTriplets(entries.begin(), entries.end());
    return mass;
}

}  // namespace elastolab
