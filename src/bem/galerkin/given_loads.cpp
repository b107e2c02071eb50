#include "bem/galerkin/given_loads.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

#include "base/parallel.hpp"
#include "bem/given_loads.hpp"
#include "bem/space_curve.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

/// The loaded triangles and, for each load, the mean traction on each of them: 3*triangles.size() x n_loads.
struct MeanTractions {
    std::vector<int> triangles;
    Eigen::MatrixXd values;

    MeanTractions(const Boundary& boundary, std::span<const UnitLoad> loads) {
        const std::vector<GivenTractions> kinds = given_tractions(boundary, loads);
        for (const GivenTractions& given : kinds)
            for (const auto& element : given.elements.elements) triangles.push_back(element.triangle);
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        std::vector<int> place(static_cast<std::size_t>(boundary.n_triangles()), -1);
        for (std::size_t i = 0; i < triangles.size(); ++i)
            place[static_cast<std::size_t>(triangles[i])] = static_cast<int>(i);
        values.setZero(3 * std::ssize(triangles), std::ssize(loads));
        for (const GivenTractions& given : kinds) {
            const int n_corners = given.elements.order == Elements::Order::linear ? 3 : 1;
            for (const auto& element : given.elements.elements)
                for (int corner = 0; corner < n_corners; ++corner)
                    for (std::size_t c = 0; c < given.columns.size(); ++c)
                        values.block<3, 1>(3 * place[static_cast<std::size_t>(element.triangle)], given.columns[c]) +=
                            given.coefficients.block<3, 1>(3 * element.slots[static_cast<std::size_t>(corner)],
                                                           static_cast<Eigen::Index>(c)) /
                            n_corners;
        }
    }
};

/// B^T g, exactly: int phi_a g over each triangle.
Eigen::MatrixXd tested_with_hats(const Boundary& boundary, std::span<const UnitLoad> loads) {
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(boundary.mesh().vertices.size(), std::ssize(loads));
    for (const GivenTractions& given : given_tractions(boundary, loads)) {
        const bool linear = given.elements.order == Elements::Order::linear;
        for (const auto& element : given.elements.elements)
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < (linear ? 3u : 1u); ++b) {
                    const double weight =
                        boundary.area(element.triangle) * (!linear ? 1.0 / 3.0 : (a == b ? 2.0 : 1.0) / 12.0);
                    const int v = boundary.mesh().triangles(static_cast<Eigen::Index>(a), element.triangle);
                    for (std::size_t c = 0; c < given.columns.size(); ++c)
                        f.block<3, 1>(3 * v, given.columns[c]) +=
                            weight * given.coefficients.block<3, 1>(3 * element.slots[b], static_cast<Eigen::Index>(c));
                }
    }
    return f;
}

/// K^T g at the vertices and V g on every triangle, for tractions g constant on some triangles: each of their pairs
/// with any triangle is integrated once.
class LayersOfLoads {
public:
    LayersOfLoads(const BoundaryPairs& pairs, const Material& material, const MeanTractions& given)
        : pairs_(pairs),
          given_(given),
          n_vertices_(pairs.boundary().mesh().n_vertices()),
          n_triangles_(pairs.boundary().n_triangles()),
          nu_(material.poisson_ratio),
          double_factor_(1.0 / (8.0 * std::numbers::pi * (1.0 - nu_))),
          single_factor_(0.5 * double_factor_ / material.shear_modulus()),
          column_of_(static_cast<std::size_t>(n_triangles_), -1),
          order_(triangles_along_a_curve(pairs.boundary(), given.triangles)) {
        for (std::size_t i = 0; i < given.triangles.size(); ++i)
            column_of_[static_cast<std::size_t>(given.triangles[i])] = static_cast<Eigen::Index>(i);
    }

    /// The vertices' rows, then the triangles'. The same whatever the number of threads.
    Eigen::MatrixXd sum(Control& control) const {
        const int n_loaded = static_cast<int>(order_.size());
        Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(3 * (n_vertices_ + n_triangles_), given_.values.cols());
        const auto bytes = static_cast<std::size_t>(sums.size()) * sizeof(double);
        std::vector<Eigen::MatrixXd> parts(
            bytes > 0 ? std::clamp(kPartBytes / bytes, kLeastTasksAtOnce, kMostTasksAtOnce) : 1);
        const int at_once = static_cast<int>(parts.size()) * kTrianglesOfATask;
        for (int first = 0; first < n_loaded; first += at_once) {
            const int count = std::min(n_loaded - first, at_once);
            parallel_blocks(count, kTrianglesOfATask, control, [&](int begin, int end) {
                Eigen::MatrixXd& part = parts[static_cast<std::size_t>(begin / kTrianglesOfATask)];
                part.setZero(sums.rows(), sums.cols());
                add_pairs(first + begin, first + end, part);
            });
            for (int task = 0; task * kTrianglesOfATask < count; ++task) sums += parts[static_cast<std::size_t>(task)];
        }
        return sums;
    }

private:
    static constexpr int kTrianglesOfATask = 32;
    /// What tasks sum waits to be added in their order.
    static constexpr std::size_t kPartBytes = 32u << 20, kLeastTasksAtOnce = 4, kMostTasksAtOnce = 16;

    auto traction(int triangle, Eigen::Index load) const {
        return given_.values.block<3, 1>(3 * column_of_[static_cast<std::size_t>(triangle)], load);
    }

    void add_pairs(int begin, int end, Eigen::MatrixXd& sums) const {
        const PairIntegrals& integrals = pairs_.integrals();
        for (int first = begin; first < end; first += integrals.lanes()) {
            const auto tests = std::span(order_).subspan(
                static_cast<std::size_t>(first), static_cast<std::size_t>(std::min(integrals.lanes(), end - first)));
            const PairIntegrals::Pack pack = integrals.pack(tests);
            for (int field = 0; field < n_triangles_; ++field) {
                double numbers[kPairNumbers * kMaxLanes];
                integrals.integrate(pack, field, true, numbers);
                for (Eigen::Index load = 0; load < sums.cols(); ++load) add(tests, field, numbers, load, sums);
            }
            for (const int t : tests) add_free_term(t, sums);
        }
    }

    /// The formulas of bem/galerkin/traction_rows.hpp.
    void add(std::span<const int> tests, int field, const double* numbers, Eigen::Index load,
             Eigen::MatrixXd& sums) const {
        const auto lanes = static_cast<std::size_t>(pairs_.integrals().lanes());
        Eigen::Vector3d traces = Eigen::Vector3d::Zero(), tensors = traces;  // tr Q g and Q g
        Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();                   // a column for each corner
        for (std::size_t lane = 0; lane < tests.size(); ++lane) {
            const auto q = [&](std::size_t k) { return numbers[k * lanes + lane]; };
            const Eigen::Vector3d g = traction(tests[lane], load);
            traces += (q(0) + q(1) + q(2)) * g;
            tensors += Eigen::Vector3d(q(0) * g[0] + q(3) * g[1] + q(4) * g[2], q(3) * g[0] + q(1) * g[1] + q(5) * g[2],
                                       q(4) * g[0] + q(5) * g[1] + q(2) * g[2]);
            for (std::size_t k = 0; k < 3; ++k) normals.col(static_cast<Eigen::Index>(k)) += q(6 + k) * g;
        }
        sums.col(load).segment<3>(3 * (n_vertices_ + field)) += single_factor_ * (tensors + (3.0 - 4.0 * nu_) * traces);
        const Eigen::Vector3d curled = double_factor_ * (tensors + (1.0 - 2.0 * nu_) * traces);
        const Eigen::Matrix3d& curls = pairs_.curls(field);
        for (int k = 0; k < 3; ++k)
            sums.col(load).segment<3>(3 * pairs_.boundary().mesh().triangles(k, field)) +=
                curled.cross(curls.col(k)) - normals.col(k) / (4.0 * std::numbers::pi);
    }

    void add_free_term(int triangle, Eigen::MatrixXd& sums) const {
        for (Eigen::Index load = 0; load < sums.cols(); ++load)
            for (const int v : pairs_.boundary().mesh().triangles.col(triangle))
                sums.col(load).segment<3>(3 * v) += pairs_.boundary().area(triangle) / 6.0 * traction(triangle, load);
    }

    const BoundaryPairs& pairs_;
    const MeanTractions& given_;
    int n_vertices_, n_triangles_;
    double nu_, double_factor_, single_factor_;
    std::vector<Eigen::Index> column_of_;
    std::vector<int> order_;
};

}  // namespace

Eigen::MatrixXd given_layers(const BoundaryPairs& pairs, const Material& material, std::span<const UnitLoad> loads,
                             Control& control) {
    const Boundary& boundary = pairs.boundary();
    const MeanTractions given(boundary, loads);
    Eigen::MatrixXd sums = LayersOfLoads(pairs, material, given).sum(control);
    // K is freed of the rigid motions of the body, as in the equations.
    auto layer = sums.topRows(boundary.mesh().vertices.size());
    const Eigen::MatrixXd modes = rigid_modes(boundary.mesh().vertices);
    layer -= modes * (modes.transpose() * layer).eval();
    layer = tested_with_hats(boundary, loads) - layer;
    return sums;
}

Eigen::MatrixXd given_single_layer(const Eigen::MatrixXd& layers, const Boundary& boundary,
                                   const ClosedSurfaces& surfaces, const GalerkinTractions& tractions) {
    const auto of_triangles = layers.bottomRows(3 * boundary.n_triangles());
    Eigen::MatrixXd rows(tractions.size(), layers.cols());
    Eigen::Index to = 0;
    for (const int t : tractions.triangles) {
        rows.middleRows<3>(to) = of_triangles.middleRows<3>(3 * t);
        to += 3;
    }
    for (const int s : tractions.free_surfaces) {
        const std::vector<int>& triangles = surfaces.triangles[static_cast<std::size_t>(s)];
        const Eigen::MatrixXd fields = rigid_tractions(boundary, triangles);
        rows.middleRows<6>(to).setZero();
        for (std::size_t i = 0; i < triangles.size(); ++i)
            rows.middleRows<6>(to) += fields.middleRows<3>(3 * static_cast<Eigen::Index>(i)).transpose() *
                                      of_triangles.middleRows<3>(3 * triangles[i]);
        to += 6;
    }
    return rows;
}

}  // namespace elastolab
