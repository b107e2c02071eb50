#include "bem/galerkin/given_loads.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "bem/given_loads.hpp"
#include "elasticity/rigid_motion.hpp"

namespace elastolab {

namespace {

/// Vertices and triangles of a block of the double layer.
constexpr int kGivenVertices = 64, kGivenTriangles = 256;

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

/// K^T g for tractions constant on some triangles; rows node-major.
Eigen::MatrixXd transposed_double_layer(const std::shared_ptr<const BoundaryPairs>& pairs, const Material& material,
                                        const MeanTractions& given, Control& control) {
    const auto vertex_tree = pairs->cluster_vertices(kGivenVertices);
    const auto triangle_tree = pairs->cluster_triangles(given.triangles, kGivenTriangles);
    const DoubleLayerEntries K(pairs, given.triangles, *triangle_tree, vertex_tree, material);
    const int n_vertices = vertex_tree->size(), n_triangles = static_cast<int>(given.triangles.size());
    Eigen::MatrixXd ordered(given.values.rows(), given.values.cols()), f(3 * n_vertices, given.values.cols());
    for (int i = 0; i < n_triangles; ++i)
        ordered.middleRows<3>(3 * i) =
            given.values.middleRows<3>(3 * triangle_tree->order()[static_cast<std::size_t>(i)]);
    parallel_blocks(n_vertices, kGivenVertices, control, [&](int begin, int end) {
        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * (end - begin), ordered.cols()), block;
        for (int first = 0; first < n_triangles; first += kGivenTriangles) {
            const int last = std::min(n_triangles, first + kGivenTriangles);
            block.resize(3 * (last - first), 3 * (end - begin));
            K.fill({first, last}, {begin, end}, block);
            sum.noalias() += block.transpose() * ordered.middleRows(3 * first, 3 * (last - first));
        }
        for (int i = begin; i < end; ++i)
            f.middleRows<3>(3 * vertex_tree->order()[static_cast<std::size_t>(i)]) = sum.middleRows<3>(3 * (i - begin));
    });
    return f;
}

}  // namespace

Eigen::MatrixXd given_nodal_forces(const std::shared_ptr<const BoundaryPairs>& pairs, const Material& material,
                                   std::span<const UnitLoad> loads, Control& control) {
    const Boundary& boundary = pairs->boundary();
    Eigen::MatrixXd f = tested_with_hats(boundary, loads);
    if (loads.empty()) return f;
    // K is freed of the rigid motions of the body, as in the equations.
    Eigen::MatrixXd layer = transposed_double_layer(pairs, material, MeanTractions(boundary, loads), control);
    const Eigen::MatrixXd modes = rigid_modes(boundary.mesh().vertices);
    layer -= modes * (modes.transpose() * layer).eval();
    return f - layer;
}

Eigen::MatrixXd given_single_layer(const std::shared_ptr<const BoundaryPairs>& pairs, const ClosedSurfaces& surfaces,
                                   const GalerkinTractions& tractions, const Material& material,
                                   std::span<const UnitLoad> loads, Control& control) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(tractions.size(), std::ssize(loads));
    if (loads.empty() || tractions.size() == 0) return rows;
    const MeanTractions given(pairs->boundary(), loads);
    std::vector<int> tests = tractions.triangles;
    for (const int s : tractions.free_surfaces) {
        const std::vector<int>& all = surfaces.triangles[static_cast<std::size_t>(s)];
        tests.insert(tests.end(), all.begin(), all.end());
    }
    const SingleLayerEntries V(pairs, tests, given.triangles, material);
    const int n_given = static_cast<int>(given.triangles.size());
    Eigen::MatrixXd all(3 * std::ssize(tests), rows.cols());
    parallel_blocks(static_cast<int>(tests.size()), 32, control, [&](int begin, int end) {
        Eigen::MatrixXd block(3 * (end - begin), 3 * n_given);
        V.fill({begin, end}, {0, n_given}, block);
        all.middleRows(3 * begin, block.rows()).noalias() = block * given.values;
    });
    const Eigen::Index n_single = 3 * std::ssize(tractions.triangles);
    rows.topRows(n_single) = all.topRows(n_single);
    Eigen::Index from = n_single, to = n_single;
    for (const int s : tractions.free_surfaces) {
        const Eigen::MatrixXd fields =
            rigid_tractions(pairs->boundary(), surfaces.triangles[static_cast<std::size_t>(s)]);
        rows.middleRows(to, 6) = fields.transpose() * all.middleRows(from, fields.rows());
        from += fields.rows();
        to += 6;
    }
    return rows;
}

}  // namespace elastolab
