// nonlinear-fem as a method: units, places, what is remembered, stresses, the inside, the error estimate, and refusals.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "base/error.hpp"
#include "deform/surface_stress.hpp"
#include "deform/volume.hpp"
#include "elasticity/neo_hookean.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/load_cases.hpp"
#include "methods/problem.hpp"

namespace elastolab {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::vertices_where;

constexpr double kLargeTolerance = 1e-6;  // of solutions to 1e-8 of the forces

Matrix3d rotation(const Vector3d& axis, double degrees) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized()).toRotationMatrix();
}

/// A bar of this size at this place; its left end is held, its right end can be moved.
struct Bar {
    explicit Bar(double size = 1.0, const Vector3d& place = Vector3d::Zero(), const Material& material = {2.0, 0.3},
                 ElementDegree elements = ElementDegree::quadratic)
        : unit(size), origin(place) {
        SurfaceMesh mesh = make_box(2, Vector3d(3, 1, 1));
        set.fixed = vertices_where(mesh, [](const auto& p) { return p[0] < 1e-9; });
        set.handles = vertices_where(mesh, [](const auto& p) { return p[0] > 3 - 1e-9; });
        mesh.vertices = (size * mesh.vertices).colwise() + place;
        body = test::make_body(std::move(mesh), material);
        Method method{.kind = kNonlinearFem};
        method.elements = elements;
        deformer = std::make_unique<Deformer>(test::precomputed(body, method));
        Control control;
        deformer->constrain(set, control);
    }
    Eigen::VectorXd turned(const Vector3d& axis, double degrees, const Vector3d& shift = Vector3d::Zero()) const {
        Eigen::VectorXd values(3 * std::ssize(set.handles));
        const Vector3d center = origin + unit * Vector3d(3, 0.5, 0.5);
        for (std::size_t i = 0; i < set.handles.size(); ++i) {
            const Vector3d x = body.surface->vertices.col(set.handles[i]);
            values.segment<3>(3 * static_cast<Eigen::Index>(i)) =
                center + rotation(axis, degrees) * (x - center) + unit * shift - x;
        }
        return values;
    }

    double unit;
    Vector3d origin;
    ConstrainedSet set;
    Body body;
    std::unique_ptr<Deformer> deformer;
};

TEST(LargeDeformation, AnswersDependNeitherOnTheUnitOfLengthNorOnThePlace) {
    const Bar here, there(64.0, {1000, -2000, 500});
    Control control;
    const Deformer::Answer a = here.deformer->answer(here.turned({1, 1, 0}, 50), {}, control);
    const Deformer::Answer b = there.deformer->answer(there.turned({1, 1, 0}, 50), {}, control);
    EXPECT_LT((b.displacements / 64.0 - a.displacements).norm(), 1e-9 * a.displacements.norm());
    EXPECT_LT((b.reactions.forces / (64.0 * 64.0) - a.reactions.forces).norm(), 1e-8 * a.reactions.forces.norm());
    EXPECT_NEAR(b.facts->energy / std::pow(64.0, 3), a.facts->energy, 1e-9 * a.facts->energy);
    EXPECT_NEAR(b.facts->largest_stretch, a.facts->largest_stretch, 1e-9);
}

TEST(LargeDeformation, ReactionsAreAboutPresentPositionsAndBalance) {
    const Bar bar(1.0, {10, 20, -5});
    const Reactions reactions = bar.deformer->reactions(bar.turned({0, 0, 1}, 70, {-1, 1, 0}));
    const double force = reactions.forces.colwise().norm().sum(), moment = reactions.moments.colwise().norm().sum();
    EXPECT_LT(reactions.forces.rowwise().sum().norm(), 1e-8 * force);
    EXPECT_LT(reactions.moments.rowwise().sum().norm(), 1e-8 * moment);
}

TEST(LargeDeformation, ReactionsOfAKnownAnswerAreNotSolvedForAgain) {
    const Bar bar;
    Control control;
    const Eigen::VectorXd values = bar.turned({1, 0, 0}, 80);
    const Eigen::VectorXd u = bar.deformer->displace(values);
    const Deformer::Answer again = bar.deformer->answer(values, {.residual = true}, control);
    EXPECT_EQ(again.facts->iterations, 0);
    EXPECT_EQ(again.displacements, u);
    EXPECT_LT(*again.residual, 1e-8);
}

TEST(LargeDeformation, ADragFollowsFromOneEquilibriumToTheNext) {
    const Bar bar;
    Control control;
    DragResponse drag;
    for (const double degrees : {30.0, 60.0, 90.0}) {
        const Eigen::VectorXd values = bar.turned({1, 0, 0}, degrees);
        const Eigen::MatrixXd basis = bar.turned({1, 0, 0}, degrees + 1) - values;
        drag = bar.deformer->drag_response(values, basis, control, kSolveTolerance, {drag.equilibrium, {}});
    }
    Eigen::VectorXd predicted;
    drag.displace(Eigen::VectorXd::Ones(1), predicted);
    const Bar other;
    const Eigen::VectorXd exact = other.deformer->displace(other.turned({1, 0, 0}, 91));
    EXPECT_LT((drag.rest - other.deformer->displace(other.turned({1, 0, 0}, 90))).norm(),
              kLargeTolerance * exact.norm());
    EXPECT_LT((predicted - exact).norm(), 1e-3 * (exact - drag.rest).norm() + 1e-2 * drag.X.norm());
}

/// A handle more, taken hold of where the body is: that is its equilibrium nearly, up to the midpoints of the patch.
TEST(LargeDeformation, AnotherSetBeginsWhereTheBodyIs) {
    const Bar bar;
    Control control;
    const Eigen::VectorXd values = bar.turned({1, 0, 0}, 80.0);
    const Deformer::Answer before = bar.deformer->answer(values, {}, control);
    const std::vector<int> added =
        vertices_where(*bar.body.surface, [](const auto& p) { return p[0] > 1.4 && p[0] < 2.1 && p[2] > 1.0 - 1e-9; });
    ASSERT_GT(added.size(), 3u);
    ConstrainedSet set = bar.set;
    Eigen::VectorXd more(values.size() + 3 * std::ssize(added));
    more.head(values.size()) = values;
    for (std::size_t i = 0; i < added.size(); ++i) {
        set.handles.push_back(added[i]);
        more.segment<3>(values.size() + 3 * static_cast<Eigen::Index>(i)) =
            before.displacements.segment<3>(3 * added[i]);
    }
    const auto answer = [&](const Approach& approach) {
        Method method{.kind = kNonlinearFem};
        method.elements = ElementDegree::quadratic;
        Deformer deformer(test::precomputed(bar.body, method));
        deformer.constrain(set, control);
        return deformer.answer(more, {}, control, approach);
    };
    const Deformer::Answer here = answer({.start = for_another_set(*before.equilibrium)}), from_rest = answer({});
    EXPECT_LT((here.displacements - before.displacements).norm(), 1e-2 * before.displacements.norm());
    EXPECT_LT((here.displacements - from_rest.displacements).norm(), kLargeTolerance * before.displacements.norm());
    EXPECT_LE(here.facts->iterations, from_rest.facts->iterations);
}

TEST(LargeDeformation, IsGivenUpAfterAsManyStepsAsAreAllowed) {
    const Bar bar;
    Control control;
    const Eigen::VectorXd goal = bar.turned({0, 0, 1}, 90);
    Approach approach{.path = bar.turned({0, 0, 1}, 45), .most_steps = 1};  // which take some each
    EXPECT_THROW(bar.deformer->displace(goal, control, kSolveTolerance, approach), NoEquilibriumError);
    approach.most_steps = kMostEquilibriumSteps;
    const Eigen::VectorXd u = bar.deformer->displace(goal, control, kSolveTolerance, approach);
    EXPECT_LT((u - bar.deformer->displace(goal)).norm(), kLargeTolerance * u.norm());
}

TEST(LargeDeformation, SmallMotionsAgreeWithQuadraticFem) {
    const Bar bar;
    const Eigen::VectorXd values = 1e-6 * bar.turned({0, 1, 1}, 30, {0.1, 0.2, 0.3});
    const Eigen::VectorXd linear =
        test::displaced(test::precomputed(bar.body, {.kind = kQuadraticFem}), bar.set, values);
    EXPECT_LT((bar.deformer->displace(values) - linear).norm(), 1e-5 * linear.norm());
}

/// Stretch along the bar with the lateral contraction of free sides: everywhere the same stress.
TEST(LargeDeformation, CauchyStressesOfAHomogeneousStateAreExactOnTheSurfaceAndInside) {
    const Material material{2.0, 0.3};
    const NeoHookean law(material);
    double lateral = 1.0;
    for (int i = 0; i < 50; ++i) {
        const auto P = [&](double s) {
            return law.first_piola(Matrix3d(Vector3d(1.5, s, s).asDiagonal()) - Matrix3d::Identity())(1, 1);
        };
        lateral -= P(lateral) * 1e-6 / (P(lateral + 1e-6) - P(lateral));
    }
    const Matrix3d R = rotation({1, 2, 3}, 60), F = R * Vector3d(1.5, lateral, lateral).asDiagonal();
    const Matrix3d exact = law.cauchy(F - Matrix3d::Identity());
    SurfaceMesh mesh = make_box(2, Vector3d(2, 1, 1));
    const Body body = test::make_body(mesh, material);
    const std::vector<int> ends = vertices_where(mesh, [](const auto& p) { return p[0] < 1e-9 || p[0] > 2 - 1e-9; });
    Deformer deformer(test::precomputed(body, {.kind = kNonlinearFem}));
    Control control;
    deformer.constrain({{}, ends}, control);
    const Eigen::VectorXd all = ((F - Matrix3d::Identity()) * mesh.vertices).reshaped();
    const Deformer::Answer answer = deformer.answer(test::at(all, ends), {}, control);
    EXPECT_LT((answer.displacements - all).norm(), kLargeTolerance * all.norm());
    Positions points(3, 3);
    points << 1.0, 0.5, 1.9, 0.5, 0.2, 0.6, 0.5, 0.9, 0.3;
    const InteriorValues inside = deformer.interior_field(test::at(all, ends), control)->at(points, control);
    for (int i = 0; i < 3; ++i) {
        EXPECT_LT((stress_tensor(inside.stresses.col(0).segment<6>(6 * i)) - exact).norm(), 1e-5 * exact.norm());
        EXPECT_LT((inside.displacements.col(0).segment<3>(3 * i) - (F - Matrix3d::Identity()) * points.col(i)).norm(),
                  1e-5);
    }
    const Eigen::Matrix3Xd tractions = vertex_tractions(mesh, ends, answer.reactions.forces);
    const Eigen::MatrixXd surface = surface_stress(mesh, material, answer.displacements, tractions, true);
    for (int v = 0; v < mesh.n_vertices(); ++v) {
        const double x = mesh.vertices(0, v);
        if (x < 0.1 || x > 1.9) continue;  // ends' triangles take mean tractions
        EXPECT_LT((stress_tensor(surface.col(v)) - exact).norm(), 1e-4 * exact.norm()) << v;
    }
}

TEST(LargeDeformation, TheInsideIsThatOfTheAnswer) {
    const Bar bar(16.0, {100, 0, 0});
    const Eigen::VectorXd values = bar.turned({1, 0, 0}, 100), u = bar.deformer->displace(values);
    Control control;
    const std::shared_ptr<const Model> model(std::shared_ptr<const Model>(), &bar.deformer->model());
    const std::shared_ptr<const Volume> volume = Volume::of(model, control);
    const Positions& rest = volume->mesh().vertices;
    const Eigen::VectorXd all = bar.deformer->interior_field(values, control)->at(rest, control).displacements;
    EXPECT_LT((all.head(u.size()) - u).norm(), 1e-8 * u.norm());
    const Positions x = rest + all.reshaped(3, rest.cols());
    int n_inverted = 0;
    for (const auto& t : volume->mesh().tetrahedra.colwise()) {
        Matrix3d edges;
        for (int i = 0; i < 3; ++i) edges.col(i) = x.col(t[i + 1]) - x.col(t[0]);
        n_inverted += edges.determinant() <= 0.0;
    }
    EXPECT_EQ(n_inverted, 0);
}

/// Ten nodes are judged by four, and four by ten.
class LargeEstimate : public testing::TestWithParam<ElementDegree> {};

TEST_P(LargeEstimate, IsOfTheSizeOfTheError) {
    const Bar bar(1.0, Vector3d::Zero(), {2.0, 0.3}, GetParam());
    Control control;
    const Eigen::VectorXd values = bar.turned({0, 0, 1}, 60);
    const Deformer::Answer answer = bar.deformer->answer(values, {.check = true}, control);
    ASSERT_TRUE(answer.check);
    SurfaceMesh fine = make_box(4, Vector3d(3, 1, 1));
    const Body body = test::make_body(fine, bar.body.material);
    Deformer reference(test::precomputed(body, {.kind = kNonlinearFem}));
    ConstrainedSet set{vertices_where(fine, [](const auto& p) { return p[0] < 1e-9; }),
                       vertices_where(fine, [](const auto& p) { return p[0] > 3 - 1e-9; })};
    reference.constrain(set, control);
    Eigen::VectorXd fine_values(3 * std::ssize(set.handles));
    for (std::size_t i = 0; i < set.handles.size(); ++i) {
        const Vector3d x = fine.vertices.col(set.handles[i]), center(3, 0.5, 0.5);
        fine_values.segment<3>(3 * static_cast<Eigen::Index>(i)) = center + rotation({0, 0, 1}, 60) * (x - center) - x;
    }
    const Eigen::VectorXd truth = reference.displace(fine_values);
    double largest = 0.0, error = 0.0;
    for (int v = 0; v < bar.body.surface->n_vertices(); ++v) {
        Eigen::Index same = 0;
        const double apart =
            (fine.vertices.colwise() - bar.body.surface->vertices.col(v)).colwise().norm().minCoeff(&same);
        ASSERT_LT(apart, 1e-9);
        const Vector3d exact = truth.segment<3>(3 * same);
        largest = std::max(largest, exact.norm());
        error = std::max(error, (answer.displacements.segment<3>(3 * v) - exact).norm());
    }
    test::print_measured("error over estimate", error / largest / answer.check->relative_error);
    const bool ten_nodes = GetParam() == ElementDegree::quadratic;
    EXPECT_GT(answer.check->relative_error, (ten_nodes ? 0.5 : 0.2) * error / largest);
    EXPECT_LT(answer.check->relative_error, (ten_nodes ? 2.0 : 8.0) * error / largest);
}

INSTANTIATE_TEST_SUITE_P(Degrees, LargeEstimate, testing::Values(ElementDegree::linear, ElementDegree::quadratic));

TEST(LargeDeformation, NearlyIncompressibleBodiesAreTakenUpTo0499AndRefusedBeyond) {
    const Bar bar(1.0, Vector3d::Zero(), {1.0, 0.499});
    const Eigen::VectorXd u = bar.deformer->displace(bar.turned({1, 0, 0}, 90));
    EXPECT_TRUE(u.allFinite());
    for (const double nu : {0.4995, 0.5}) {
        const std::string why = refusal({.kind = kNonlinearFem}, nu);
        EXPECT_NE(why.find("poisson_ratio"), std::string::npos);
        EXPECT_NE(why.find("0.499"), std::string::npos);
    }
    EXPECT_EQ(refusal({.kind = kNonlinearFem}, 0.499), "");
}

/// A balloon bears a pressure of a quarter of its modulus or so; nothing is crushed beyond it, and nothing was moved.
TEST(LargeDeformation, APressureBeyondWhatABalloonBearsIsRefusedWithItsShare) {
    const SurfaceMesh mesh = make_hollow_sphere(3);
    const UnitLoad inside =
        unit_pressure(mesh, test::triangles_where(mesh, [](const Vector3d& x) { return x.norm() < 0.75; }));
    Deformer deformer(test::precomputed(test::make_body(mesh, {1.0, 0.3}), {.kind = kNonlinearFem}));
    Control control;
    deformer.constrain({{}, {}, {inside}}, control);
    EXPECT_LT(*deformer.answer(Eigen::VectorXd::Constant(1, 0.2), {.residual = true}, control).residual, 1e-7);
    try {
        deformer.answer(Eigen::VectorXd::Constant(1, 0.6), {}, control);
        FAIL();
    } catch (const NoEquilibriumError& error) {
        const std::string words = error.what(), begin = "An equilibrium was found up to ";
        EXPECT_EQ(words.find("crushed"), std::string::npos) << words;
        EXPECT_EQ(words.find("motions"), std::string::npos) << words;
        ASSERT_NE(words.find(begin), std::string::npos) << words;
        const double share = std::stod(words.substr(words.find(begin) + begin.size())) / 100.0;
        EXPECT_GT(share * 0.6, 0.2) << words;
        EXPECT_LT(share * 0.6, 0.4) << words;
    }
}

/// Random handles on a ball, pulled, turned and sheared at random, many of them absurd.
TEST(LargeDeformation, RandomHandlesEndInAnAnswerOrAClearWord) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const SurfaceMesh mesh = make_sphere(3, 1.0);
    const Body body = test::make_body(mesh, {1.0, 0.35});
    const auto quadratic = test::precomputed(body, {.kind = kNonlinearFem}),
               linear = test::precomputed(body, {.kind = kNonlinearFem, .elements = ElementDegree::linear});
    int n_answers = 0, n_words = 0;
    const char* wanted = std::getenv("ELASTOLAB_FUZZ");
    const int n_trials = wanted != nullptr ? std::atoi(wanted) : 40;
    for (int trial = 0; trial < n_trials; ++trial) {
        ConstrainedSet set;
        std::vector<char> taken(static_cast<std::size_t>(mesh.n_vertices()), 0);
        const auto patch = [&](double size) {
            const Vector3d direction = Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
            std::vector<int> vertices;
            for (int v = 0; v < mesh.n_vertices(); ++v)
                if (!taken[static_cast<std::size_t>(v)] && (mesh.vertices.col(v) - direction).norm() < size) {
                    vertices.push_back(v);
                    taken[static_cast<std::size_t>(v)] = 1;
                }
            return vertices;
        };
        set.fixed = patch(0.6);
        std::vector<Eigen::VectorXd> parts;
        for (int handle = 0; handle < 1 + trial % 3; ++handle) {
            const std::vector<int> vertices = patch(0.4 + 0.2 * uniform(random));
            const double size = std::pow(10.0, uniform(random));
            Matrix3d map = rotation({uniform(random), uniform(random), uniform(random)}, 180.0 * uniform(random));
            if (trial % 5 == 0) map += 0.3 * Matrix3d::NullaryExpr([&] { return uniform(random); });
            const Vector3d shift = 0.5 * size * Vector3d(uniform(random), uniform(random), uniform(random));
            for (const int v : vertices) {
                set.handles.push_back(v);
                const Vector3d x = mesh.vertices.col(v);
                parts.emplace_back(map * x + shift - x);
            }
        }
        Eigen::VectorXd values(3 * std::ssize(parts));
        for (std::size_t i = 0; i < parts.size(); ++i) values.segment<3>(3 * static_cast<Eigen::Index>(i)) = parts[i];
        Deformer deformer(trial % 4 == 0 ? quadratic : linear);
        Control control;
        deformer.constrain(set, control);
        try {
            const Deformer::Answer answer = deformer.answer(values, {.residual = true}, control);
            EXPECT_LT(*answer.residual, 1e-7) << trial;
            EXPECT_TRUE(answer.displacements.allFinite()) << trial;
            ++n_answers;
        } catch (const NoEquilibriumError& error) {
            EXPECT_NE(std::string(error.what()).find("crushed"), std::string::npos);
            ++n_words;
        }
    }
    test::print_measured("answers", n_answers);
    test::print_measured("without equilibrium", n_words);
    EXPECT_GT(n_answers, n_trials / 3);
}

}  // namespace
}  // namespace elastolab
