#include "scene/field_export.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "bem/collocation/method.hpp"
#include "elasticity/stress.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "methods/registry.hpp"
#include "scene/solve.hpp"
#include "support/temporary_folder.hpp"
#include "support/vtk_file.hpp"

namespace elastolab {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kRounding = 1e-9;  // relative; systems of a few hundred unknowns

/// A cube all of whose vertices follow u = A x: the stress is that of Hooke's law everywhere.
class StretchedCube {
public:
    explicit StretchedCube(MethodKind kind, double scale = 1.0) {
        gradient << 0.01, 0.02, 0.0, -0.01, 0.03, 0.005, 0.0, 0.01, -0.02;
        gradient *= scale;
        SolveRequest request{.scene_file = "cube.json", .document = {}, .method = {}, .with_checks = false};
        request.document.mesh = Primitive{.name = "cube", .resolution = 4, .size = {}};
        request.document.material = {.young_modulus = 7.0, .poisson_ratio = 0.25};
        request.document.handles.push_back({.name = "all",
                                            .select = {SphereSelector{.center = {0, 0, 0}, .radius = 9.0}},
                                            .motion = AffineMotion{.matrix = gradient}});
        request.method.kind = kind;
        Control control;
        solution = solve(request, control);
    }
    Eigen::Matrix<double, 6, 1> stress() const {
        const double nu = 0.25, E = 7.0;
        const Eigen::Matrix3d e = 0.5 * (gradient + gradient.transpose());
        Eigen::Matrix<double, 6, 1> s;
        for (int i = 0; i < 3; ++i) s[i] = E / ((1 + nu) * (1 - 2 * nu)) * ((1 - 2 * nu) * e(i, i) + nu * e.trace());
        s[3] = E / (1 + nu) * e(0, 1);
        s[4] = E / (1 + nu) * e(1, 2);
        s[5] = E / (1 + nu) * e(0, 2);
        return s;
    }
    int middle_of_a_face() const {
        int nearest = 0;
        (solution.surface->vertices.colwise() - Eigen::Vector3d(0.5, 0.5, 1.0)).colwise().norm().minCoeff(&nearest);
        return nearest;
    }
    Eigen::Matrix3d gradient;
    Solution solution;
};

TEST(FieldExport, AUniformStressIsThatOfHookesLaw) {
    const StretchedCube cube(kFem);
    const std::vector<MeshField> fields = surface_fields(solved_body(cube.solution));
    ASSERT_EQ(fields.size(), 4u);
    EXPECT_EQ(fields[0].name, "displacement");
    EXPECT_LT((fields[0].values - cube.gradient * cube.solution.surface->vertices).cwiseAbs().maxCoeff(), kRounding);
    const int v = cube.middle_of_a_face();
    const Eigen::Matrix<double, 6, 1> s = cube.stress();
    EXPECT_EQ(fields[3].name, "stress");
    EXPECT_LT((fields[3].values.col(v) - s).norm(), kRounding * s.norm()) << fields[3].values.col(v).transpose();
    EXPECT_EQ(fields[2].name, "traction");
    EXPECT_LT((fields[2].values.col(v) - Eigen::Vector3d(s[5], s[4], s[2])).norm(), kRounding * s.norm());
    EXPECT_EQ(fields[1].name, "von_mises");
    Eigen::Matrix3d deviator;
    deviator << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    deviator.diagonal().array() -= deviator.trace() / 3.0;
    EXPECT_NEAR(fields[1].values(0, v), std::sqrt(1.5) * deviator.norm(), kRounding * s.norm());
}

/// At edges, where faces with different stresses meet, too.
TEST(FieldExport, VonMisesIsThatOfTheStressBesideIt) {
    SolveRequest request{.scene_file = "cube.json", .document = {}, .method = {}, .with_checks = false};
    request.document.mesh = Primitive{.name = "cube", .resolution = 4, .size = {}};
    request.document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    request.document.handles.push_back({.name = "end",
                                        .select = {PlaneSelector{{1, 0, 0}, {1, 0, 0}, 1e-9}},
                                        .motion = AffineMotion{.translate = {0.1, 0.2, 0.0}}});
    request.method.kind = kFem;
    Control control;
    const std::vector<MeshField> fields = surface_fields(solved_body(solve(request, control)));
    ASSERT_EQ(fields[1].name, "von_mises");
    ASSERT_EQ(fields[3].name, "stress");
    for (Eigen::Index v = 0; v < fields[1].values.cols(); ++v) {
        const auto s = fields[3].values.col(v);
        const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
        const double expected = std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * s.tail<3>().squaredNorm());
        EXPECT_NEAR(fields[1].values(0, v), expected, 1e-12 * expected) << v;
    }
}

Eigen::MatrixXd numbers_of(const test::VtkFile& file, const std::string& array) {
    const test::VtkArray& found = file.arrays.at(array);
    const std::vector<double> numbers = found.as<double>();
    return Eigen::Map<const Eigen::MatrixXd>(numbers.data(), found.n_components,
                                             std::ssize(numbers) / found.n_components);
}

/// Nodes inside, midpoints on constrained triangles and elements alike. Small motions, so that nonlinear FEM has the
/// same stress: its difference is of the size of the strain.
TEST(FieldExport, EveryNodeAndElementOfAUniformStretchMovesAndIsStressedByHookesLaw) {
    constexpr double kSmall = 1e-6;
    for (const MethodKind kind : {kFem, kQuadraticFem, kNonlinearFem}) {
        const StretchedCube cube(kind, kSmall);
        std::ostringstream out;
        Control control;
        write_field_file(out, "cube.vtu", solved_body(cube.solution), control);
        const test::VtkFile file = test::read_vtk(out.str());
        const auto types = file.arrays.at("Cells/types").as<std::uint8_t>();
        ASSERT_GT(types.size(), 100u);
        EXPECT_THAT(types, testing::Each(kind == kFem ? 10 : 24)) << name(kind);
        const Eigen::MatrixXd points = numbers_of(file, "Points/Points");
        EXPECT_GT(points.cols(), cube.solution.surface->n_vertices() + (kind == kFem ? 0 : 500));
        const Eigen::MatrixXd exact = cube.gradient * points;
        EXPECT_LT((numbers_of(file, "PointData/displacement") - exact).cwiseAbs().maxCoeff(),
                  kRounding * exact.cwiseAbs().maxCoeff())
            << name(kind);
        const Eigen::Matrix<double, 6, 1> s = cube.stress();
        const double size = measure(StressMeasure::von_mises, stress_tensor(s));
        const double tolerance = kind->linear ? kRounding : 10.0 * kSmall;
        for (const std::string where : {"PointData/", "CellData/"}) {
            // VTK's order: XX YY ZZ XY YZ XZ, which is that of stress() too.
            EXPECT_LT((numbers_of(file, where + "stress").colwise() - s).cwiseAbs().maxCoeff(), tolerance * s.norm())
                << name(kind) << where;
            EXPECT_LT((numbers_of(file, where + "von_mises").array() - size).abs().maxCoeff(), tolerance * size)
                << name(kind) << where;
        }
    }
}

TEST(FieldExport, AMethodWithoutInsideSaysSoAndLeavesNoFile) {
    const test::TemporaryFolder folder;
    const StretchedCube cube(kLinearBem);
    Control control;
    try {
        save_field_file(folder.path() / "cube.vtu", solved_body(cube.solution), control);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("linear-bem has no tetrahedra inside. Choose .vtp"));
    }
    EXPECT_THAT(folder.listing(), ElementsAre());
    save_field_file(folder.path() / "cube.VTP", solved_body(cube.solution), control);
    EXPECT_THAT(folder.listing(), ElementsAre("cube.VTP"));
}

}  // namespace
}  // namespace elastolab
