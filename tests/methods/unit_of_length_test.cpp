// Nothing depends on the unit of length or of displacement: not to rounding, however large or small its numbers are.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/lapack.hpp"
#include "bem/collocation/method.hpp"
#include "deform/volume.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/method.hpp"
#include "mesh/measures.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"

namespace elastolab {
namespace {

using test::describe;

struct Solution {
    Deformer::Answer answer;
    Eigen::VectorXd displacements;
    SolutionQuality quality;
};

/// A brick held by five loose vertices, three of its corners and two points inside faces, and pulled at two others.
Solution solve(const Method& method, double unit, double pull = 1.0) {
    SurfaceMesh brick = make_box(3);
    brick.vertices.row(0) *= 2.0;
    brick.vertices *= unit;
    const ConstrainedSet set{.fixed = {0, 3, 12, 20, 31}, .handles = {40, 50}};
    Eigen::VectorXd values(6);
    values << 0.1, 0.0, 0.05, 0.0, -0.03, 0.02;
    values *= unit * pull;
    Control control;
    Deformer deformer(test::precomputed(test::make_body(brick), method));
    deformer.constrain(set, control);
    return {deformer.answer(values, {.residual = true, .check = true}, control), deformer.displace(values),
            deformer.quality()};
}

/// The linear methods (large_deformation_test.cpp has the other); those of collocation with the update that solves a
/// capacitance system of mixed units.
std::vector<Method> methods_of_any_update() {
    std::vector<Method> methods;
    for (const MethodKind kind : all_methods())
        for (const Update update : {Update::reduced, Update::direct}) {
            const Method method{.kind = kind, .update = update};
            if (kind->linear && refusal(method, 0.3).empty()) methods.push_back(method);
        }
    return methods;
}

double relative(const Eigen::MatrixXd& difference, const Eigen::MatrixXd& to) {
    return difference.stableNorm() / to.stableNorm();
}

TEST(UnitOfLength, DoesNotMatterAtTheExtremes) {
    // Other units than powers of two round the coordinates, and what is nearly singular takes that up.
    constexpr double kRounding = 1e-9;
    for (const Method& method : methods_of_any_update()) {
        const Solution one = solve(method, 1.0);
        EXPECT_LT(one.answer.residual.value(), 1e-9) << describe(method);
        for (const double unit : {1e-12, 1e15}) {
            SCOPED_TRACE(describe(method) + ", unit " + std::to_string(unit));
            const Solution other = solve(method, unit);
            EXPECT_LT(other.answer.residual.value(), 1e-9);
            EXPECT_EQ(other.quality.held, one.quality.held);
            EXPECT_LT(relative(other.displacements / unit - one.displacements, one.displacements), kRounding);
            const Reactions &a = one.answer.reactions, &b = other.answer.reactions;
            EXPECT_LT(relative(b.forces / (unit * unit) - a.forces, a.forces), kRounding);
            EXPECT_LT(relative(b.moments / (unit * unit * unit) - a.moments, a.moments), kRounding);
        }
    }
}

/// A power of two rounds nothing; what is left is the order in which the BLAS sums.
constexpr double kSame = 1e-13;

TEST(UnitOfLength, ChangesNothingWhenItIsAPowerOfTwo) {
    constexpr double kUnit = 0x1p-70;
    for (const Method& method : methods_of_any_update()) {
        SCOPED_TRACE(describe(method));
        const Solution one = solve(method, 1.0), other = solve(method, kUnit);
        EXPECT_LT(relative(other.displacements / kUnit - one.displacements, one.displacements), kSame);
        const Eigen::MatrixXd &a = one.answer.reactions.forces, b = other.answer.reactions.forces / (kUnit * kUnit);
        EXPECT_LT(relative(b - a, a), kSame);
    }
}

TEST(UnitOfLength, IsThatOfTheInside) {
    constexpr double kUnit = 0x1p+50;
    SurfaceMesh box = make_box(3);
    Control control;
    const auto one = Volume::of(test::precomputed(test::make_body(box), test::make_method(kFem)), control);
    box.vertices *= kUnit;
    const auto other = Volume::of(test::precomputed(test::make_body(box), test::make_method(kFem)), control);
    ASSERT_GT(one->mesh().n_vertices(), one->mesh().n_surface_vertices);
    EXPECT_EQ(other->mesh().vertices, one->mesh().vertices * kUnit);
}

TEST(UnitOfLength, DoesNotMatterForTheSizeOfDisplacements) {
    for (const Method& method : methods_of_any_update()) {
        SCOPED_TRACE(describe(method));
        const Solution one = solve(method, 1.0);
        for (const double pull : {0x1p-600, 0x1p+600}) {  // squares of these are not representable
            const Solution other = solve(method, 1.0, pull);
            const Deformer::Answer &a = one.answer, &b = other.answer;
            EXPECT_LT(b.residual.value(), 1e-9);
            EXPECT_LT(relative(b.displacements / pull - a.displacements, a.displacements), kSame);
            EXPECT_LT(relative(b.reactions.forces / pull - a.reactions.forces, a.reactions.forces), kSame);
            ASSERT_EQ(b.check.has_value(), a.check.has_value());
            if (a.check) {
                EXPECT_NEAR(b.check->relative_error, a.check->relative_error, kSame);
            }
        }
    }
}

/// Of a body of this size, by name.
std::map<std::string, Eigen::MatrixXd> matrices(const Method& method, double unit, double young) {
    SurfaceMesh box = make_box(2);
    box.vertices *= unit;
    std::map<std::string, Eigen::MatrixXd> result;
    const auto model = test::precomputed(test::make_body(box, {young, 0.3}), method);
    model->visit_matrices([&](const NamedMatrix& matrix) { result[matrix.name] = matrix.values; });
    model->visit_sparse_stiffness(
        [&](const std::string&, const SparseStiffness& K) { result["sparse"] = K.toDense(); });
    return result;
}

/// Kelvin's kernels are 1/L^2 and 1/(E L), integrated over areas; a stiffness of nodal forces is E L.
TEST(UnitOfLength, IsThatOfExportedMatrices) {
    constexpr double kUnit = 0x1p-20, kYoung = 0x1p+10;
    const std::map<std::string, std::array<int, 2>> boundary = {
        {"H", {0, 0}}, {"G", {-1, 1}}, {"K", {1, -1}}, {"Kinv", {-1, 1}}};
    const std::map<std::string, std::array<int, 2>> nodal = {
        {"K", {1, 1}}, {"Kinv", {-1, -1}}, {"sparse", {1, 1}}, {"D", {1, 1}}, {"Dplus", {-1, -1}}};
    for (const MethodKind kind : all_methods()) {
        const Method method{.kind = kind, .mode = Mode::full};
        if (!refusal(method, 0.3).empty()) continue;
        auto one = matrices(method, 1.0, 1.0), other = matrices(method, kUnit, kYoung);
        const auto& dimensions = one.contains("H") ? boundary : nodal;
        EXPECT_FALSE(one.empty()) << describe(method);
        for (const auto& [name, matrix] : one) {
            if (name == "Khatinv") continue;
            const auto [young, length] = dimensions.at(name);
            const Eigen::MatrixXd expected = matrix * (std::pow(kYoung, young) * std::pow(kUnit, length));
            EXPECT_LT(relative(other.at(name) - expected, expected), kSame) << describe(method) << " " << name;
        }
    }
}

/// Of a body that is neither stiff 1 nor large 1.
struct FullMode : testing::TestWithParam<Method> {
    static constexpr double kUnit = 3e-5, kYoung = 2e5;

    void SetUp() override {
        SurfaceMesh box = make_box(3);
        box.vertices *= kUnit;
        const auto model = test::precomputed(test::make_body(box, {kYoung, 0.3}), GetParam());
        model->visit_matrices([this](const NamedMatrix& matrix) { found_[matrix.name] = matrix.values; });
        C_ = rigid_modes(GetParam().kind == kConstantBem ? centroids(box) : box.vertices);
    }

    static Positions centroids(const SurfaceMesh& mesh) {
        Positions result(3, mesh.n_triangles());
        for (int t = 0; t < mesh.n_triangles(); ++t) result.col(t) = centroid(mesh, t);
        return result;
    }

    std::map<std::string, Eigen::MatrixXd> found_;
    Eigen::MatrixXd C_;
};

/// [K  B; C^T  0] times its inverse as it is exported; B is G^-1 C where K is of tractions, and C where it is of
/// forces.
TEST_P(FullMode, ExportsTheInverseOfTheBorderedStiffness) {
    const bool of_tractions = found_.contains("G");
    const double stiffness = of_tractions ? kYoung / kUnit : kYoung * kUnit;
    const Eigen::MatrixXd& K = found_.at("K");
    const Eigen::Index n = K.rows();
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + 6, n + 6);
    bordered.topLeftCorner(n, n) = K;
    bordered.topRightCorner(n, 6) = C_;
    if (of_tractions) bordered.topRightCorner(n, 6) = LuFactorization(Eigen::MatrixXd(found_.at("G")), "G").solve(C_);
    bordered.bottomLeftCorner(6, n) = C_.transpose();
    Eigen::MatrixXd product = bordered * found_.at("Khatinv") - Eigen::MatrixXd::Identity(n + 6, n + 6);
    product.topRightCorner(n, 6) /= stiffness;
    product.bottomLeftCorner(6, n) *= stiffness;
    EXPECT_LT(product.cwiseAbs().maxCoeff(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Methods, FullMode,
                         testing::Values(test::make_method(kConstantBem, {}, Mode::full),
                                         test::make_method(kLinearBem, {}, Mode::full),
                                         test::make_method(kFem, {}, Mode::full)));

}  // namespace
}  // namespace elastolab
