// Nonlinear FEM where elements are thin, nearly without volume, or of very different sizes; and handles that are
// flattened.
#include <gtest/gtest.h>

#include <cmath>

#include "fem/nonlinear/bodies.hpp"

namespace elastolab {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A body that is held where x = 0, and moved where x is largest.
struct HardBody {
    HardBody(const TetMesh& mesh, ElementDegree degree) {
        const QuadraticMesh quadratic(mesh);
        elements = degree == ElementDegree::linear
                       ? std::make_shared<const FiniteElements>(mesh.vertices, mesh.tetrahedra)
                       : std::make_shared<const FiniteElements>(quadratic.positions, quadratic.elements);
        length = mesh.vertices.row(0).maxCoeff();
        std::vector<int> nodes = test::nodes_where(*elements, [](const Vector3d& p) { return p[0] == 0.0; });
        n_fixed = nodes.size();
        const auto right = test::nodes_where(*elements, [&](const Vector3d& p) { return p[0] == length; });
        nodes.insert(nodes.end(), right.begin(), right.end());
        Control control;
        solver = std::make_unique<NonlinearSolver>(elements, Material{1.0, 0.3},
                                                   PrescribedNodes{nodes, static_cast<int>(n_fixed), true}, control);
    }
    /// The moved end goes by x -> center + map (x - center), about its middle.
    EquilibriumFacts moved(const Matrix3d& map, const Vector3d& shift = Vector3d::Zero()) const {
        const std::vector<int>& nodes = solver->nodes();
        const Positions x = elements->positions()(Eigen::all, nodes);
        const Vector3d center = x.rightCols(x.cols() - static_cast<Eigen::Index>(n_fixed)).rowwise().mean();
        Eigen::VectorXd values = Eigen::VectorXd::Zero(x.size());
        for (auto i = static_cast<Eigen::Index>(n_fixed); i < x.cols(); ++i)
            values.segment<3>(3 * i) = center + map * (x.col(i) - center) + shift - x.col(i);
        const NodeSolution solution = solver->solve(values, false);
        const auto& state = dynamic_cast<const NonlinearState&>(*solution.state).newton();
        EXPECT_LT(state.residual, 1e-8);
        EXPECT_TRUE(state.u.allFinite());
        return solution.state->facts();
    }

    std::shared_ptr<const FiniteElements> elements;
    double length = 0.0;
    std::size_t n_fixed = 0;
    std::unique_ptr<NonlinearSolver> solver;
};

double volume_of(const TetMesh& mesh, Eigen::Index tet) {
    const Eigen::Matrix<double, 3, 4> x = mesh.vertices(Eigen::all, mesh.tetrahedra.col(tet));
    return (x.rightCols<3>().colwise() - x.col(0)).determinant() / 6.0;
}

/// Moves a vertex from inside the body towards the opposite face of one of its tetrahedra, until that is a sliver.
void make_sliver(TetMesh& mesh, double relative_volume) {
    const int vertex = mesh.n_surface_vertices;
    Eigen::Index tet = 0;
    while (!(mesh.tetrahedra.col(tet).array() == vertex).any()) ++tet;
    Vector3d face = Vector3d::Zero();
    for (const int v : mesh.tetrahedra.col(tet))
        if (v != vertex) face += mesh.vertices.col(v) / 3.0;
    mesh.vertices.col(vertex) = face + relative_volume * (mesh.vertices.col(vertex) - face);
}

class HardBodies : public testing::TestWithParam<ElementDegree> {};
INSTANTIATE_TEST_SUITE_P(NonlinearFem, HardBodies, testing::Values(ElementDegree::linear, ElementDegree::quadratic),
                         [](const auto& degree) {
                             return degree.param == ElementDegree::linear ? "FourNodes" : "TenNodes";
                         });

/// Relative, for this many nodes an element: those of four are far too stiff where they are stretched out.
double tolerance(double ten_nodes, double four_nodes) {
    return HardBodies::GetParam() == ElementDegree::quadratic ? ten_nodes : four_nodes;
}

TEST_P(HardBodies, AThinSheetIsBentAndTwisted) {
    const HardBody sheet(test::make_tet_box({12, 6, 1}, {2.0, 1.0, 0.01}), GetParam());
    const EquilibriumFacts bent =
        sheet.moved(test::rotation(Vector3d::UnitY(), -60), {2.0 * (std::sin(1.047) / 1.047 - 1.0), 0.0, 0.9});
    const EquilibriumFacts twisted = sheet.moved(test::rotation(Vector3d::UnitX(), 60));
    EXPECT_LT(bent.largest_stretch, 1.3);
    EXPECT_LT(twisted.largest_stretch, 1.3);
}

TEST_P(HardBodies, ASliverSpoilsNothing) {
    TetMesh mesh = test::make_tet_box({8, 3, 3}, {4.0, 1.0, 1.0});
    const double plain = HardBody(mesh, GetParam()).moved(test::rotation(Vector3d::UnitX(), 90)).energy;
    const double mean = volume_of(mesh, 0);
    make_sliver(mesh, 1e-6);
    double least = mean;
    for (Eigen::Index t = 0; t < mesh.n_tetrahedra(); ++t) least = std::min(least, volume_of(mesh, t));
    ASSERT_GT(least, 0.0);
    ASSERT_LT(least, 1e-5 * mean);
    EXPECT_NEAR(HardBody(mesh, GetParam()).moved(test::rotation(Vector3d::UnitX(), 90)).energy, plain,
                tolerance(0.01, 0.2) * plain);
}

/// Cells along the bar whose lengths differ by more than a thousand.
TEST_P(HardBodies, AGradedMeshGivesTheAnswerOfAnEvenOne) {
    const TetMesh even = test::make_tet_box({12, 3, 3}, {4.0, 1.0, 1.0});
    TetMesh graded = even;
    for (double& x : graded.vertices.row(0).reshaped()) x = 4.0 * std::pow(x / 4.0, 4);
    const Matrix3d R = test::rotation(Vector3d::UnitX(), 90);
    const double energy = HardBody(even, GetParam()).moved(R).energy;
    EXPECT_NEAR(HardBody(graded, GetParam()).moved(R).energy, energy, tolerance(0.05, 1.0) * energy);
}

/// Gauss points of ten-node elements lie away from the faces, and would not see it.
TEST_P(HardBodies, AHandleThatIsFlattenedHasNoEquilibrium) {
    const HardBody bar(test::make_tet_box({4, 2, 2}, {2.0, 1.0, 1.0}), GetParam());
    for (const double height : {0.0, 1e-9})
        EXPECT_THROW(bar.moved(Vector3d(1, 1, height).asDiagonal()), NoEquilibriumError);
    EXPECT_LT(bar.moved(Vector3d(1, 1, 0.3).asDiagonal()).largest_stretch, 10.0);
}

}  // namespace
}  // namespace elastolab
