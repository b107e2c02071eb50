#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/error_estimate.hpp"
#include "bem/galerkin/method.hpp"
#include "elasticity/rigid_motion.hpp"
#include "fem/method.hpp"
#include "fem/quadratic/method.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "mesh/meshes.hpp"
#include "mesh/primitives.hpp"
#include "mesh/refine.hpp"
#include "methods/finer_mesh.hpp"
#include "methods/load_cases.hpp"
#include "methods/organic_cases.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

SurfaceMesh flattened(SurfaceMesh mesh, double thickness) {
    mesh.vertices.row(2) *= thickness;
    return mesh;
}

std::vector<CoarseAndFine> cases() {
    const auto left = [](const auto& x) { return x[0] < 1e-9; };
    const auto tip = [](double length) { return [length](const auto& x) { return x[0] > length - 1e-9; }; };
    const auto middle = [](const auto& x) { return x[0] > 3.9 && x[0] < 5.1; };
    return {{"cube",
             make_box(4),
             make_box(12),
             left,
             [](const auto& x) { return x[0] > 1.0 - 1e-9 && x[1] > 0.49 && x[2] > 0.49; },
             {0.1, 0.1, 0.0}},
            {"bar", make_box(1, {4, 1, 1}), make_box(5, {4, 1, 1}), left, tip(4.0), {0.0, 0.0, 0.4}},
            {"needle", make_box(1, {10, 1, 1}), make_box(4, {10, 1, 1}), left, tip(10.0), {0.0, 0.0, 1.0}},
            {"needle with a free end", make_box(1, {10, 1, 1}), make_box(4, {10, 1, 1}), left, middle, {0, 0, 0.3}},
            {"plate",
             flattened(make_box(1, {8, 8, 1}), 0.8),
             flattened(make_box(3, {8, 8, 1}), 0.8),
             left,
             tip(8.0),
             {0.0, 0.0, 1.6}}};
}

TEST(DiscretisationCheck, EstimatesTheLargestErrorWithinAFactorOfThree) {
    for (const CoarseAndFine& example : cases()) {
        const Eigen::VectorXd truth = truth_of(example, {.kind = kLinearBem});
        for (const Tractions tractions : {Tractions::discontinuous, Tractions::restricted}) {
            Control control;
            Deformer deformer(precomputed(make_body(example.coarse), make_method(kLinearBem, tractions)));
            ConstrainedSet set;
            const Eigen::VectorXd values = values_of(example, example.coarse, set);
            deformer.constrain(set, control);
            const DiscretisationCheck check = deformer.discretisation_check(values, control).value();
            const double error = error_against(truth, deformer.displace(values));
            print_measured(example.name + ", " + std::string(name(tractions)) + ", largest error", error);
            print_measured(example.name + ", " + std::string(name(tractions)) + ", estimate", check.relative_error);
            EXPECT_GT(check.relative_error, error / 3.0) << example.name << " " << name(tractions);
            EXPECT_LT(check.relative_error, error * 3.0) << example.name << " " << name(tractions);
            EXPECT_EQ(findings_of_answer(deformer, {.check = check}).empty(),
                      check.relative_error < 0.05 && check.relative_force_error < 0.05);
        }
    }
}

/// A cavity under pressure has no rim that would show how coarse it is.
TEST(DiscretisationCheck, OfGalerkinSeesALoadedCavity) {
    for (const int cells : {3, 6}) {
        const RefinedSurface coarse = unrefined(make_hollow_sphere(cells)), fine = refine_all(coarse);
        const auto answer = [](const RefinedSurface& surface, std::vector<int> fixed, bool check) {
            Control control;
            Deformer deformer(precomputed(make_body(surface.mesh), {.kind = kGalerkinBem}));
            deformer.constrain(
                {std::move(fixed),
                 {},
                 {unit_pressure(surface.mesh,
                                triangles_where(surface.mesh, [](const auto& x) { return x.norm() < 0.75; }))}},
                control);
            return deformer.answer(Eigen::VectorXd::Constant(1, 1e-2), {.check = check}, control);
        };
        std::vector<int> cap = vertices_where(coarse.mesh, [](const auto&x) { return x[2] < -0.7; }), fine_cap = cap;
        const auto is_held = [&](int v) { return std::find(cap.begin(), cap.end(), v) != cap.end(); };
        for (std::size_t i = 0; i < fine.cuts.size(); ++i)
            if (is_held(fine.cuts[i].ends[0]) && is_held(fine.cuts[i].ends[1]))
                fine_cap.push_back(coarse.mesh.n_vertices() + static_cast<int>(i));
        const auto found = answer(coarse, cap, true);
        const Eigen::VectorXd better = answer(fine, fine_cap, false).displacements.head(found.displacements.size()),
                              truth = better + (better - found.displacements) / 3.0;  // errors fall by the square
        const double error = error_against(truth, found.displacements), told = found.check.value().relative_error;
        print_measured(std::to_string(cells) + " cells: largest error", error);
        print_measured(std::to_string(cells) + " cells: estimate", told);
        EXPECT_GT(told, error / 1.5) << cells;
        EXPECT_LT(told, error * 2.0) << cells;
    }
}

/// A coarse needle held at one end and bent in the middle: its free end, which nobody touches, follows too far.
TEST(DiscretisationCheck, NamesTheFreeEndThatMovesTooFar) {
    const CoarseAndFine example = cases()[3];
    Control control;
    Deformer deformer(precomputed(make_body(example.coarse), make_method(kLinearBem, Tractions::restricted)));
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.coarse, set);
    deformer.constrain(set, control);
    const DiscretisationCheck check = deformer.discretisation_check(values, control).value();
    EXPECT_GT(error_against(truth_of(example, {.kind = kLinearBem}), deformer.displace(values)), 0.08);
    EXPECT_GT(example.coarse.vertices(0, check.vertex), 9.0);
    EXPECT_THAT(words(findings_of_answer(deformer, {.check = check})),
                testing::Contains(testing::HasSubstr("Choose galerkin-bem")));
}

TEST(DiscretisationCheck, IsTheSameForAllUpdates) {
    const CoarseAndFine example = cases()[0];
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.coarse, set);
    const auto check = [&](Mode mode, Update update, Tractions tractions, std::uint64_t column_memory) {
        Method method = make_method(kLinearBem, tractions, mode, update);
        if (column_memory == 0) method.column_memory = 0;
        Control control;
        Deformer deformer(precomputed(make_body(example.coarse), method));
        deformer.constrain(set, control);
        return deformer.discretisation_check(values, control).value();
    };
    for (const Tractions tractions : kAllTractions) {
        const DiscretisationCheck expected = check(Mode::on_demand, Update::reduced, tractions, 1);
        for (const DiscretisationCheck& other :
             {check(Mode::on_demand, Update::direct, tractions, 1),
              check(Mode::on_demand, Update::reduced, tractions, 0), check(Mode::full, Update::eqn9, tractions, 1),
              check(Mode::full, Update::direct, tractions, 1)}) {
            EXPECT_NEAR(other.relative_error, expected.relative_error, 1e-9) << name(tractions);
            EXPECT_NEAR(other.relative_force_error, expected.relative_force_error, 1e-8) << name(tractions);
            EXPECT_EQ(other.vertex, expected.vertex) << name(tractions);
        }
    }
}

TEST(DiscretisationCheck, FindsNothingInARotation) {
    const SurfaceMesh mesh = make_box(3);
    const auto held = vertices_where(mesh, [](const auto& x) { return x[0] < 0.4; });
    const Eigen::VectorXd values = at(rigid_motion(mesh.vertices, {0.1, 0.0, 0.2}, {0.3, -0.5, 0.8}), held);
    for (const Method& method : method_variants()) {
        Control control;
        Deformer deformer(precomputed(make_body(mesh), method));
        deformer.constrain({{}, held}, control);
        const auto check = deformer.discretisation_check(values, control);
        ASSERT_TRUE(check.has_value()) << describe(method);
        if (method.kind == kConstantBem) continue;                   // resists a rotation
        EXPECT_LT(check->relative_error, 1e-4) << describe(method);  // integrals to five digits
        EXPECT_LT(check->relative_force_error, 1e-4) << describe(method);
    }
}

/// A bar of one cell across, which is judged by halving all of it, beside a cube, which is judged by finer rims.
TEST(DiscretisationCheck, OfTwoSolidsIsThatOfEach) {
    const SurfaceMesh bar = make_box(1, {4, 1, 1});
    SurfaceMesh cube = make_box(5);
    cube.vertices.row(2).array() += 3.0;
    const auto check = [](const SurfaceMesh& mesh) {
        const auto held = vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; });
        // The end of the bar, and the far face of the cube, which moves a tenth as far.
        const auto pulled =
            vertices_where(mesh, [](const auto& x) { return x[0] > 4.0 - 1e-9 || (x[2] > 2.0 && x[0] > 1.0 - 1e-9); });
        Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * std::ssize(pulled));
        for (std::size_t i = 0; i < pulled.size(); ++i)
            values[3 * static_cast<Eigen::Index>(i) + 2] = mesh.vertices(0, pulled[i]) > 2.0 ? 0.4 : 0.04;
        Control control;
        Deformer deformer(precomputed(make_body(mesh), {.kind = kGalerkinBem}));
        deformer.constrain({held, pulled}, control);
        return deformer.discretisation_check(values, control).value();
    };
    const DiscretisationCheck both = check(joined(bar, cube)), first = check(bar), second = check(cube);
    Eigen::VectorXd errors(first.displacement_error.size() + second.displacement_error.size());
    errors << first.displacement_error, second.displacement_error;
    EXPECT_LT((both.displacement_error - errors).norm(), 1e-9 * errors.norm());
    EXPECT_NEAR(both.relative_error, first.relative_error, 1e-9 * first.relative_error);
}

/// A plate on which Galerkin BEM integrates far longer than linear BEM is not judged by it, and the user is told.
TEST(DiscretisationCheck, IsLeftOutWhereItTakesTenTimesAsLongAsTheAnswer) {
    Control control;
    for (const bool thin : {false, true}) {
        const SurfaceMesh mesh = flattened(make_box(5), thin ? 1e-6 : 0.3);
        const auto ends = vertices_where(mesh, [](const auto& x) { return x[0] < kEdge || x[0] > 1.0 - kEdge; });
        EXPECT_EQ(galerkin_reference_memory(mesh, Method{.kind = kLinearBem}, ends) == 0, thin);
        Deformer deformer(precomputed(make_body(mesh), Method{.kind = kLinearBem}));
        deformer.constrain({{}, ends}, control);
        const Deformer::Answer answer =
            deformer.answer(Eigen::VectorXd::LinSpaced(3 * std::ssize(ends), 0.0, 0.1), {.check = true}, control);
        EXPECT_EQ(answer.check.has_value(), !thin);
        const auto told = words(findings_of_answer(deformer, answer));
        EXPECT_EQ(std::any_of(told.begin(), told.end(),
                              [](const std::string& text) { return text.find("not estimated") != std::string::npos; }),
                  thin);
    }
}

/// True and estimated errors of one answer.
struct Judged {
    std::string what;
    double error = 0.0, estimate = 0.0;

    bool within(double factor) const { return estimate < factor * error && error < factor * estimate; }
};

std::vector<Judged> judge(const OrganicCase& body, const std::string& motion, MethodKind kind,
                          const Eigen::VectorXd& values, const KnownAnswer& truth, Deformer& deformer) {
    Control control;
    const Deformer::Answer answer = deformer.answer(values, {.check = true}, control);
    const std::string what = body.name + " " + motion + ", " + std::string(name(kind));
    std::vector<Judged> judged = {
        {what + ", displacements", displacement_error(answer.displacements, truth.displacements),
         answer.check.value().relative_error},
        {what + ", reactions", reaction_error(body, answer.reactions, truth.reactions),
         answer.check->relative_force_error}};
    for (const Judged& one : judged)
        std::printf("[ measured ] %s: error %.3f, estimate %.3f%s\n", one.what.c_str(), one.error, one.estimate,
                    one.within(3.0) ? "" : "  <- off");
    const std::vector<std::string> told = words(findings_of_answer(deformer, answer));
    if (judged[0].error > 0.1) {
        EXPECT_THAT(told, testing::Contains(testing::HasSubstr("displacements"))) << what;
    }
    if (judged[1].error > 0.1) {
        EXPECT_THAT(told, testing::Contains(testing::HasSubstr("forces"))) << what;
    }
    return judged;
}

/// The shares of the error in error_estimate.cpp (bem and fem) were chosen on other bodies: a rabbit, a potato, a bumpy
/// sphere of another phase and a thicker tube.
TEST(DiscretisationCheck, IsWithinAFactorOfThreeOnOrganicBodiesInNineOfTenCasesAndNeverSilent) {
    const std::vector<std::pair<OrganicCase, double>> bodies = {
        {organic_case(make_cactus(220)), 0.3},
        {held_below("bumpy sphere", make_bumpy_sphere(7, 1.7), {-0.8, 0.5, 0.4}, 0.12, 0.55), 0.45},
        {held_below("bent tube", make_bent_tube(2, 0.35, 4.0, 3.0), {0.1, 0.3, 1.0}, 0.15, 0.6), 0.0},
        {held_below("torus", make_torus(4), {1.0, 0.0, 0.2}, 0.15, 0.7), 0.49}};
    int good = 0, all = 0;
    for (const auto& [body, nu] : bodies) {
        ASSERT_GT(body.set.fixed.size(), 3u) << body.name;
        ASSERT_GT(body.set.handles.size(), 3u) << body.name;
        const std::vector<Eigen::Matrix3Xd> motions = {body.pulled(), body.turned()};
        const std::vector<KnownAnswer> truths = refined_answers(body, motions, nu, 1);
        for (const MethodKind kind : all_methods()) {
            if (!kind->linear) continue;
            Control control;
            Deformer deformer(precomputed(make_body(body.surface, {1.0, nu}), make_method(kind)));
            deformer.constrain(body.set, control);
            for (std::size_t m = 0; m < motions.size(); ++m)
                for (const Judged& one :
                     judge(body, m == 0 ? "pulled" : "turned", kind, body.values(motions[m]), truths[m], deformer)) {
                    good += one.within(3.0) ? 1 : 0;
                    ++all;
                }
        }
    }
    print_measured("estimates within a factor of three", static_cast<double>(good) / all);
    EXPECT_GE(good, 0.9 * all);
}

/// With finer rims the second answer is the worse one, which shows what the rims contributed; of forces, that can be
/// far more than what is left.
TEST(DiscretisationCheck, IsWithinAFactorOfThreeWhereTheRimsAreFinerButForForcesThatAreBetter) {
    struct Case {
        OrganicCase body;
        double nu;
        int most_rims;
    };
    const std::vector<Case> cases = {
        {organic_case(make_cactus(220)), 0.3, 2},
        {held_below("bent tube", make_bent_tube(2, 0.35, 4.0, 3.0), {0.1, 0.3, 1.0}, 0.15, 0.6), 0.0, 1},
        {held_below("torus", make_torus(4), {1.0, 0.0, 0.2}, 0.15, 0.7), 0.49, 1}};
    for (const auto& [body, nu, most_rims] : cases) {
        const std::vector<Eigen::Matrix3Xd> motions = {body.pulled(), body.turned()};
        const std::vector<KnownAnswer> truths = refined_answers(body, motions, nu, 2);
        std::vector<double> as_given(2, 0.0);
        for (int rims = 0; rims <= most_rims; ++rims) {
            Control control;
            Deformer deformer(precomputed(make_body(body.surface, {1.0, nu}), {.kind = kGalerkinBem, .rims = rims}));
            deformer.constrain(body.set, control);
            for (std::size_t m = 0; m < motions.size(); ++m) {
                const std::string what = (m == 0 ? "pulled" : "turned") + std::string(", rims ") + std::to_string(rims);
                const auto judged = judge(body, what, kGalerkinBem, body.values(motions[m]), truths[m], deformer);
                if (rims == 0) as_given[m] = judged[0].error;
                EXPECT_LE(judged[0].error, (rims == 0 ? 1.0 : 0.75) * as_given[m]) << body.name << " " << what;
                EXPECT_TRUE(judged[0].within(3.0)) << judged[0].what;
                EXPECT_LT(judged[1].error, 3.0 * judged[1].estimate) << judged[1].what;
            }
        }
    }
}

/// The iterations of the estimate of linear tetrahedra stop early enough to be cheap and late enough to be right.
TEST(DiscretisationCheck, OfFemIsHalfAgainTheDifferenceToQuadraticFem) {
    const OrganicCase body = held_below("bent tube", make_bent_tube(2, 0.35, 4.0, 3.0), {0.1, 0.3, 1.0}, 0.15, 0.6);
    const Eigen::VectorXd values = body.values(body.turned());
    for (const double nu : {0.0, 0.3, 0.49}) {
        Control control;
        const Body what = make_body(body.surface, {1.0, nu});
        Deformer linear(precomputed(what, make_method(kFem))), quadratic(precomputed(what, make_method(kQuadraticFem)));
        linear.constrain(body.set, control);
        quadratic.constrain(body.set, control);
        const Deformer::Answer coarse = linear.answer(values, {.check = true}, control);
        const Eigen::VectorXd fine = quadratic.answer(values, {}, control).displacements;
        const double difference = displacement_error(coarse.displacements, fine);
        EXPECT_NEAR(coarse.check->relative_error / (1.45 * difference), 1.0, 0.03) << nu;
    }
}

/// One answer is what displace, reactions, residual and the check say one by one.
/// Rims tell nothing of a coarse cavity that is pressed.
TEST(DiscretisationCheck, OfGalerkinSeesACoarseCavity) {
    const SurfaceMesh outer = make_sphere(3), inner = inside_out(make_sphere(1, 0.3));
    const SurfaceMesh body = joined(outer, inner);
    std::vector<int> cavity(static_cast<std::size_t>(inner.n_triangles()));
    std::iota(cavity.begin(), cavity.end(), outer.n_triangles());
    const ConstrainedSet set{.fixed = vertices_where(body, [](const Eigen::Vector3d& x) { return x.x() < -0.8; }),
                             .handles = {},
                             .loads = {unit_pressure(body, cavity)}};
    const Eigen::VectorXd values = Eigen::VectorXd::Constant(1, 0.1);
    const Eigen::VectorXd truth = displaced(precomputed(make_body(body), {.kind = kQuadraticFem}), set, values);
    Control control;
    Deformer deformer(precomputed(make_body(body), {.kind = kGalerkinBem}));
    deformer.constrain(set, control);
    const double error = error_against(truth, deformer.displace(values));
    const DiscretisationCheck check = deformer.discretisation_check(values, control).value();
    EXPECT_GT(error, 0.1);
    EXPECT_GT(check.relative_error, error / 3.0);
    EXPECT_LT(check.relative_error, error * 3.0);
    EXPECT_LT(check.relative_force_error, 0.3) << "nothing is borne in all, of forces that are there";
}

TEST(DiscretisationCheck, IsPartOfAnAnswerThatSolvesOnce) {
    const CoarseAndFine example = cases()[0];
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.coarse, set);
    for (const Method& method : method_variants()) {
        Control control;
        Deformer deformer(precomputed(make_body(example.coarse), method));
        deformer.constrain(set, control);
        const Deformer::Answer answer = deformer.answer(values, {.residual = true, .check = true}, control);
        EXPECT_EQ(answer.displacements, deformer.displace(values)) << describe(method);
        EXPECT_EQ(answer.reactions.forces, deformer.reactions(values).forces) << describe(method);
        EXPECT_EQ(answer.residual.value(), deformer.residual(values, control)) << describe(method);
        EXPECT_TRUE(answer.check.has_value()) << describe(method);
        EXPECT_FALSE(deformer.answer(values, {}, control).residual.has_value()) << describe(method);
    }
}

}  // namespace
}  // namespace elastolab::test
