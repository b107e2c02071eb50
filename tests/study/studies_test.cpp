#include <gmock/gmock.h>

#include "bem/collocation/method.hpp"
#include "bem/galerkin/method.hpp"
#include "deform/node_solver.hpp"
#include "deform/patch_reactions.hpp"
#include "fem/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "study/error/error_frontier.hpp"
#include "study/error/problems.hpp"
#include "study/measure.hpp"
#include "study/paper/paper_procedure.hpp"
#include "study/runner.hpp"
#include "study/setups.hpp"
#include "study/stability/trial_edits.hpp"
#include "study/stability/trials.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::test {
namespace {

using testing::HasSubstr;

/// The quick study with only the cases whose key contains one of these texts.
Study with_cases(const std::string& name, const std::vector<std::string>& texts) {
    const auto& all = studies();
    const auto entry = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.name == name; });
    Study study = entry->make({.quick = true, .seed = 1});
    std::erase_if(study.cases, [&](const Case& one) {
        return std::none_of(texts.begin(), texts.end(),
                            [&](const auto& text) { return one.key().find(text) != std::string::npos; });
    });
    EXPECT_FALSE(study.cases.empty());
    return study;
}

RunResult run(const Study& study, const std::filesystem::path& folder) {
    Control control;
    StudyProgress progress;
    RunSettings settings;
    settings.folder = folder;
    settings.options.quick = true;
    return run_study(study, settings, progress, control);
}

/// Columns that are no times nor memory.
std::string lasting_numbers(const Table& table) {
    std::string text;
    for (const Row& row : table.rows)
        for (const auto& [column, value] : row.cells())
            if (!column.ends_with("_s") && !column.ends_with("_bytes")) text += column + "=" + value + ",";
    return text;
}

TEST(Studies, HaveCasesWithDifferentKeys) {
    for (const StudyEntry& entry : studies())
        for (const bool quick : {true, false}) {
            std::vector<std::string> keys;
            for (const Case& one : entry.make({.quick = quick, .seed = 1}).cases) keys.push_back(one.key());
            std::sort(keys.begin(), keys.end());
            EXPECT_TRUE(std::adjacent_find(keys.begin(), keys.end()) == keys.end()) << entry.name;
        }
}

/// The time left is told from the weights of the cases: one that outweighs all others makes it meaningless.
TEST(Studies, SpreadTheTimeLeftOverTheirCases) {
    for (const StudyEntry& entry : studies())
        for (const bool quick : {true, false}) {
            double all = 0.0, largest = 0.0;
            for (const Case& one : entry.make({.quick = quick, .seed = 1}).cases) {
                all += one.weight;
                largest = std::max(largest, one.weight);
            }
            EXPECT_LT(largest, 0.3 * all) << entry.name << (quick ? " --quick" : "");
        }
}

TEST(Studies, GiveTheSameNumbersForTheSameSeed) {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::vector<std::string>>> some = {
        {"paper", {"paper linear-bem 2", "ours fem 2"}},
        {"error", {"refinement bending fem 0.3 3"}},
        {"stability", {"edits 100 linear-bem"}}};
    for (const auto& [name, cases] : some) {
        const Table first = run(with_cases(name, cases), folder.path() / "a").table;
        const Table second = run(with_cases(name, cases), folder.path() / "b").table;
        EXPECT_EQ(lasting_numbers(first), lasting_numbers(second)) << name;
    }
}

TEST(Trials, KnowTheReactionOfEveryConstrainedVertexOrOfNone) {
    for (const TrialGroup& group : trial_groups(true))
        for (const double level : group.levels) {
            const Problem problem = group.make(level);
            if (!problem.reactions) continue;
            EXPECT_EQ(problem.reactions->forces.cols(), std::ssize(problem.constrained)) << group.name << " " << level;
            EXPECT_EQ(problem.reactions->moments.cols(), std::ssize(problem.constrained)) << group.name << " " << level;
        }
}

TEST(Studies, EndInFilesWhateverTheCases) {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::string>> some = {{"paper", "fem 2"},
                                                                   {"error", "bending linear-bem 0.3 2"},
                                                                   {"stability", "edits 100 fem"},
                                                                   {"scale", "on-demand 3"},
                                                                   {"skip", "young fem"}};
    for (const auto& [name, one] : some) {
        const RunResult result = run(with_cases(name, {one}), folder.path() / name);
        EXPECT_GT(result.table.rows.size(), 0U);
        EXPECT_TRUE(std::filesystem::exists(folder.path() / name / (name + ".csv")));
        EXPECT_THAT(read_text(folder.path() / name / "README.md"), HasSubstr("elastolab bench " + name));
        for (const std::string& warning : result.warnings) EXPECT_THAT(warning, HasSubstr("gnuplot"));
    }
}

TEST(Studies, ShowWhatFinerRimsLeaveOfTheErrorOnOrganicBodies) {
    const TemporaryFolder folder;
    const Table table = run(with_cases("error", {"organic potato galerkin-bem"}), folder.path() / "error").table;
    const auto error = [&](const char* variant) {
        return table.where({{"variant", variant}}).rows.at(0).number("error");
    };
    EXPECT_LT(error("galerkin-bem rims 1"), 0.4 * error("galerkin-bem"));
    EXPECT_LT(error("galerkin-bem rims 2"), 0.4 * error("galerkin-bem")) << "most of what is left is elsewhere";
    EXPECT_THAT(read_text(folder.path() / "error" / "README.md"), HasSubstr("galerkin-bem rims 2"));
}

TEST(PaperProcedure, AgreesWithItselfInAllFourForms) {
    Control control;
    for (const MethodKind kind : paper_methods()) {
        const PaperSystem system = paper_precomputation(study_body(make_box(2), Material{1.0, 0.3}), kind, control);
        const auto updates = paper_updates(system, choose_share(system.n_nodes(), 0.3, 1));
        ASSERT_EQ(updates.size(), 4U);
        for (const PaperUpdate& update : updates)
            EXPECT_LT(relative_error(update.displacements, updates[0].displacements), 1e-9) << update.name;
    }
}

/// Totals of the patches at both ends, in the order of the patches.
std::vector<Eigen::Vector3d> total_forces(const Problem& problem) {
    std::vector<Eigen::Vector3d> totals;
    for (const std::vector<int>& patch : constrained_patches(*problem.body.surface, {}, problem.constrained))
        totals.emplace_back(problem.reactions->forces(Eigen::all, patch).rowwise().sum());
    return totals;
}

TEST(Problems, KnowTheForcesOfTheirFields) {
    const auto stretched = total_forces(problem_family("stretch").make(3, 0.3));
    ASSERT_EQ(stretched.size(), 2U);
    EXPECT_LT((stretched[0] + stretched[1]).norm(), 1e-14);
    EXPECT_NEAR(stretched[0].cwiseAbs().maxCoeff(), 1.0, 1e-13);  // unit strain, modulus and section
    const auto bent = total_forces(problem_family("bending").make(3, 0.3));
    EXPECT_NEAR(bent[0].cwiseAbs().maxCoeff(), 0.5, 1e-13);  // stress z over 0 to 1
    const Problem sphere = problem_family("hollow-sphere").make(3, 0.3);
    EXPECT_FALSE(sphere.force_error(*sphere.reactions).has_value());  // adds up to nothing
    const Problem bar = problem_family("bending").make(3, 0.3);
    Reactions larger = *bar.reactions;
    larger.forces *= 1.01;
    larger.moments *= 1.01;
    EXPECT_NEAR(bar.force_error(larger).value(), 0.01, 1e-12);
}

/// The direct update finds the system of constant elements singular there, and `solve` takes another, too.
TEST(Problems, AreMeasuredWhereTheDirectUpdateIsRefused) {
    const Problem problem = problem_family("hollow-sphere").make(4, 0.5);
    Control control;
    Deformer direct(precompute(problem.body, {.kind = kConstantBem, .update = Update::direct}, control));
    ASSERT_THROW(direct.constrain(problem.set(), control), NotHeldError);
    const Row row = measure(problem, {.kind = kConstantBem}, {.budget_seconds = 0.0, .most = 1}, control);
    EXPECT_GT(row.number("once_s"), 0.0);
    EXPECT_GT(row.number("error"), 0.0);
}

/// The two kinds of truth, finite and boundary elements, know the forces of an organic body alike.
TEST(Problems, HaveForcesOfOrganicBodiesOnWhichTwoMethodsAgree) {
    const Problem problem = problem_family("potato-turned").make(100, 0.3);
    Control control;
    Deformer deformer(precompute(problem.body, {.kind = kGalerkinBem}, control));
    deformer.constrain({{}, problem.constrained}, control);
    const Deformer::Answer answer = deformer.answer(problem.values(), {.check = true}, control);
    const double error = problem.force_error(answer.reactions).value();
    EXPECT_LT(error, 3.0 * answer.check->relative_force_error + problem.truth_force_error);
    EXPECT_LT(problem.truth_force_error, 0.3);
    EXPECT_LT(problem.reactions->forces.rowwise().sum().norm(), 1e-6 * problem.reactions->forces.cwiseAbs().sum());
}

TEST(Frontier, NamesTheFastestDefaultBesideTheFastestVariant) {
    std::vector<FrontierPoint> points = {{"p", "0.3", "linear-bem restricted", 0.1, 1.0, 100.0},
                                         {"p", "0.3", "linear-bem", 0.1, 2.0, 100.0},
                                         {"p", "0.3", "galerkin-bem", 0.1, 3.0, 100.0}};
    EXPECT_EQ(fastest(points).front().variant, "linear-bem restricted");
    EXPECT_EQ(fastest(defaults_of(points)).front().variant, "linear-bem");
}

TEST(Frontier, FindsTheFastestBetweenTheSizes) {
    Table table;
    const auto add = [&](const char* variant, double vertices, double error, double seconds) {
        table.rows.push_back(Row{{"part", "refinement"}, {"problem", "p"}, {"nu", "0.3"}, {"variant", variant}}
                                 .set("vertices", vertices)
                                 .set("error", error)
                                 .set("ready_s", seconds));
    };
    add("fem", 100, 0.04, 0.1);
    add("fem", 400, 0.01, 0.4);
    add("linear-bem", 100, 0.004, 0.2);
    const auto best = fastest(frontier(table, "ready_s"));
    ASSERT_EQ(best.size(), 3U);  // 10, 3 and 1 %; nobody reaches 0.3 %
    EXPECT_EQ(best[0].variant, "fem");
    EXPECT_EQ(best[1].variant, "fem");
    EXPECT_NEAR(best[1].seconds, 0.1 * 4.0 / 3.0, 1e-3);  // error falls like 1 / seconds
    EXPECT_EQ(best[2].variant, "linear-bem");
}

/// A slow first case says nothing of the method.
TEST(Frontier, TakesAFinerMeshThatWasReadySooner) {
    Table table;
    for (const auto& [error, seconds] : {std::pair{0.2, 0.001}, {0.05, 0.144}, {0.02, 0.036}, {0.004, 0.3}})
        table.rows.push_back(Row{{"part", "refinement"}, {"problem", "p"}, {"nu", "0.3"}, {"variant", "fem"}}
                                 .set("vertices", 10.0 / error)
                                 .set("error", error)
                                 .set("ready_s", seconds));
    const auto points = frontier(table, "ready_s");
    ASSERT_GE(points.size(), 2U);
    for (const FrontierPoint& point : {points[0], points[1]}) EXPECT_LE(point.seconds, 0.036) << point.target;
    EXPECT_EQ(points[1].vertices, 500.0);
}

TEST(StabilityTrial, SaysRightToldAndRefused) {
    Control control;
    const auto group = [](const std::string& name) {
        for (const TrialGroup& one : trial_groups(false))
            if (one.name == name) return one;
        throw std::logic_error(name);
    };
    const Method fem{.kind = kFem};
    EXPECT_EQ(attempt(group("nu-to-half").make(0.3), fem, control).text("outcome"), "right");
    const Row locked = attempt(group("nu-to-half").make(0.4999), fem, control);
    EXPECT_THAT(locked.text("message"), HasSubstr("lock"));
    EXPECT_EQ(attempt(group("few-held").make(1), fem, control).text("outcome"), "told");
    EXPECT_EQ(attempt(group("nu-to-half").make(0.5), fem, control).text("outcome"), "refused");
    EXPECT_EQ(attempt(group("two-bodies").make(-0.1), fem, control).text("outcome"), "refused");
    const std::vector<TrialVariant> finite = finite_trial_variants();
    EXPECT_EQ(attempt(group("finite-swelling").make(1.5), finite[0].method, control).text("outcome"), "right");
    EXPECT_EQ(attempt(group("finite-swelling").make(1.5), finite[1].method, control).text("outcome"), "told");
}

TEST(StabilityTrial, SurvivesRandomEdits) {
    Control control;
    for (const TrialVariant& variant : trial_variants()) {
        const Row row = random_edits(variant.method, 60, 6, 1, control);
        EXPECT_EQ(row.text("outcome"), "right") << variant.name << " " << row.text("error");
        EXPECT_GT(row.number("checks"), 0.0);
    }
}

}  // namespace
}  // namespace elastolab::test
