#include "bem/galerkin/layers_of_tractions.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>

#include "base/blas.hpp"
#include "base/parallel.hpp"
#include "bem/hierarchical/interaction_lists.hpp"
#include "bem/hierarchical/interpolation_nodes.hpp"
#include "bem/hierarchical/node_potentials.hpp"
#include "elasticity/triangle_rules.hpp"

namespace elastolab {

namespace {

constexpr int kTrianglesOfACluster = 32;
/// Clusters are far when the radius of each is at most this part of the distance of its middle from the other.
constexpr double kMostRadius = 0.5;
/// And when their triangles are, for the rule on each: factor * distance^-exponent bounds its error (by 4000 pairs of
/// random shape at each distance of their centroids from 1.5 to 5), the distance in units of the sum of both radii.
constexpr int kRule = 5;
constexpr double kRuleFactor = 1.2e-2, kRuleExponent = 10.0;
/// Time of a pair of nodes over that of a pair of triangles that is integrated. The fastest of 0.04, 0.08 and 0.12 for
/// a surface of 16 386 vertices under a body force, and of the first two for 6726.
constexpr double kNodePrice = 0.08;

/// What tractions do to one triangle: sum of tr Q g, of Q g, and of q_k g for each corner k, with Q and q the tensor
/// and normal numbers of elasticity/close_pairs.hpp. As many as the potentials that the far part of them comes from.
constexpr int kTrace = 0, kTensor = 3, kNormal = 6, kNumbers = kNodePotentials;

/// Triangles in clusters, with what is needed to tell which are far from each other.
struct Clusters {
    std::shared_ptr<const ClusterTree> tree;
    std::vector<int> ordered;  ///< triangle at each position
    std::vector<double> radius, largest_triangle;
    std::vector<InterpolationNodes> nodes;
    std::vector<int> parent;

    Clusters(const BoundaryPairs& pairs, const std::vector<int>& triangles, double tolerance)
        : tree(pairs.cluster_triangles(triangles, kTrianglesOfACluster)), ordered(in_order(triangles, *tree)) {
        parent.assign(tree->clusters().size(), -1);
        for (std::size_t c = 0; c < tree->clusters().size(); ++c) {
            const ClusterTree::Cluster& cluster = tree->clusters()[c];
            radius.push_back(0.5 * cluster.box.diagonal().norm());
            double largest = 0.0;
            for (const int t : triangles_of(static_cast<int>(c)))
                largest = std::max(largest, pairs.integrals().radius(t));
            largest_triangle.push_back(largest);
            nodes.emplace_back(cluster.box, radius.back() / kMostRadius, tolerance);
            if (!cluster.is_leaf())
                for (const int child : {cluster.first_child, cluster.first_child + 1})
                    parent[static_cast<std::size_t>(child)] = static_cast<int>(c);
        }
    }
    std::span<const int> triangles_of(int cluster) const {
        const PositionRange range = tree->cluster(cluster).range;
        return std::span(ordered).subspan(static_cast<std::size_t>(range.begin),
                                          static_cast<std::size_t>(range.size()));
    }
    const InterpolationNodes& nodes_of(int cluster) const { return nodes[static_cast<std::size_t>(cluster)]; }
};

/// least_gap: of triangles, in units of the sum of their radii.
Interaction judge(const Clusters& fields, const Clusters& sources, double least_gap, int field, int source) {
    const auto f = static_cast<std::size_t>(field), s = static_cast<std::size_t>(source);
    const double distance = (fields.nodes[f].middle() - sources.nodes[s].middle()).norm();
    const double gap = distance - fields.radius[f] - sources.radius[s];
    if (gap < least_gap * (fields.largest_triangle[f] + sources.largest_triangle[s]) ||
        distance < fields.radius[f] / kMostRadius + sources.radius[s] ||
        distance < sources.radius[s] / kMostRadius + fields.radius[f])
        return Interaction::split;
    const double n_nodes = static_cast<double>(fields.nodes[f].size()) * sources.nodes[s].size();
    const double n_pairs = static_cast<double>(fields.triangles_of(field).size()) *
                           static_cast<double>(sources.triangles_of(source).size());
    return kNodePrice * n_nodes < n_pairs ? Interaction::far : Interaction::near;
}

/// int phi_k L over some triangles, for each polynomial L of some nodes (rows) and each hat phi_k of each triangle.
Eigen::MatrixXd hat_moments(const BoundaryPairs& pairs, const InterpolationNodes& nodes,
                            std::span<const int> triangles) {
    const TriangleRule& rule = triangle_rule(kRule);
    const auto n_points = static_cast<Eigen::Index>(rule.points.size());
    Eigen::MatrixXd hats(n_points, 3);
    for (Eigen::Index q = 0; q < n_points; ++q)
        for (int k = 0; k < 3; ++k) hats(q, k) = rule.points[static_cast<std::size_t>(q)][static_cast<std::size_t>(k)];
    const Eigen::Map<const Eigen::VectorXd> weights(rule.weights.data(), n_points);
    const SurfaceMesh& mesh = pairs.boundary().mesh();
    Eigen::MatrixXd moments(nodes.size(), 3 * std::ssize(triangles));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Eigen::Matrix3d corners = mesh.vertices(Eigen::all, mesh.triangles.col(triangles[i]));
        moments.middleCols<3>(3 * static_cast<Eigen::Index>(i)).noalias() =
            nodes.polynomials(corners * hats.transpose()) *
            (pairs.boundary().area(triangles[i]) * (weights.asDiagonal() * hats));
    }
    return moments;
}

class LayersOfTractions {
public:
    /// loaded: the triangles that carry tractions.
    LayersOfTractions(const BoundaryPairs& pairs, const std::vector<int>& loaded, const LayerOptions& options)
        : pairs_(pairs),
          integrals_(options.near),
          sources_(pairs, loaded, options.far_tolerance),
          fields_(pairs, all_triangles(pairs.boundary()), options.far_tolerance),
          lists_(*fields_.tree, *sources_.tree,
                 [&, gap = std::pow(kRuleFactor / options.far_tolerance, 1.0 / kRuleExponent)](int field, int source) {
                     return judge(fields_, sources_, gap, field, source);
                 }),
          row_of_(static_cast<std::size_t>(pairs.boundary().n_triangles()), -1) {
        for (std::size_t i = 0; i < loaded.size(); ++i)
            row_of_[static_cast<std::size_t>(loaded[i])] = 3 * static_cast<Eigen::Index>(i);
    }

    /// Bytes that each load takes on the way.
    std::size_t bytes_of_a_load() const {
        std::size_t n_nodes = 0;
        for (std::size_t c = 0; c < lists_.far.size(); ++c)
            if (!lists_.far[c].empty()) n_nodes += static_cast<std::size_t>(fields_.nodes[c].size());
        return sizeof(double) * kNumbers * n_nodes;
    }

    /// The numbers of each triangle: kNumbers*n_triangles x n_loads. tractions: three rows for each loaded triangle.
    Eigen::MatrixXd numbers(const Eigen::MatrixXd& tractions, Control& control) const {
        const SerialBlas serial;
        const std::vector<Eigen::MatrixXd> potentials = far_potentials(far_strengths(tractions, control), control);
        Eigen::MatrixXd numbers = Eigen::MatrixXd::Zero(kNumbers * pairs_.boundary().n_triangles(), tractions.cols());
        const std::vector<int>& leaves = fields_.tree->leaves();
        parallel_blocks(static_cast<int>(leaves.size()), 1, control, [&](int i, int) {
            const int leaf = leaves[static_cast<std::size_t>(i)];
            for (const int source : lists_.near[static_cast<std::size_t>(leaf)])
                add_near(leaf, source, tractions, numbers);
            for (int c = leaf; c >= 0; c = fields_.parent[static_cast<std::size_t>(c)])
                if (const Eigen::MatrixXd& far = potentials[static_cast<std::size_t>(c)]; far.size() > 0)
                    add_far(leaf, fields_.nodes_of(c), far, numbers);
        });
        return numbers;
    }

private:
    static std::vector<int> all_triangles(const Boundary& boundary) {
        std::vector<int> all(static_cast<std::size_t>(boundary.n_triangles()));
        std::iota(all.begin(), all.end(), 0);
        return all;
    }

    auto traction_of(int triangle, Eigen::Index load, const Eigen::MatrixXd& tractions) const {
        return tractions.block<3, 1>(row_of_[static_cast<std::size_t>(triangle)], load);
    }

    /// Forces at the nodes of each source that is far from some cluster, which act there as its tractions do: n_nodes x
    /// 3*n_loads.
    std::vector<Eigen::MatrixXd> far_strengths(const Eigen::MatrixXd& tractions, Control& control) const {
        const Eigen::Index n_loads = tractions.cols();
        std::vector<char> used(sources_.tree->clusters().size(), 0);
        for (const std::vector<int>& list : lists_.far)
            for (const int source : list) used[static_cast<std::size_t>(source)] = 1;
        std::vector<Eigen::MatrixXd> strengths(used.size());
        parallel_blocks(static_cast<int>(used.size()), 1, control, [&](int source, int) {
            if (!used[static_cast<std::size_t>(source)]) return;
            const InterpolationNodes& nodes = sources_.nodes_of(source);
            Eigen::MatrixXd& sum = strengths[static_cast<std::size_t>(source)];
            sum.setZero(nodes.size(), 3 * n_loads);
            std::span<const int> rest = sources_.triangles_of(source);
            while (!rest.empty()) {
                const std::span<const int> some = rest.first(std::min<std::size_t>(rest.size(), kTrianglesOfACluster));
                rest = rest.subspan(some.size());
                const Eigen::MatrixXd moments = hat_moments(pairs_, nodes, some);
                Eigen::MatrixXd g(moments.cols(), 3 * n_loads);  // the same for each hat: they add up to one
                for (Eigen::Index i = 0; i < g.rows(); ++i)
                    for (Eigen::Index load = 0; load < n_loads; ++load)
                        g.block<1, 3>(i, 3 * load) =
                            traction_of(some[static_cast<std::size_t>(i / 3)], load, tractions).transpose();
                sum.noalias() += moments * g;
            }
        });
        return strengths;
    }

    /// What these forces do at the nodes of each cluster of fields: n_nodes x kNumbers*n_loads, or empty.
    std::vector<Eigen::MatrixXd> far_potentials(const std::vector<Eigen::MatrixXd>& strengths, Control& control) const {
        std::vector<Eigen::MatrixXd> potentials(lists_.far.size());
        parallel_blocks(static_cast<int>(potentials.size()), 1, control, [&](int field, int) {
            const std::vector<int>& list = lists_.far[static_cast<std::size_t>(field)];
            if (list.empty()) return;
            const InterpolationNodes& nodes = fields_.nodes_of(field);
            Eigen::MatrixXd& sum = potentials[static_cast<std::size_t>(field)];
            sum.setZero(nodes.size(), kNumbers / 3 * strengths[static_cast<std::size_t>(list.front())].cols());
            for (const int source : list)
                add_node_potentials(nodes, sources_.nodes_of(source), strengths[static_cast<std::size_t>(source)], sum);
        });
        return potentials;
    }

    /// From the potentials at nodes around a leaf to its triangles.
    void add_far(int leaf, const InterpolationNodes& nodes, const Eigen::MatrixXd& potentials,
                 Eigen::MatrixXd& numbers) const {
        const std::span<const int> triangles = fields_.triangles_of(leaf);
        const Eigen::MatrixXd of_hats = hat_moments(pairs_, nodes, triangles).transpose() * potentials;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const double(&normal)[3] = pairs_.triangle(triangles[i]).n;
            for (Eigen::Index load = 0; load < numbers.cols(); ++load) {
                auto own = numbers.col(load).segment<kNumbers>(kNumbers * triangles[i]);
                for (int k = 0; k < 3; ++k) {
                    const auto values =
                        of_hats.row(3 * static_cast<Eigen::Index>(i) + k).segment<kNumbers>(kNumbers * load);
                    own.segment<kNormal>(0) += values.head<kNormal>().transpose();
                    for (int j = 0; j < 3; ++j)
                        own.segment<3>(kNormal + 3 * k) += normal[j] * values.segment<3>(kNormal + 3 * j).transpose();
                }
            }
        }
    }

    void add_near(int leaf, int source, const Eigen::MatrixXd& tractions, Eigen::MatrixXd& numbers) const {
        const auto lanes = static_cast<std::size_t>(integrals_.lanes());
        std::span<const int> rest = sources_.triangles_of(source);
        while (!rest.empty()) {
            const std::span<const int> tests = rest.first(std::min(rest.size(), lanes));
            rest = rest.subspan(tests.size());
            const PairIntegrals::Pack pack = integrals_.pack(tests);
            for (const int field : fields_.triangles_of(leaf)) {
                double values[kPairNumbers * kMaxLanes];
                integrals_.integrate(pack, field, true, values);
                for (Eigen::Index load = 0; load < numbers.cols(); ++load)
                    add_pairs(tests, values, load, tractions, numbers.col(load).segment<kNumbers>(kNumbers * field));
            }
        }
    }

    void add_pairs(std::span<const int> tests, const double* values, Eigen::Index load,
                   const Eigen::MatrixXd& tractions, Eigen::Ref<Eigen::VectorXd> numbers) const {
        const auto lanes = static_cast<std::size_t>(integrals_.lanes());
        for (std::size_t lane = 0; lane < tests.size(); ++lane) {
            const auto q = [&](std::size_t k) { return values[k * lanes + lane]; };
            const Eigen::Vector3d g = traction_of(tests[lane], load, tractions);
            numbers.segment<3>(kTrace) += (q(0) + q(1) + q(2)) * g;
            numbers.segment<3>(kTensor) +=
                Eigen::Vector3d(q(0) * g[0] + q(3) * g[1] + q(4) * g[2], q(3) * g[0] + q(1) * g[1] + q(5) * g[2],
                                q(4) * g[0] + q(5) * g[1] + q(2) * g[2]);
            for (std::size_t k = 0; k < 3; ++k)
                numbers.segment<3>(kNormal + 3 * static_cast<Eigen::Index>(k)) += q(6 + k) * g;
        }
    }

    const BoundaryPairs& pairs_;
    const PairIntegrals& integrals_;
    Clusters sources_, fields_;
    InteractionLists lists_;
    std::vector<Eigen::Index> row_of_;  ///< first row of each triangle's tractions
};

/// The formulas of bem/galerkin/traction_rows.hpp.
Eigen::MatrixXd layers_from(const Eigen::MatrixXd& numbers, const BoundaryPairs& pairs, const Material& material,
                            const PiecewiseTractions& given) {
    const Boundary& boundary = pairs.boundary();
    const double nu = material.poisson_ratio, double_factor = 1.0 / (8.0 * std::numbers::pi * (1.0 - nu)),
                 single_factor = 0.5 * double_factor / material.shear_modulus();
    const Eigen::Index n_vertices = boundary.mesh().n_vertices();
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(3 * (n_vertices + boundary.n_triangles()), numbers.cols());
    for (Eigen::Index load = 0; load < numbers.cols(); ++load) {
        for (int t = 0; t < boundary.n_triangles(); ++t) {
            const auto own = numbers.col(load).segment<kNumbers>(kNumbers * t);
            const Eigen::Vector3d trace = own.segment<3>(kTrace), tensor = own.segment<3>(kTensor);
            sums.col(load).segment<3>(3 * (n_vertices + t)) = single_factor * (tensor + (3.0 - 4.0 * nu) * trace);
            const Eigen::Vector3d curled = double_factor * (tensor + (1.0 - 2.0 * nu) * trace);
            const Eigen::Matrix3d& curls = pairs.curls(t);
            for (int k = 0; k < 3; ++k)
                sums.col(load).segment<3>(3 * boundary.mesh().triangles(k, t)) +=
                    curled.cross(curls.col(k)) - own.segment<3>(kNormal + 3 * k) / (4.0 * std::numbers::pi);
        }
        for (std::size_t i = 0; i < given.triangles.size(); ++i)  // the free term
            for (const int v : boundary.mesh().triangles.col(given.triangles[i]))
                sums.col(load).segment<3>(3 * v) += boundary.area(given.triangles[i]) / 6.0 *
                                                    given.values.block<3, 1>(3 * static_cast<Eigen::Index>(i), load);
    }
    return sums;
}

}  // namespace

Eigen::MatrixXd layers_of_tractions(const BoundaryPairs& pairs, const Material& material,
                                    const PiecewiseTractions& given, const LayerOptions& options, Control& control) {
    if (given.triangles.empty())
        return Eigen::MatrixXd::Zero(3 * (pairs.boundary().mesh().n_vertices() + pairs.boundary().n_triangles()),
                                     given.values.cols());
    const LayersOfTractions layers(pairs, given.triangles, options);
    Eigen::MatrixXd numbers(kNumbers * pairs.boundary().n_triangles(), given.values.cols());
    const auto at_once =
        static_cast<Eigen::Index>(std::max<std::size_t>(1, options.most_bytes / (1 + layers.bytes_of_a_load())));
    for (Eigen::Index first = 0; first < numbers.cols(); first += at_once) {
        const Eigen::Index n = std::min(at_once, numbers.cols() - first);
        numbers.middleCols(first, n) = layers.numbers(given.values.middleCols(first, n), control);
    }
    return layers_from(numbers, pairs, material, given);
}

}  // namespace elastolab
