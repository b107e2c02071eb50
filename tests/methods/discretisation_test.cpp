#include <gmock/gmock.h>

#include <algorithm>

#include "elasticity/rigid_motion.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "mesh/primitives.hpp"
#include "methods/problem.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {
namespace {

/// A box held at one part and moved at another, and the same on a finer mesh that has all its vertices.
struct Case {
    std::string name;
    SurfaceMesh coarse, fine;
    std::function<bool(const Eigen::Vector3d&)> held, moved;
    Eigen::Vector3d motion;
};

SurfaceMesh flattened(SurfaceMesh mesh, double thickness) {
    mesh.vertices.row(2) *= thickness;
    return mesh;
}

std::vector<Case> cases() {
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

Eigen::VectorXd values_of(const Case& example, const SurfaceMesh& mesh, ConstrainedSet& set) {
    set = {vertices_where(mesh, example.held), vertices_where(mesh, example.moved)};
    return example.motion.replicate(std::ssize(set.handles), 1);
}

/// The largest error of a vertex of the coarse mesh, over the largest displacement, with the fine mesh for the truth.
double true_error(const Case& example, const Eigen::VectorXd& u) {
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.fine, set);
    const Eigen::VectorXd truth =
        displaced(precomputed(make_body(example.fine), Method{.kind = kLinearBem}), set, values);
    double worst = 0.0, size = 0.0;
    for (int v = 0; v < example.coarse.n_vertices(); ++v) {
        Eigen::Index same = 0;
        const Eigen::Vector3d x = example.coarse.vertices.col(v);
        EXPECT_LT((example.fine.vertices.colwise() - x).colwise().norm().minCoeff(&same), 1e-9);
        worst = std::max(worst, (u.segment<3>(3 * v) - truth.segment<3>(3 * same)).norm());
        size = std::max(size, truth.segment<3>(3 * same).norm());
    }
    return worst / size;
}

TEST(DiscretisationCheck, EstimatesTheLargestErrorWithinAFactorOfThree) {
    for (const Case& example : cases())
        for (const Tractions tractions : {Tractions::discontinuous, Tractions::restricted}) {
            Control control;
            Deformer deformer(precomputed(make_body(example.coarse), make_method(kLinearBem, tractions)));
            ConstrainedSet set;
            const Eigen::VectorXd values = values_of(example, example.coarse, set);
            deformer.constrain(set, control);
            const DiscretisationCheck check = deformer.discretisation_check(values, control).value();
            const double error = true_error(example, deformer.displace(values));
            print_measured(example.name + ", " + std::string(name(tractions)) + ", largest error", error);
            print_measured(example.name + ", " + std::string(name(tractions)) + ", estimate", check.relative_error);
            EXPECT_GT(check.relative_error, error / 3.0) << example.name << " " << name(tractions);
            EXPECT_LT(check.relative_error, error * 3.0) << example.name << " " << name(tractions);
            EXPECT_EQ(findings_of_answer(deformer, {.check = check}).empty(), check.relative_error < 0.08);
        }
}

/// A coarse needle held at one end and bent in the middle: its free end, which nobody touches, follows too far.
TEST(DiscretisationCheck, NamesTheFreeEndThatMovesTooFar) {
    const Case example = cases()[3];
    Control control;
    Deformer deformer(precomputed(make_body(example.coarse), make_method(kLinearBem, Tractions::restricted)));
    ConstrainedSet set;
    const Eigen::VectorXd values = values_of(example, example.coarse, set);
    deformer.constrain(set, control);
    const DiscretisationCheck check = deformer.discretisation_check(values, control).value();
    EXPECT_GT(true_error(example, deformer.displace(values)), 0.08);
    EXPECT_GT(example.coarse.vertices(0, check.vertex), 9.0);
    EXPECT_THAT(words(findings_of_answer(deformer, {.check = check})),
                testing::ElementsAre(testing::HasSubstr("compare with fem")));
}

TEST(DiscretisationCheck, IsTheSameForAllUpdates) {
    const Case example = cases()[0];
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
            EXPECT_EQ(other.vertex, expected.vertex) << name(tractions);
        }
    }
}

TEST(DiscretisationCheck, FindsNothingInARotationByLinearElements) {
    const SurfaceMesh mesh = make_box(3);
    const auto held = vertices_where(mesh, [](const auto& x) { return x[0] < 0.4; });
    const Eigen::VectorXd values = at(rigid_motion(mesh.vertices, {0.1, 0.0, 0.2}, {0.3, -0.5, 0.8}), held);
    for (const Method& method : method_variants()) {
        Control control;
        Deformer deformer(precomputed(make_body(mesh), method));
        deformer.constrain({{}, held}, control);
        const auto check = deformer.discretisation_check(values, control);
        EXPECT_EQ(check.has_value(), method.kind != kFem);
        if (method.kind == kLinearBem) {
            EXPECT_LT(check->relative_error, 1e-3) << describe(method);  // integrals to four digits
        }
    }
}

/// Constant elements turn the triangles between them not at all: what a vertex shows is the mean of several motions.
TEST(DiscretisationCheck, SeesWhatConstantElementsAverage) {
    const auto check = [](int cells) {
        const SurfaceMesh mesh = make_box(cells, {4, 1, 1});
        Control control;
        Deformer deformer(precomputed(make_body(mesh), make_method(kConstantBem)));
        const ConstrainedSet set{vertices_where(mesh, [](const auto& x) { return x[0] < 1e-9; }),
                                 vertices_where(mesh, [](const auto& x) { return x[0] > 4.0 - 1e-9; })};
        deformer.constrain(set, control);
        const Eigen::VectorXd values = Eigen::Vector3d(0.0, 0.0, 0.4).replicate(std::ssize(set.handles), 1);
        return deformer.discretisation_check(values, control).value();
    };
    const DiscretisationCheck coarse = check(1), fine = check(4);
    print_measured("constant-bem, bar of one cell across, spread", coarse.relative_error);
    print_measured("constant-bem, bar of four cells across, spread", fine.relative_error);
    EXPECT_GT(coarse.relative_error, *kConstantBem->error_to_tell);
    EXPECT_LT(fine.relative_error, 0.5 * coarse.relative_error);
    EXPECT_LT(fine.relative_error, *kConstantBem->error_to_tell);
}

/// One answer is what displace, reactions, residual and the check say one by one.
TEST(DiscretisationCheck, IsPartOfAnAnswerThatSolvesOnce) {
    const Case example = cases()[0];
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
        EXPECT_EQ(answer.check.has_value(), method.kind != kFem) << describe(method);
        EXPECT_FALSE(deformer.answer(values, {}, control).residual.has_value()) << describe(method);
    }
}

}  // namespace
}  // namespace elastolab::test
