#include "bem/collocation/hierarchical_loads.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>
#include <utility>

#include "bem/collocation/hierarchical.hpp"
#include "bem/hierarchical/cases.hpp"
#include "mesh/primitives.hpp"

namespace elastolab::test {
namespace {

/// A cube on its bottom face, with patches on its top to pull.
struct HeldCube {
    SurfaceMesh mesh = make_box(8);
    std::shared_ptr<const Boundary> boundary = std::make_shared<const Boundary>(mesh);
    Control control;
    std::shared_ptr<const HierarchicalCollocation> matrices =
        std::make_shared<const HierarchicalCollocation>(boundary, Material{1.0, 0.3}, 1e-10, control);

    /// The bottom and the patches around these places of the top.
    std::vector<int> held(const std::vector<Eigen::Vector3d>& places) const {
        std::vector<int> vertices = vertices_where(mesh, [](const auto& x) { return x[2] < kEdge; });
        for (const Eigen::Vector3d& place : places) {
            const auto patch = vertices_where(mesh, [&](const auto& x) { return (x - place).norm() < 0.2; });
            vertices.insert(vertices.end(), patch.begin(), patch.end());
        }
        return vertices;
    }
    CollocationProblem problem(const std::vector<Eigen::Vector3d>& places) {
        const auto vertices = held(places);
        const TractionSpace space =
            linear_traction_space(*boundary, VertexTriangles(mesh), Tractions::discontinuous, vertices);
        return {matrices, space, vertices, {}, true, control};
    }
};

const Eigen::Vector3d kLeft(0.25, 0.25, 1.0), kRight(0.75, 0.75, 1.0), kBack(0.2, 0.8, 1.0);

/// Products, products with few entries and blocks are those of a problem of the same set by itself.
void expect_same_equations(const CollocationProblem& A, const CollocationProblem& alone) {
    ASSERT_EQ(A.size(), alone.size());
    EXPECT_EQ(A.points(), alone.points());
    const Eigen::MatrixXd X = Eigen::MatrixXd::Random(A.size(), 2), truth = alone.product(X);
    EXPECT_LT((A.product(X) - truth).norm(), 1e-6 * truth.norm());
    SparseColumns Z(A.size(), 2);
    for (const Eigen::Index row : {Eigen::Index{4}, A.size() / 2, A.size() - 5}) Z.insert(row, row % 2) = 1.0;
    Control control;
    EXPECT_LT(off(A.sparse_product(Z, control), alone.product(Eigen::MatrixXd(Z))), 1e-6);
    std::vector<int> numbers;
    for (int i = 0; i < A.n_free() + A.n_slots(); i += 7) numbers.push_back(i);
    EXPECT_LT(off(A.block(numbers), alone.block(numbers)), 1e-6);
}

TEST(CollocationLoads, OfAKeptBaseAreNotIntegratedAgain) {
    HeldCube cube;
    const CollocationProblem one = cube.problem({kLeft});
    EXPECT_EQ(one.loads().n_new_slots(), one.n_slots());
    const CollocationProblem two = cube.problem({kLeft, kRight});
    const int n_of_patch = two.n_slots() - one.n_slots();
    EXPECT_EQ(two.loads().n_new_slots(), n_of_patch);
    // A handle that moves on, one that comes back, and the one there was from the beginning.
    const CollocationProblem other = cube.problem({kBack}), again = cube.problem({kRight}),
                             first = cube.problem({kLeft});
    EXPECT_LT(other.loads().n_new_slots(), one.n_slots() / 3);
    EXPECT_EQ(again.loads().n_new_slots(), 0);
    EXPECT_EQ(first.loads().n_new_slots(), 0);
    const CollocationProblem all = cube.problem({kBack, kRight, kLeft});
    EXPECT_LT(all.loads().n_new_slots(), one.n_slots() / 3);
    HeldCube another;
    for (const auto& [problem, places] :
         {std::pair<const CollocationProblem&, std::vector<Eigen::Vector3d>>{two, {kLeft, kRight}},
          {other, {kBack}},
          {again, {kRight}},
          {all, {kBack, kRight, kLeft}}}) {
        another.matrices = std::make_shared<const HierarchicalCollocation>(another.boundary, Material{1.0, 0.3}, 1e-10,
                                                                           another.control);  // that knows no other set
        expect_same_equations(problem, another.problem(places));
    }
}

TEST(CollocationLoads, OfSetsThatAreGoneAreForgotten) {
    HeldCube cube;
    cube.problem({kLeft});
    const CollocationProblem next = cube.problem({kLeft, kRight});
    EXPECT_EQ(next.loads().n_new_slots(), next.n_slots());
}

/// What is not used costs time in every product.
TEST(CollocationLoads, DoNotBuildUponASetOfWhichTheyUseLittle) {
    HeldCube cube;
    const CollocationProblem whole = cube.problem({kLeft, kRight, kBack});
    const auto corner = vertices_where(cube.mesh, [](const auto& x) { return x[2] < kEdge && x.norm() < 0.4; });
    const TractionSpace space =
        linear_traction_space(*cube.boundary, VertexTriangles(cube.mesh), Tractions::discontinuous, corner);
    const CollocationProblem small(cube.matrices, space, corner, {}, true, cube.control);
    EXPECT_EQ(small.loads().n_new_slots(), small.n_slots());
    EXPECT_LT(small.loads().memory_bytes(), whole.loads().memory_bytes() / 2);
}

}  // namespace
}  // namespace elastolab::test
