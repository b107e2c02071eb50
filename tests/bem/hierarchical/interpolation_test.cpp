#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bem/boundary.hpp"
#include "bem/galerkin/boundary_entries.hpp"
#include "bem/hierarchical/interaction_lists.hpp"
#include "bem/hierarchical/interpolation_nodes.hpp"
#include "bem/hierarchical/node_potentials.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

Eigen::AlignedBox3d box_of(const Eigen::Vector3d& size) {
    const Eigen::Vector3d low(3.0, -1.0, 0.5);
    return {low, low + size};
}

TEST(InterpolationNodes, KeepTheToleranceForAllDistancesFromTheLeast) {
    for (const Eigen::Vector3d& size : {Eigen::Vector3d(1.0, 1.0, 1.0), Eigen::Vector3d(2.0, 1.0, 0.1),
                                        Eigen::Vector3d(1.0, 3.0, 0.0), Eigen::Vector3d(1e-5, 0.0, 1e-5)})
        for (const double tolerance : {1e-2, 1e-4, 1e-8, 1e-12}) {
            const double times_tolerance = tolerance < 1e-8 ? 100.0 : 30.0;
            const Eigen::AlignedBox3d box = box_of(size);
            const double least = size.norm();  // twice the radius
            const InterpolationNodes nodes(box, least, tolerance);
            const auto at = [&](double x, double y, double z) -> Eigen::Vector3d {
                return box.center() + 0.5 * size.cwiseProduct(Eigen::Vector3d(x, y, z));
            };
            Eigen::Matrix3Xd places(3, 4);
            places << at(1.0, 1.0, 1.0), at(-0.9, 0.2, 0.4), at(0.3, -1.0, 0.0), at(-0.05, 0.7, -1.0);
            const Eigen::MatrixXd polynomials = nodes.polynomials(places);
            ASSERT_EQ(polynomials.rows(), nodes.size());
            for (const Eigen::Vector3d& direction :
                 {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(0.6, 0.8, 0.0), Eigen::Vector3d(0.0, -0.28, 0.96)})
                for (const double times : {1.0, 10.0}) {
                    const Eigen::Vector3d from = nodes.middle() + times * least * direction;
                    const auto inverse = [&](const Eigen::Vector3d& y) { return 1.0 / (y - from).norm(); };
                    Eigen::VectorXd values(nodes.size());
                    for (int i = 0; i < nodes.size(); ++i) values[i] = inverse(nodes.middle() + nodes.offsets().col(i));
                    for (Eigen::Index p = 0; p < places.cols(); ++p)
                        EXPECT_NEAR(values.dot(polynomials.col(p)) / inverse(places.col(p)), 1.0,
                                    times_tolerance * tolerance)
                            << size.transpose() << " at " << from.transpose();
                }
        }
}

TEST(InterpolationNodes, HavePolynomialsThatAreOneAtTheirOwnNode) {
    const InterpolationNodes nodes(box_of({2.0, 1.0, 0.3}), 3.0, 1e-5);
    const Eigen::MatrixXd values = nodes.polynomials(nodes.offsets().colwise() + nodes.middle());
    EXPECT_LT((values - Eigen::MatrixXd::Identity(nodes.size(), nodes.size())).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(nodes.size(), 16 * 16 * 16);
}

TEST(NodePotentials, AreTheSumsOverTheForces) {
    const InterpolationNodes source(box_of({1.0, 0.5, 0.2}), 2.0, 1e-2),
        field({Eigen::Vector3d(5.0, 2.0, -1.0), Eigen::Vector3d(5.3, 3.0, 0.0)}, 2.0, 1e-2);
    const Eigen::MatrixXd forces = Eigen::MatrixXd::Random(source.size(), 6);  // of two loads
    Eigen::MatrixXd potentials = Eigen::MatrixXd::Ones(field.size(), 2 * kNodePotentials), truth = potentials;
    add_node_potentials(field, source, forces, potentials);
    for (int p = 0; p < field.size(); ++p)
        for (int q = 0; q < source.size(); ++q)
            for (int load = 0; load < 2; ++load) {
                const Eigen::RowVector3d g = forces.row(q).segment<3>(3 * load);
                const Eigen::RowVector3d r =
                    (field.middle() + field.offsets().col(p) - source.middle() - source.offsets().col(q)).transpose();
                const double cube = std::pow(r.norm(), 3);
                auto own = truth.row(p).segment<kNodePotentials>(kNodePotentials * load);
                own.head<3>() += g / r.norm();
                own.segment<3>(3) += r * (r.dot(g) / cube);
                for (int i = 0; i < 3; ++i) own.segment<3>(6 + 3 * i) += r[i] * g / cube;
            }
    EXPECT_LT((potentials - truth).cwiseAbs().maxCoeff(), 1e-11 * truth.cwiseAbs().maxCoeff());
}

TEST(InteractionLists, HoldEveryPairOnce) {
    const auto clustered = [](const SurfaceMesh& mesh, int leaf_size) {
        return BoundaryPairs(std::make_shared<const Boundary>(mesh), 1e-6).cluster_vertices(leaf_size);
    };
    const auto fields = clustered(make_torus(6), 12), sources = clustered(make_sphere(5), 7);
    const auto judge = [&](int f, int s) {
        const ClusterTree::Cluster &field = fields->cluster(f), &source = sources->cluster(s);
        if (field.box.exteriorDistance(source.box) < 0.3) return Interaction::split;
        return field.range.size() + source.range.size() < 30 ? Interaction::near : Interaction::far;
    };
    const InteractionLists lists(*fields, *sources, judge);
    Eigen::MatrixXi times = Eigen::MatrixXi::Zero(fields->size(), sources->size());
    int n_far = 0;
    for (std::size_t f = 0; f < fields->clusters().size(); ++f) {
        const ClusterTree::Cluster& field = fields->clusters()[f];
        const auto count = [&](int s) {
            const PositionRange source = sources->cluster(s).range;
            times.block(field.range.begin, source.begin, field.range.size(), source.size()).array() += 1;
        };
        for (const int s : lists.far[f]) {
            EXPECT_EQ(judge(static_cast<int>(f), s), Interaction::far);
            count(s);
            ++n_far;
        }
        for (const int s : lists.near[f]) {
            EXPECT_TRUE(field.is_leaf());
            count(s);
        }
    }
    EXPECT_EQ(times.minCoeff(), 1);
    EXPECT_EQ(times.maxCoeff(), 1);
    EXPECT_GT(n_far, 0);
}

}  // namespace
}  // namespace elastolab
