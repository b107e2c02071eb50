// Rigid grips under forces on a body of large deformations: forces that motions took give these motions again, the
// elastica of a buckled column, tangents by differences, bodies that nothing else holds.
#include "deform/grip_equilibrium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "base/error.hpp"
#include "elasticity/rotation.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"

namespace elastolab {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using test::vertices_where;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A bar along x from the origin. Its right end is a grip; its left end is held, or a grip too.
struct GrippedBar {
    Eigen::Vector3d resultant_at(const GripEquilibrium& at, std::size_t grip) const {
        const Reactions reactions = deformer->reactions(at.values);
        const Grip& its = grips[grip];
        return reactions.forces.middleCols(std::ssize(deformer->set().fixed) + its.begin, its.end - its.begin)
            .rowwise()
            .sum();
    }
    explicit GrippedBar(const Vector3d& size = {3, 1, 1}, int cells = 2, const Material& material = {2.0, 0.3},
                        bool held = true) {
        SurfaceMesh mesh = make_box(cells, size);
        const std::vector<int> left = vertices_where(mesh, [](const auto& p) { return p[0] < 1e-9; });
        const std::vector<int> right = vertices_where(mesh, [&](const auto& p) { return p[0] > size[0] - 1e-9; });
        ConstrainedSet set{.fixed = held ? left : std::vector<int>{}, .handles = right};
        grips = {{0, static_cast<int>(right.size())}};
        if (!held) {
            set.handles.insert(set.handles.end(), left.begin(), left.end());
            grips.push_back({grips[0].end, grips[0].end + static_cast<int>(left.size())});
        }
        middle = Vector3d(size[0], 0.5 * size[1], 0.5 * size[2]);
        deformer = std::make_unique<Deformer>(
            test::precomputed(test::make_body(std::move(mesh), material), {.kind = kNonlinearFem}));
        Control control;
        deformer->constrain(set, control);
    }
    const Positions& vertices() const { return deformer->model().body().surface->vertices; }
    VectorXd values_at(const GripPlace& place) const {
        VectorXd values = VectorXd::Zero(deformer->set().n_values());
        for (int i = 0; i < grips[0].end; ++i) {
            const Vector3d x = vertices().col(deformer->set().handles[static_cast<std::size_t>(i)]);
            values.segment<3>(3 * i) = middle + place.shift + rotation_by(place.turn) * (x - middle) - x;
        }
        return values;
    }
    /// What the right end takes there.
    GripForce force_at(const GripPlace& place) const {
        const Reactions reactions = deformer->reactions(values_at(place));
        const Eigen::Index n = grips[0].end, first = std::ssize(deformer->set().fixed);
        const Vector3d force = reactions.forces.middleCols(first, n).rowwise().sum();
        const Vector3d moment = reactions.moments.middleCols(first, n).rowwise().sum();
        return {force, moment - (middle + place.shift).cross(force)};
    }
    GripEquilibrium find(const std::vector<GripForce>& forces, const GripEquilibrium* before = nullptr) const {
        Control control;
        return find_grip_equilibrium(*deformer, VectorXd::Zero(deformer->set().n_values()), grips, forces, control, {},
                                     before);
    }

    std::vector<Grip> grips;
    Vector3d middle;
    std::unique_ptr<Deformer> deformer;
};

TEST(GripEquilibrium, ForcesThatAMotionTookGiveTheMotion) {
    const GrippedBar bar;
    for (const GripPlace& place : {GripPlace{{0.05, 0.02, -0.03}, Vector3d(0.02, 0.01, -0.03)},
                                   GripPlace{{-0.65, 1.6, 0.1}, Vector3d(0, 0, 70 * kDegree)},
                                   GripPlace{{0.9, 0, 0}, Vector3d(100 * kDegree, 0, 0)}}) {
        const GripEquilibrium found = bar.find({bar.force_at(place)});
        EXPECT_LT((found.places[0].shift - place.shift).norm(), 1e-6) << found.places[0].shift.transpose();
        EXPECT_LT((found.places[0].turn - place.turn).norm(), 1e-6) << found.places[0].turn.transpose();
        EXPECT_LT(found.solves, 40);
        test::print_measured("equilibria on the way", found.solves);
    }
}

TEST(GripEquilibrium, SmallForcesMoveAsLinearTheoryHasIt) {
    const GrippedBar bar;
    const Body& body = bar.deformer->model().body();
    Deformer linear(test::precomputed(body, {.kind = kQuadraticFem}));
    Control control;
    linear.constrain(bar.deformer->set(), control);
    const VectorXd none = VectorXd::Zero(linear.set().n_values());
    const GripStiffness stiffness(linear, none, bar.grips, control);
    const GripForce force{{1e-6, 2e-6, -1e-6}, {3e-6, 0, 1e-6}};
    VectorXd wanted(6);
    wanted << force.force, force.moment;
    const VectorXd motion = stiffness.motions(wanted);
    const GripPlace found = bar.find({force}).places[0];
    EXPECT_LT((found.shift - motion.head<3>()).norm(), 1e-4 * motion.norm());
    EXPECT_LT((found.turn - motion.tail<3>()).norm(), 1e-4 * motion.norm());
}

TEST(GripEquilibrium, ItsTangentIsTheDerivativeOfTheForces) {
    const GrippedBar bar;
    const GripPlace place{{-0.35, 1.2, 0.1}, Vector3d(0.2, 0.1, 0.9)};
    const GripEquilibrium found = bar.find({bar.force_at(place)});
    const double h = 1e-4;
    for (int k = 0; k < 6; ++k) {
        const Eigen::Matrix<double, 6, 1> by = h * Eigen::Matrix<double, 6, 1>::Unit(k);
        const GripForce up = bar.force_at(moved(place, by)), down = bar.force_at(moved(place, -by));
        Eigen::Matrix<double, 6, 1> change;
        change << (up.force - down.force) / (2 * h), (up.moment - down.moment) / (2 * h);
        EXPECT_LT((found.tangent.stiffness().col(k) - change).norm(), 1e-4 * found.tangent.stiffness().norm()) << k;
    }
}

/// Half the change of a force leaves a quarter of the error.
TEST(GripEquilibrium, PlacesUnderOtherForcesAreRightToFirstOrder) {
    const GrippedBar bar;
    const GripForce first{{0, 0.02, 0}, {0, 0, 0.02}}, more{{0.02, 0.01, 0.01}, {0.01, 0, 0}};
    const GripEquilibrium found = bar.find({first});
    std::vector<double> errors;
    for (const double part : {0.2, 0.1}) {
        const std::vector<GripForce> forces{{first.force + part * more.force, first.moment + part * more.moment}};
        const GripPlace guess = found.places_under(forces)[0], truth = bar.find(forces, &found).places[0];
        errors.push_back((guess.shift - truth.shift).norm());
    }
    EXPECT_LT(errors[1], 0.3 * errors[0]);
    EXPECT_GT(errors[1], 0.2 * errors[0]);
}

TEST(GripEquilibrium, ASpringGivesWayWithTheBody) {
    const GrippedBar bar;
    const GripForce pulled{{0.3, 0.2, 0}, {0, 0, 0}, 0.5};
    const GripPlace found = bar.find({pulled}).places[0];
    const GripForce held = bar.force_at(found);
    EXPECT_LT((held.force - (pulled.force - pulled.spring * found.shift)).norm(), 1e-6);
    EXPECT_LT(held.moment.norm(), 1e-6);
}

/// A column that is pressed by more than Euler's load stands no longer straight, though nothing pushes it aside. Its
/// tip is where Euler's elastica has it (S. Timoshenko, J. Gere, Theory of Elastic Stability, section 2.7).
TEST(GripEquilibrium, AColumnBucklesIntoItsElastica) {
    const double length = 20.0, young = 1000.0;
    const GrippedBar column({length, 1, 1.5}, 1, {young, 0.0});
    const double euler = std::numbers::pi * std::numbers::pi * young * 1.5 / 12.0 / (4.0 * length * length);
    const GripPlace straight = column.find({{{-0.8 * euler, 0, 0}, {0, 0, 0}}}).places[0];
    EXPECT_LT(straight.shift.tail<2>().norm(), 1e-3 * length);
    const double angle = 60.0 * kDegree, k = std::sin(0.5 * angle), K = std::comp_ellint_1(k);
    const double load = euler * std::pow(2.0 * K / std::numbers::pi, 2.0);
    const GripEquilibrium found = column.find({{{-load, 0, 0}, {0, 0, 0}}});
    const Vector3d tip = found.places[0].shift / length;
    EXPECT_TRUE(found.tangent.stable());
    EXPECT_NEAR(tip[0], 2.0 * std::comp_ellint_2(k) / K - 2.0, 0.02);
    EXPECT_NEAR(tip.tail<2>().norm(), 2.0 * k / K, 0.02);
    EXPECT_NEAR(found.places[0].turn.norm(), angle, 0.03);
    test::print_measured("equilibria of the column", found.solves);
}

/// Under a moment alone a bar is a part of a circle, up to a whole one: the moment is the same all along, so that
/// nothing else balances. It keeps its direction, and the stiffness is not symmetric.
TEST(GripEquilibrium, AMomentBendsABarIntoACircle) {
    const double length = 10.0, young = 1200.0;
    const GrippedBar bar({length, 1, 1}, 1, {young, 0.0});
    for (const double degrees : {90.0, 175.0, 200.0}) {
        SCOPED_TRACE(degrees);
        const double angle = degrees * kDegree, moment = young / 12.0 * angle / length;
        const GripEquilibrium found = bar.find({{{0, 0, 0}, {0, 0, moment}}});
        const GripPlace& end = found.places[0];
        EXPECT_TRUE(found.tangent.stable());
        EXPECT_NEAR(end.turn.z(), angle, 0.05 * angle);
        EXPECT_LT(end.turn.head<2>().norm(), 0.01);  // of irregular tetrahedra
        const double own = end.turn.z();
        EXPECT_NEAR(end.shift.x(), (std::sin(own) / own - 1.0) * length, 0.02 * length);
        EXPECT_NEAR(end.shift.y(), (1.0 - std::cos(own)) / own * length, 0.02 * length);
    }
}

TEST(GripEquilibrium, OfABodyThatNothingElseHolds) {
    const GrippedBar held, free({3, 1, 1}, 2, {2.0, 0.3}, false);
    const GripForce pull{{0.8, 0, 0}, {0, 0, 0}}, against{{-0.8, 0, 0}, {0, 0, 0}};
    const GripEquilibrium found = free.find({pull, against});
    const Vector3d longer = found.places[0].shift - found.places[1].shift;
    EXPECT_GT(longer[0], 0.5);
    // But for the moment that its irregular tetrahedra put on an end that is held.
    EXPECT_LT((longer - held.find({pull}).places[0].shift).norm(), 2e-3);
    EXPECT_LT((free.resultant_at(found, 0) - pull.force).norm(), 1e-6);
    try {
        free.find({pull, {{-0.7, 0, 0}, {0, 0, 0}}});
        FAIL() << "an answer";
    } catch (const SolveError& error) {
        EXPECT_STREQ(error.what(), kUnbalancedGrips);
    }
}

/// Forces beside each other's line, whose moment another one balances at rest: the bar bends and turns until it is
/// balanced again. Seen from its left end it is a bar that is held there.
TEST(GripEquilibrium, MomentsTurnABodyThatNothingElseHolds) {
    const Vector3d size(4, 1, 1);
    const GrippedBar held(size), free(size, 2, {2.0, 0.3}, false);
    for (const Vector3d& force : {Vector3d(0.06, -0.008, 0), Vector3d(0.02, 0.02, 0.01), Vector3d(0.2, 0.04, 0)}) {
        SCOPED_TRACE(force.transpose());
        const Vector3d moment = -Vector3d(size[0], 0, 0).cross(force);
        const GripEquilibrium found = free.find({{force, {0, 0, 0}}, {-force, moment}});
        EXPECT_TRUE(found.tangent.stable());
        EXPECT_LT(found.solves, 25);
        const GripPlace &right = found.places[0], &left = found.places[1];
        EXPECT_LT(right.turn.norm() + left.turn.norm(), 1.5) << "the bar is not turned for nothing";
        const Eigen::Matrix3d back = rotation_by(left.turn).transpose();
        const Vector3d seen =
            back * (right.shift - left.shift) + (back - Eigen::Matrix3d::Identity()) * Vector3d(size[0], 0, 0);
        const Vector3d truth = held.find({{back * force, {0, 0, 0}}}).places[0].shift;
        EXPECT_LT((seen - truth).norm(), 1e-6 * truth.norm()) << seen.transpose() << "; " << truth.transpose();
        test::print_measured("equilibria on the way", found.solves);
    }
}

/// A soft body turns by rounding and a residual as easily as by such forces: it must not wander.
TEST(GripEquilibrium, SmallForcesMoveABodyThatNothingElseHoldsByLittle) {
    const GrippedBar free({4, 1, 1}, 2, {2.0, 0.3}, false);
    for (double size = 1e-6; size < 0.1; size *= 3.0) {
        const Vector3d force = size * Vector3d(1, 0.3, 0.1), moment = -Vector3d(4, 0, 0).cross(force);
        const GripEquilibrium found = free.find({{force, {0, 0, 0}}, {-force, moment}});
        for (const GripPlace& place : found.places) EXPECT_LT(place.shift.norm(), 20.0 * size) << size;
    }
}

/// Forces in the wrong unit: a bar stretched to 100 times its length, and what is beyond all measure.
TEST(GripEquilibrium, NoMaterialBearsForcesOfAHundredTimesItsStiffness) {
    const GrippedBar bar;
    const auto problem = [&](const Vector3d& force) -> std::string {
        try {
            bar.find({{force, {0, 0, 0}}});
        } catch (const SolveError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(problem({10, 0, 0}), "");
    for (const double size : {400.0, 1e4, 1e10, 1e80})
        for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(-0.5, 0, 1)})
            EXPECT_NE(problem(size * direction).find("check the units"), std::string::npos)
                << size * direction.transpose();
}

/// On a ball with one or two grips of any size, from a soft touch to forces that tear at it. ELASTOLAB_FUZZ: how many.
TEST(GripEquilibrium, RandomForcesEndInAnAnswerOrAClearWord) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
    const Body body = test::make_body(make_sphere(3, 1.0), {1.0, 0.35});
    const auto quadratic = test::precomputed(body, {.kind = kNonlinearFem}),
               linear = test::precomputed(body, {.kind = kNonlinearFem, .elements = ElementDegree::linear});
    const Positions& vertices = body.surface->vertices;
    const char* wanted = std::getenv("ELASTOLAB_FUZZ");
    const int n_trials = wanted != nullptr ? std::atoi(wanted) : 20;
    int n_answers = 0, most_solves = 0, most_iterations = 0;
    for (int trial = 0; trial < n_trials; ++trial) {
        std::vector<char> taken(static_cast<std::size_t>(vertices.cols()), 0);
        const auto patch = [&](double size) {
            const Vector3d direction = vector().normalized();
            std::vector<int> found;
            for (int v = 0; v < vertices.cols(); ++v)
                if (!taken[static_cast<std::size_t>(v)] && (vertices.col(v) - direction).norm() < size) {
                    found.push_back(v);
                    taken[static_cast<std::size_t>(v)] = 1;
                }
            return found;
        };
        ConstrainedSet set{.fixed = patch(0.7), .handles = {}};
        std::vector<Grip> grips;
        std::vector<GripForce> forces;
        for (int g = 0; g < 1 + trial % 2; ++g) {
            const std::vector<int> own = patch(0.45 + 0.2 * uniform(random));
            if (own.empty()) continue;
            const auto begin = static_cast<int>(set.handles.size()), end = begin + static_cast<int>(own.size());
            set.handles.insert(set.handles.end(), own.begin(), own.end());
            grips.push_back({begin, end});
            const double size = std::pow(10.0, 1.5 * uniform(random) - 1.0);
            // A patch of one or two vertices cannot carry a moment.
            GripForce& force = forces.emplace_back();
            force.force = size * vector();
            if (own.size() > 2 && trial % 3 == 0) force.moment = 0.1 * size * vector();
            if (trial % 5 == 0) force.spring = size;
        }
        Deformer deformer(trial % 4 == 0 ? quadratic : linear);
        Control control;
        deformer.constrain(set, control);
        try {
            const GripEquilibrium found =
                find_grip_equilibrium(deformer, VectorXd::Zero(set.n_values()), grips, forces, control);
            ++n_answers;
            most_solves = std::max(most_solves, found.solves);
            most_iterations = std::max(most_iterations, found.iterations);
            const Eigen::Matrix3Xd reactions = deformer.reactions(found.values).forces;
            for (std::size_t g = 0; g < grips.size(); ++g) {
                const Vector3d force =
                    reactions.middleCols(std::ssize(set.fixed) + grips[g].begin, grips[g].end - grips[g].begin)
                        .rowwise()
                        .sum();
                const Vector3d asked = forces[g].force - forces[g].spring * found.places[g].shift;
                EXPECT_LT((force - asked).norm(), 1e-5 * (forces[g].force.norm() + reactions.norm())) << trial;
            }
        } catch (const SolveError& error) {
            const std::string words = error.what();
            EXPECT_TRUE(words.find("crushed") != std::string::npos ||
                        words.find("no motion of theirs") != std::string::npos)
                << words;
        }
    }
    test::print_measured("answers", n_answers);
    test::print_measured("of", n_trials);
    test::print_measured("equilibria at most", most_solves);
    test::print_measured("iterations at most", most_iterations);
    EXPECT_GT(n_answers, 9 * n_trials / 10);
}

}  // namespace
}  // namespace elastolab
