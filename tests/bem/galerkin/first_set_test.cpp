// A first constrained set that Galerkin BEM solves by itself, before what further sets take over is there.
#include <gtest/gtest.h>

#include <thread>

#include "bem/galerkin/method.hpp"
#include "bem/galerkin/solvers.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "methods/problem.hpp"
#include "study/error/organic_body.hpp"

namespace elastolab::test {
namespace {

constexpr double kSame = 1e-10;

Method at_once() { return {.kind = kGalerkinBem, .first_set_alone = true}; }

/// A cube that is held at one face, of which there is much, and pulled and pressed at another.
struct PulledCube {
    SurfaceMesh surface = make_box(6);
    ConstrainedSet set;

    PulledCube() {
        set.fixed = vertices_where(surface, [](const Eigen::Vector3d& v) { return v.x() < kEdge; });
        set.handles =
            vertices_where(surface, [](const Eigen::Vector3d& v) { return v.x() > 1.0 - kEdge && v.y() > 0.6; });
        std::vector<int> on_top;
        for (int t = 0; t < surface.n_triangles(); ++t) {
            const Eigen::Vector3d middle = surface.vertices(Eigen::all, surface.triangles.col(t)).rowwise().mean();
            if (middle.z() > 1.0 - kEdge && middle.x() > 0.3 && middle.x() < 0.7) on_top.push_back(t);
        }
        set.loads = {unit_pressure(surface, on_top)};
    }
    /// A handle more.
    ConstrainedSet further_set() const {
        ConstrainedSet further = set;
        for (const int v :
             vertices_where(surface, [](const Eigen::Vector3d& x) { return x.x() > 1.0 - kEdge && x.y() < 0.2; }))
            further.handles.push_back(v);
        return further;
    }
    std::shared_ptr<const Model> model(const Method& method) const {
        Control control;
        return precompute(make_body(surface), method, control);
    }
};

Deformer constrained(const std::shared_ptr<const Model>& model, const ConstrainedSet& set) {
    Control control;
    Deformer deformer(model);
    deformer.constrain(set, control);
    return deformer;
}

void expect_same_answers(const Deformer& deformer, const Deformer& expected) {
    const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(expected.set().n_values(), -0.1, 0.2);
    Control control;
    const Deformer::Answer answer = deformer.answer(values, {.residual = true}, control);
    const Deformer::Answer truth = expected.answer(values, {}, control);
    EXPECT_LT(off(answer.displacements, truth.displacements), kSame);
    EXPECT_LT((answer.reactions.forces - truth.reactions.forces).norm(), kSame * truth.reactions.forces.norm());
    EXPECT_LT(answer.residual.value(), 1e-9);
}

TEST(FirstSet, IsAnsweredLikeAnyOtherAndFurtherOnesAreTakenOver) {
    const PulledCube cube;
    const auto model = cube.model(at_once()), usual = cube.model({.kind = kGalerkinBem});
    EXPECT_TRUE(model->serves_sets()) << "nothing is owed yet";
    expect_same_answers(constrained(model, cube.set), constrained(usual, cube.set));
    EXPECT_FALSE(model->serves_sets()) << "the first one was solved by itself";
    expect_same_answers(constrained(model, cube.further_set()), constrained(usual, cube.further_set()));
    EXPECT_TRUE(model->serves_sets());
    expect_same_answers(constrained(model, cube.set), constrained(usual, cube.set));
    EXPECT_EQ(model->facts().memory_bytes, usual->facts().memory_bytes);
}

TEST(FirstSet, IsNotSolvedByItselfWhereThatIsNoSooner) {
    const PulledCube cube;
    const ConstrainedSet only_pressed{.fixed = cube.set.fixed, .handles = {}, .loads = cube.set.loads};
    const ConstrainedSet few{.fixed = {cube.set.fixed[0], cube.set.fixed[1], cube.set.fixed[20]},
                             .handles = {cube.set.handles[0]}};
    for (const ConstrainedSet& set : {only_pressed, few}) {
        const auto model = cube.model(at_once());
        expect_same_answers(constrained(model, set), constrained(cube.model({.kind = kGalerkinBem}), set));
        EXPECT_TRUE(model->serves_sets());
    }
    EXPECT_FALSE(is_sooner_alone(3000, 9, 0));
    EXPECT_TRUE(is_sooner_alone(3000, 600, 900));
}

/// What moves least is found from the columns.
TEST(FirstSet, ThatDoesNotHoldTheBodyIsAnsweredByColumns) {
    const PulledCube cube;
    const std::vector<int> edge =
        vertices_where(cube.surface, [](const Eigen::Vector3d& v) { return v.x() < kEdge && v.y() < kEdge; });
    ASSERT_GT(edge.size(), 2u);
    const ConstrainedSet hinge{.fixed = {}, .handles = edge};
    const auto model = cube.model(at_once()), usual = cube.model({.kind = kGalerkinBem});
    const Eigen::VectorXd values = Eigen::VectorXd::Constant(hinge.n_values(), 0.1);
    EXPECT_LT(off(constrained(model, hinge).displace(values), constrained(usual, hinge).displace(values)), 1e-8);
    EXPECT_TRUE(model->serves_sets());
}

/// The factor is made in the place of what it is made of.
TEST(FirstSet, AFactorThatWasStoppedIsMadeAnew) {
    const PulledCube cube;
    const auto model = cube.model(at_once()), usual = cube.model({.kind = kGalerkinBem});
    constrained(model, cube.set);
    Control stopped;
    stopped.cancel();
    Deformer deformer(model);
    EXPECT_THROW(deformer.constrain(cube.further_set(), stopped), Cancelled);
    EXPECT_FALSE(model->serves_sets());
    expect_same_answers(constrained(model, cube.further_set()), constrained(usual, cube.further_set()));
    EXPECT_TRUE(model->serves_sets());
}

TEST(FirstSet, ThatWasStoppedIsTriedAgain) {
    const PulledCube cube;
    const auto model = cube.model(at_once());
    Control stopped;
    stopped.cancel();
    Deformer deformer(model);
    EXPECT_THROW(deformer.constrain(cube.set, stopped), Cancelled);
    expect_same_answers(constrained(model, cube.set), constrained(cube.model({.kind = kGalerkinBem}), cube.set));
    EXPECT_FALSE(model->serves_sets());
}

TEST(FirstSet, OfManyThreadsOneIsTheFirst) {
    const PulledCube cube;
    const auto model = cube.model(at_once());
    const Deformer expected = constrained(cube.model({.kind = kGalerkinBem}), cube.set);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] { expect_same_answers(constrained(model, cube.set), expected); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_TRUE(model->serves_sets());
}

TEST(FirstSet, IsOfEachSolidByItself) {
    const SurfaceMesh surface = joined(make_box(4), moved(make_box(4), {3.0, 0.0, 0.0}));
    const auto where = [&](double x) {
        return vertices_where(surface, [x](const Eigen::Vector3d& v) { return std::abs(v.x() - x) < kEdge; });
    };
    const ConstrainedSet of_one{.fixed = where(0.0), .handles = where(1.0)};
    ConstrainedSet of_both = of_one;
    for (const int v : where(3.0)) of_both.fixed.push_back(v);
    for (const int v : where(4.0)) of_both.handles.push_back(v);
    Control control;
    const auto model = precompute(make_body(surface), at_once(), control);
    const auto usual = precompute(make_body(surface), {.kind = kGalerkinBem}, control);
    expect_same_answers(constrained(model, of_one), constrained(usual, of_one));
    EXPECT_FALSE(model->serves_sets());
    expect_same_answers(constrained(model, of_both), constrained(usual, of_both));
    EXPECT_FALSE(model->serves_sets()) << "the second solid had its first";
    expect_same_answers(constrained(model, of_both), constrained(usual, of_both));
    EXPECT_TRUE(model->serves_sets());
}

}  // namespace
}  // namespace elastolab::test
