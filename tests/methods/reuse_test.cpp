#include <gtest/gtest.h>

#include <cmath>

#include "base/blas.hpp"
#include "base/error.hpp"
#include "base/lapack.hpp"
#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/method.hpp"
#include "findings/words.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

struct Pull {
    SurfaceMesh mesh = make_box(3);
    ConstrainedSet set{vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; }),
                       vertices_where(mesh, [](const auto& x) { return x[0] > 1.0 - 1e-9; })};
    Eigen::VectorXd values = Eigen::Vector3d(0.1, 0.05, 0.0).replicate(std::ssize(set.handles), 1);
};

bool has_stage(const Model& model, const std::string& name) {
    for (const StageTime& stage : model.facts().stages)
        if (stage.name == name) return true;
    return false;
}

TEST(PrecomputeAgain, WithAnotherPoissonsRatioEqualsAFreshModel) {
    const Pull pull;
    std::vector<Method> methods = method_variants();
    for (const Method& method : method_variants(Mode::full)) methods.push_back(method);
    for (const Method& method : methods) {
        Control control;
        std::shared_ptr<const Model> model = precompute(make_body(pull.mesh, {1.0, 0.3}), method, control);
        for (const double nu : {0.45, 0.1}) {
            model = precompute_again(*model, {1.0, nu}, method, control);
            const auto fresh = precompute(make_body(pull.mesh, {1.0, nu}), method, control);
            const Eigen::VectorXd expected = displaced(fresh, pull.set, pull.values);
            EXPECT_LT((displaced(model, pull.set, pull.values) - expected).norm(), 1e-12 * expected.norm())
                << describe(method) << ", nu " << nu;
            EXPECT_FALSE(has_stage(*model, "tetrahedralize")) << describe(method);
        }
    }
}

TEST(PrecomputeAgain, GalerkinIntegratesOnceForAllFurtherPoissonsRatios) {
    Control control;
    const Method method = make_method(kGalerkinBem);
    const auto first = precompute(make_body(make_box(3), {1.0, 0.3}), method, control);
    EXPECT_TRUE(has_stage(*first, "integrate"));
    const auto second = precompute_again(*first, {1.0, 0.4}, method, control);
    EXPECT_TRUE(has_stage(*second, "integrate"));
    EXPECT_GT(second->facts().memory_bytes, first->facts().memory_bytes);
    const auto third = precompute_again(*second, {1.0, 0.45}, method, control);
    EXPECT_FALSE(has_stage(*third, "integrate"));
    EXPECT_TRUE(has_stage(*third, "combine"));
}

TEST(PrecomputeAgain, WithAnotherPoissonsRatioIsRefusedWhereMemoryDoesNotSufficeForBothModels) {
    static std::uint64_t needed = 0;
    for (const MethodKind kind : all_methods()) {
        MethodTraits traits = *kind;
        traits.predict = [](const SurfaceMesh&, const Method&) { return Cost{.memory_bytes = needed}; };
        const Method method{.kind = &traits};
        Control control;
        needed = 0;
        const auto first = precompute(make_body(make_box(2), {1.0, 0.3}), method, control);
        needed = std::uint64_t{1} << 60;
        EXPECT_THROW(precompute_again(*first, {1.0, 0.2}, method, control), SolveError) << name(kind);
        EXPECT_NO_THROW(precompute_again(*first, {2.0, 0.3}, method, control)) << name(kind) << ": nothing is computed";
    }
}

TEST(PrecomputeAgain, WithAnUpdateOrRowsThatTakeMoreIsRefusedWhereMemoryDoesNotSuffice) {
    static std::uint64_t needed = 0;
    MethodTraits traits = *kGalerkinBem;
    traits.predict = [](const SurfaceMesh&, const Method&) { return Cost{.memory_bytes = needed}; };
    Control control;
    needed = 0;
    const Method direct{.kind = &traits, .update = Update::direct}, reduced{.kind = &traits, .update = Update::reduced},
        finer{.kind = &traits, .update = Update::direct, .rims = 1};
    const auto first = precompute(make_body(make_box(2), {1.0, 0.3}), direct, control);
    const auto second = precompute_again(*first, {1.0, 0.3}, reduced, control);
    needed = std::uint64_t{1} << 60;
    EXPECT_THROW(precompute_again(*first, {1.0, 0.3}, reduced, control), SolveError) << "a factor of all vertices";
    EXPECT_THROW(precompute_again(*first, {1.0, 0.3}, finer, control), SolveError);
    EXPECT_NO_THROW(precompute_again(*second, {1.0, 0.3}, direct, control)) << "which is there";
}

TEST(PrecomputeAgain, WithAnotherYoungsModulusComputesNothingAndScalesTheForces) {
    const Pull pull;
    for (const Method& method : method_variants()) {
        Control control;
        const auto first = precompute(make_body(pull.mesh, {1.0, 0.3}), method, control);
        const auto again = precompute_again(*first, {1.0e7, 0.3}, method, control);
        EXPECT_TRUE(again->facts().stages.empty()) << describe(method);
        Deformer soft(first), stiff(again);
        soft.constrain(pull.set, control);
        stiff.constrain(pull.set, control);
        EXPECT_EQ(soft.displace(pull.values), stiff.displace(pull.values)) << describe(method);
        const Eigen::Matrix3Xd forces = 1.0e7 * soft.reactions(pull.values).forces;
        EXPECT_LT((stiff.reactions(pull.values).forces - forces).norm(), 1e-12 * forces.norm()) << describe(method);
    }
}

TEST(PrecomputeAgain, WithOtherTractionsOrUpdatesKeepsTheSystem) {
    const Pull pull;
    Control control;
    const auto first = precompute(make_body(pull.mesh), Method{.kind = kLinearBem}, control);
    const Method restricted = make_method(kLinearBem, Tractions::restricted);
    const auto again = precompute_again(*first, {1.0, 0.3}, restricted, control);
    EXPECT_TRUE(again->facts().stages.empty());
    const Eigen::VectorXd expected = displaced(precomputed(make_body(pull.mesh), restricted), pull.set, pull.values);
    EXPECT_LT((displaced(again, pull.set, pull.values) - expected).norm(), 1e-13 * expected.norm());
}

/// Tetrahedra that grow away from the surface, as in previews, are fewer, and serve no method that did not ask for
/// them.
TEST(PrecomputeAgain, KeepsNoTetrahedraThatGrowOtherwise) {
    for (const MethodKind kind : all_methods()) {
        if (!kind->has_inside) continue;
        Control control;
        const Body body = make_body(make_box(8), {1.0, 0.3});
        const Method usual = make_method(kind);
        Method coarse = usual;
        coarse.growth = 1.0;
        const auto fresh = precompute(body, usual, control);
        const auto grown = precompute(body, coarse, control);
        EXPECT_LT(grown->facts().n_tetrahedra, 0.7 * fresh->facts().n_tetrahedra) << kind->name;
        const auto again = precompute_again(*grown, {1.0, 0.3}, usual, control);
        EXPECT_EQ(again->facts().n_tetrahedra, fresh->facts().n_tetrahedra) << kind->name;
    }
}

TEST(Precompute, GivesTheSameResultForEveryNumberOfThreads) {
    const Pull pull;
    const int threads = thread_count();
    for (const Method& method : method_variants()) {
        set_thread_count(1);
        const Eigen::VectorXd one = displaced(precomputed(make_body(pull.mesh), method), pull.set, pull.values);
        set_thread_count(3);
        const Eigen::VectorXd three = displaced(precomputed(make_body(pull.mesh), method), pull.set, pull.values);
        set_thread_count(threads);
        // The BLAS may split its products differently, which changes their rounding.
        EXPECT_LT((one - three).norm(), 1e-12 * one.norm()) << describe(method);
    }
}

TEST(Precompute, StopsWhenCancelled) {
    for (const Method& method : method_variants()) {
        Control control;
        control.cancel();
        EXPECT_THROW(precompute(make_body(make_box(3)), method, control), Cancelled) << describe(method);
    }
}

/// Powers of two, so that TetGen sees the same numbers and makes the same tetrahedra.
TEST(Precompute, IsIndifferentToUnitsOfLengthAndForce) {
    const Pull pull;
    std::vector<Method> methods = method_variants();
    for (const Method& method : method_variants(Mode::on_demand, Update::direct)) methods.push_back(method);
    for (const Method& method : methods)
        for (const double scale : {std::ldexp(1.0, -30), std::ldexp(1.0, 30)}) {
            SurfaceMesh scaled = pull.mesh;
            scaled.vertices *= scale;
            const Eigen::VectorXd reference =
                displaced(precomputed(make_body(pull.mesh), method), pull.set, pull.values);
            const Eigen::VectorXd u =
                displaced(precomputed(make_body(scaled, {1e12, 0.3}), method), pull.set, scale * pull.values);
            EXPECT_LT((u / scale - reference).norm(), 1e-9 * reference.norm()) << describe(method) << ", " << scale;
        }
}

TEST(FullMode, ExportsAStiffnessWhoseBorderedInverseItIs) {
    const Body body = make_body(make_box(3), {2.0e5, 0.3});
    for (const Method& method : method_variants(Mode::full)) {
        if (method.kind == kGalerkinBem) continue;  // which has no K, but D and its pseudo-inverse
        const auto model = precomputed(body, method);
        Eigen::MatrixXd K, inverse;
        model->visit_matrices([&](const NamedMatrix& matrix) {
            if (matrix.name == "K") K = matrix.values;
            if (matrix.name == "Khatinv") inverse = matrix.values;
        });
        ASSERT_EQ(inverse.rows(), K.rows() + 6) << describe(method);
        // K D + (K^ has the border B) B F^T = I: so K D - I has rank at most six.
        const Eigen::MatrixXd defect =
            K * inverse.topLeftCorner(K.rows(), K.cols()) - Eigen::MatrixXd::Identity(K.rows(), K.cols());
        const Eigen::VectorXd values = singular_values(defect).sigma;
        EXPECT_GT(values[5], 0.1) << describe(method);
        EXPECT_LT(values[6], 1e-9) << describe(method);
    }
}

/// A uniform pressure on a closed surface displaces nothing when the volume cannot change.
TEST(FullMode, SaysThatKCarriesNoDigitsByConstantElementsAtOneHalf) {
    Method method = make_method(kConstantBem, Tractions::continuous, Mode::full);
    EXPECT_FALSE(precomputed(make_body(make_box(3), {1.0, 0.5}), method)->facts().findings.empty());
    EXPECT_TRUE(precomputed(make_body(make_box(3), {1.0, 0.3}), method)->facts().findings.empty());
}

/// The columns of the mixed system keep their meaning there.
TEST(OnDemandMode, SolvesAnIncompressibleBodyByConstantElements) {
    const Pull pull;
    const auto displacements = [&](double nu) {
        return displaced(precomputed(make_body(pull.mesh, {1.0, nu}), make_method(kConstantBem)), pull.set,
                         pull.values);
    };
    const Eigen::VectorXd near = displacements(0.4999), at = displacements(0.5);
    EXPECT_LT((near - at).norm(), 1e-3 * at.norm());
}

/// What is found in a surface has the name of the method, and is not the same for all of them.
TEST(PrecomputeAgain, ByAnotherMethodFindsWhatAFreshModelFinds) {
    Control control;
    const Body needle = make_body(make_box(1, {30, 1, 1}), {1.0, 0.3});
    for (const MethodKind from : {kLinearBem, kConstantBem, kGalerkinBem, kFem})
        for (const MethodKind to : {kLinearBem, kConstantBem, kGalerkinBem, kFem}) {
            const auto first = precompute(needle, make_method(from), control);
            const auto again = precompute_again(*first, needle.material, make_method(to), control);
            const auto fresh = precompute(needle, make_method(to), control);
            std::vector<std::string> found, expected;
            for (const Finding& finding : again->facts().surface_findings) found.push_back(words(finding));
            for (const Finding& finding : fresh->facts().surface_findings) expected.push_back(words(finding));
            EXPECT_EQ(found, expected) << name(from) << " to " << name(to);
        }
}

}  // namespace
}  // namespace elastolab::test
