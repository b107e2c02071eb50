// How far linear theory is off, of motions and of loads: in what `solve` reports, and while a person edits.
#include <gmock/gmock.h>

#include <limits>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/words.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/held_bar.hpp"
#include "scene/linear_theory.hpp"
#include "scene/live/live_scene.hpp"
#include "scene/live/simulation.hpp"
#include "scene/solve.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

/// Its shear modulus is about 0.77.
Document bar(double young_modulus = 2.0) { return held_bar(young_modulus, 2); }

/// Its other end is pushed up by this force.
Document pushed_bar(double force, double young_modulus = 2.0) {
    Document document = bar(young_modulus);
    document.loads = {{.name = "push", .select = end_of_bar(), .value = ForceLoad{{0, 0, force}}}};
    return document;
}

double largest(const Eigen::Matrix3Xd& u) { return u.colwise().norm().maxCoeff(); }

/// The mesh is so coarse that it is gauged itself, with elements of the same kind: both answers are known.
TEST(TheoryGauge, OfALoadIsTheDifferenceOfBothTheories) {
    const Document document = pushed_bar(0.02);
    const Solution linear = ten_nodes(document, kQuadraticFem), finite = ten_nodes(document, kNonlinearFem);
    ASSERT_TRUE(linear.linear_theory_error);
    const double expected = largest(finite.displacement - linear.displacement) / largest(finite.displacement);
    EXPECT_GT(expected, 0.05);
    EXPECT_NEAR(*linear.linear_theory_error, expected, 1e-3 * expected);
    EXPECT_FALSE(finite.linear_theory_error);
}

/// Its other end is a handle under this force.
Document gripped_bar(double force, int cells = 2) {
    Document document = held_bar(2.0, cells);
    document.handles = {{.name = "end", .select = end_of_bar()}};
    document.handles[0].force = GripForce{{0, 0, force}, {0, 0, 0}};
    return document;
}

/// Each theory has the handle elsewhere. Fine surfaces are gauged on a coarse one.
TEST(TheoryGauge, OfAForceOnAHandleIsTheDifferenceOfBothTheories) {
    for (const int cells : {2, 9}) {
        const Document document = gripped_bar(0.02, cells);
        const Solution linear = cells == 2 ? ten_nodes(document, kQuadraticFem) : ten_nodes(document, kLinearBem);
        const Solution finite = ten_nodes(gripped_bar(0.02), kNonlinearFem),
                       same = ten_nodes(gripped_bar(0.02), kQuadraticFem);
        ASSERT_TRUE(linear.linear_theory_error) << cells;
        const double expected = largest(finite.displacement - same.displacement) / largest(finite.displacement);
        EXPECT_GT(expected, 0.05);
        EXPECT_NEAR(*linear.linear_theory_error, expected, (cells == 2 ? 5e-3 : 0.3) * expected) << cells;
    }
}

/// Then linear theory's motion is gauged: an equilibrium under the force would be sought for a minute.
TEST(TheoryGauge, ForcesOutOfAllProportionAreNotSoughtFor) {
    const SurfaceMesh box = make_box(1);
    const HandleForces pulled{.grips = {{0, 4}}, .forces = {{.force = {0, 0, 1}}}};
    EXPECT_EQ(in_proportion(pulled, 1.0, box).grips, pulled.grips);
    EXPECT_TRUE(in_proportion(pulled, 2.0, box).grips.empty()) << "its diagonal is the root of 3";
    EXPECT_TRUE(in_proportion(pulled, std::numeric_limits<double>::infinity(), box).grips.empty());
    const Solution far = ten_nodes(gripped_bar(1e9), kQuadraticFem);
    EXPECT_FALSE(far.linear_theory_error);
    EXPECT_THAT(words(far.findings), testing::Contains(testing::HasSubstr("finds no equilibrium")));
}

/// Force and stiffness by the same factor: nothing changes; a weaker force: linear theory is right.
TEST(TheoryGauge, OfALoadGoesByTheLoadOverTheStiffness) {
    const double one = ten_nodes(pushed_bar(0.02), kLinearBem).linear_theory_error.value_or(0.0);
    const double same = ten_nodes(pushed_bar(20.0, 2000.0), kLinearBem).linear_theory_error.value_or(0.0);
    const double weak = ten_nodes(pushed_bar(0.002), kLinearBem).linear_theory_error.value_or(1.0);
    EXPECT_GT(one, 0.05);
    EXPECT_NEAR(same, one, 1e-6);
    EXPECT_LT(weak, 0.1 * one);
}

/// Nonlinear FEM takes Poisson's ratios up to 0.499.
TEST(TheoryGauge, AdvisesNonlinearFemWithARatioThatItTakes) {
    using testing::AllOf, testing::Contains, testing::EndsWith, testing::HasSubstr;
    Document document = pushed_bar(0.02);
    const auto advice = [&](double poisson_ratio) {
        document.material.poisson_ratio = poisson_ratio;
        return words(ten_nodes(document, kLinearBem).findings);
    };
    EXPECT_THAT(advice(0.499), Contains(EndsWith("Choose nonlinear-fem, which follows them.")));
    EXPECT_THAT(advice(0.4999), Contains(AllOf(HasSubstr("Choose nonlinear-fem"), HasSubstr("farther from 1/2"))));
}

/// No body has an equilibrium whose end is pressed to a point.
TEST(TheoryGauge, TellsWhereABodyWouldBeCrushed) {
    Document document = bar();
    document.handles = {
        {.name = "end", .select = end_of_bar(), .motion = AffineMotion{.matrix = -Eigen::Matrix3d::Identity()}}};
    const Solution crushed = ten_nodes(document, kGalerkinBem);
    EXPECT_FALSE(crushed.linear_theory_error);
    EXPECT_THAT(words(crushed.findings), testing::Contains(testing::HasSubstr("finds no equilibrium")));
    EXPECT_THAT(words(ten_nodes(pushed_bar(1e-300), kGalerkinBem).findings),
                testing::Not(testing::Contains(testing::HasSubstr("equilibrium"))));
}

struct LiveTheoryGauge : testing::Test {
    LiveScene scene{bar(), "scene.json"};
    Simulation simulation{[] {}};

    std::vector<int> end() const {
        std::vector<int> vertices;
        for (int v = 0; v < scene.mesh().n_vertices(); ++v)
            if (scene.mesh().vertices(0, v) > 4.0 - 1e-9) vertices.push_back(v);
        return vertices;
    }
    std::optional<TheoryError> found(MethodKind kind = kQuadraticFem) {
        test::wait_until([&] {
            simulation.update(scene, {kind}, {});
            return !simulation.busy() && !simulation.checking();
        });
        return simulation.theory_error();
    }
};

TEST_F(LiveTheoryGauge, FollowsALoadAndTheStiffness) {
    EXPECT_FALSE(found()) << "at rest";
    const int load = scene.add_load(end(), ForceLoad{{0, 0, 0.02}});
    const std::optional<TheoryError> strong = found();
    ASSERT_TRUE(strong);
    EXPECT_FALSE(strong->crushed || strong->turns);
    EXPECT_TRUE(strong->loads);
    EXPECT_NEAR(strong->relative, *ten_nodes(pushed_bar(0.02), kQuadraticFem).linear_theory_error, 1e-6);
    scene.set_material({20.0, 0.3});
    const std::optional<TheoryError> stiff = found();
    ASSERT_TRUE(stiff);
    EXPECT_LT(stiff->relative, 0.2 * strong->relative);
    scene.remove_load(load);
    EXPECT_FALSE(found());
}

TEST_F(LiveTheoryGauge, TellsWhereABodyWouldBeCrushed) {
    const int handle = scene.add_handle(end());
    scene.set_motion(handle, AffineMotion{.matrix = -Eigen::Matrix3d::Identity()});
    const std::optional<TheoryError> error = found();
    ASSERT_TRUE(error);
    EXPECT_TRUE(error->crushed);
}

TEST_F(LiveTheoryGauge, FollowsAHandleUnderAForce) {
    const int handle = scene.add_handle(end());
    scene.set_force(handle, GripForce{{0, 0, 0.02}});
    const std::optional<TheoryError> pushed = found();
    ASSERT_TRUE(pushed);
    EXPECT_FALSE(pushed->loads);
    EXPECT_NEAR(pushed->relative, *ten_nodes(gripped_bar(0.02), kQuadraticFem).linear_theory_error, 1e-3);
    scene.set_force(handle, GripForce{{0, 0, 0.002}});
    const std::optional<TheoryError> weaker = found();
    ASSERT_TRUE(weaker);
    EXPECT_LT(weaker->relative, 0.1 * pushed->relative);
}

}  // namespace
}  // namespace elastolab
