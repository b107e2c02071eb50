#include "bem/galerkin/triangle_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "bem/galerkin/hierarchical_system.hpp"
#include "bem/galerkin/method.hpp"
#include "bem/hierarchical/cases.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

struct Rabbit {
    SurfaceMesh mesh = make_rabbit(450).surface;
    StageTimes stages;
    Control control;
    HierarchicalSystem system{mesh, 0.3, Method{.kind = kGalerkinBem}, stages, control};

    /// Triangles between two heights, over that of the body, and one as far as `left` reaches.
    std::vector<int> between(double low, double high, double left = 0.0) const {
        const Eigen::Vector3d least = mesh.vertices.rowwise().minCoeff(), most = mesh.vertices.rowwise().maxCoeff();
        std::vector<int> triangles;
        for (int t = 0; t < mesh.n_triangles(); ++t) {
            const Eigen::Vector3d x = mesh.vertices.col(mesh.triangles(0, t));
            const Eigen::Vector3d at = (x - least).cwiseQuotient(most - least);
            if ((low <= at[2] && at[2] < high) || at[0] < left) triangles.push_back(t);
        }
        return triangles;
    }
    std::shared_ptr<const TriangleLayers> layers(const std::vector<int>& triangles) {
        return system.layers_of(triangles, control);
    }
    std::shared_ptr<const TriangleLayers> layers_alone(const std::vector<int>& triangles) {
        const LayerSource source{system.pairs(), system.tree(), system.material(), system.options()};
        return std::make_shared<const TriangleLayers>(
            source, triangles, std::vector<std::shared_ptr<const TriangleGeneration>>{}, control);
    }
};

void expect_same_operators(const TriangleLayers& layers, const TriangleLayers& alone, Eigen::Index n_displacements) {
    const Eigen::MatrixXd u = Eigen::MatrixXd::Random(n_displacements, 2);
    const Eigen::MatrixXd t = Eigen::MatrixXd::Random(3 * layers.n_triangles(), 2);
    EXPECT_LT(off(layers.double_layer(u), alone.double_layer(u)), 1e-5);
    EXPECT_LT(off(layers.transposed_double_layer(t), alone.transposed_double_layer(t)), 1e-5);
    EXPECT_LT(off(layers.single_layer(t), alone.single_layer(t)), 1e-5);
    std::vector<int> some, covered;
    for (int number = 0; number < layers.n_triangles(); number += 3) some.push_back(number);
    EXPECT_LT(off(layers.single_layer_block(some), alone.single_layer_block(some)), 1e-5);
    SparseColumns Z(t.rows(), 4);
    for (Eigen::Index row = 1; row < t.rows(); row += 5) Z.insert(row, 4 * row / t.rows()) = 1.0;
    Control control;
    EXPECT_LT(off(layers.galerkin_product(Z, control), Z.transpose() * alone.single_layer(Eigen::MatrixXd(Z))), 1e-5);
    for (const std::vector<int>& cluster : layers.clusters(40))
        covered.insert(covered.end(), cluster.begin(), cluster.end());
    std::sort(covered.begin(), covered.end());
    ASSERT_EQ(std::ssize(covered), layers.n_triangles());
    for (int number = 0; number < layers.n_triangles(); ++number)
        EXPECT_EQ(covered[static_cast<std::size_t>(number)], number);
}

TEST(TriangleLayers, OfAKeptBaseAreNotIntegratedAgain) {
    Rabbit rabbit;
    const auto fixed = rabbit.between(0.0, 0.2), pulled = rabbit.between(0.0, 0.2, 0.1),
               moved = rabbit.between(0.0, 0.25, 0.05);
    ASSERT_GT(pulled.size(), fixed.size());
    const auto first = rabbit.layers(fixed), second = rabbit.layers(pulled), third = rabbit.layers(moved),
               again = rabbit.layers(fixed);
    EXPECT_EQ(first->n_new_triangles(), first->n_triangles());
    EXPECT_EQ(second->n_new_triangles(), std::ssize(pulled) - std::ssize(fixed));
    EXPECT_LT(third->n_new_triangles(), third->n_triangles() / 2);
    EXPECT_EQ(again->n_new_triangles(), 0);
    expect_same_operators(*second, *rabbit.layers_alone(pulled), rabbit.system.size());
    expect_same_operators(*third, *rabbit.layers_alone(moved), rabbit.system.size());
    EXPECT_EQ(third->last_generation()->depth, 3);
    const auto little = rabbit.between(0.0, 0.04);
    ASSERT_LT(2 * little.size(), fixed.size());
    EXPECT_EQ(rabbit.layers(little)->n_new_triangles(), std::ssize(little)) << "the others would be of little use";
}

TEST(TriangleLayers, OfSetsThatAreGoneAreForgotten) {
    Rabbit rabbit;
    const auto fixed = rabbit.between(0.0, 0.2);
    rabbit.layers(fixed);
    EXPECT_EQ(rabbit.layers(fixed)->n_new_triangles(), std::ssize(fixed));
}

}  // namespace
}  // namespace elastolab::test
