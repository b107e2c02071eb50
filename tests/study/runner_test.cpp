#include "study/runner.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "base/error.hpp"
#include "study/report/journal.hpp"
#include "study/report/report.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Two cases that count how often they run; the second can be told to fail.
struct Counting {
    int first = 0, second = 0;
    std::function<void()> before_second = [] {};

    Study study() {
        Study study;
        study.name = "tiny";
        study.title = "A tiny study";
        study.columns = {"case", "x", "y"};
        study.cases.push_back(
            {Row().set("case", std::string("first")), 1.0, [this](Control&) {
                 ++first;
                 return std::vector<Row>{Row().set("x", 1).set("y", 2.5), Row().set("x", 2).set("y", 3)};
             }});
        study.cases.push_back({Row().set("case", std::string("second, quoted")), 1.0, [this](Control&) {
                                   before_second();
                                   ++second;
                                   return std::vector<Row>{Row().set("x", 3)};
                               }});
        study.conclude = [](const Table& table, Control&) {
            Conclusions conclusions;
            conclusions.findings = std::to_string(table.rows.size()) + " rows";
            conclusions.plots.push_back(Plot{.name = "xy",
                                             .title = "y over x",
                                             .caption = "A line.",
                                             .x_label = "x",
                                             .y_label = "y",
                                             .series = {{"first", {{"case", "first"}}, "x", "y"}}});
            return conclusions;
        };
        return study;
    }
};

class RunnerTest : public testing::Test {
protected:
    RunResult run(Counting& counting, unsigned seed = 1, bool fresh = false) {
        Control control;
        StudyProgress progress;
        RunSettings settings;
        settings.folder = folder_.path() / "out";
        settings.options.seed = seed;
        settings.fresh = fresh;
        return run_study(counting.study(), settings, progress, control);
    }
    std::string text(const std::string& name) const { return read_text(folder_.path() / "out" / name); }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / "out" / name); }

    TemporaryFolder folder_;
};

TEST_F(RunnerTest, WritesTableReportAndPlots) {
    Counting counting;
    const RunResult result = run(counting);
    EXPECT_EQ(result.table.rows.size(), 3U);
    EXPECT_THAT(text("tiny.csv"),
                HasSubstr("case,x,y,note,version,cpu,cores,memory_bytes,blas_kernels,threads,seed,quick\n"));
    EXPECT_THAT(text("tiny.csv"), HasSubstr("\"second, quoted\",3,,,"));
    EXPECT_THAT(text("README.md"), HasSubstr("3 rows"));
    EXPECT_THAT(text("README.md"), HasSubstr("elastolab bench tiny"));
    EXPECT_THAT(text("xy.gp"), HasSubstr("'tiny.csv'"));
    EXPECT_FALSE(exists("tiny.partial.csv"));
    if (result.warnings.empty()) {
        EXPECT_THAT(text("xy.svg"), HasSubstr("y over x"));
        EXPECT_TRUE(exists("xy.png"));
    }
}

TEST_F(RunnerTest, GoesOnWhereItWasStopped) {
    Counting counting;
    counting.before_second = [] { throw Cancelled{}; };
    EXPECT_THROW(run(counting), Cancelled);
    EXPECT_FALSE(exists("tiny.csv"));
    EXPECT_TRUE(exists("tiny.partial.csv"));
    counting.before_second = [] {};
    const RunResult result = run(counting);
    EXPECT_EQ(counting.first, 1) << "its rows were kept";
    EXPECT_EQ(counting.second, 1);
    EXPECT_EQ(result.table.rows.front().number("y"), 2.5);
}

TEST_F(RunnerTest, FindsOutFirstThatATableCannotBeWritten) {
    Counting counting;
    std::filesystem::create_directories(folder_.path() / "out" / "tiny.csv");
    EXPECT_THROW(run(counting), Error);
    EXPECT_EQ(counting.first, 0);
}

TEST_F(RunnerTest, KeepsNothingOfAnotherSeedNorWhenAskedToBeginAnew) {
    Counting counting;
    counting.before_second = [] { throw Cancelled{}; };
    EXPECT_THROW(run(counting, 1), Cancelled);
    EXPECT_THROW(run(counting, 2), Cancelled);
    EXPECT_EQ(counting.first, 2);
    EXPECT_THROW(run(counting, 2, true), Cancelled);
    EXPECT_EQ(counting.first, 3);
}

TEST_F(RunnerTest, RefusesASecondRunInTheSameFolder) {
    Counting counting, other;
    std::string refusal;
    counting.before_second = [&] {
        try {
            run(other, 2);
        } catch (const Error& error) {
            refusal = error.what();
        }
    };
    run(counting);
    EXPECT_THAT(refusal, HasSubstr("another run"));
    EXPECT_EQ(other.first, 0);
    run(other, 2);
    EXPECT_EQ(other.first, 1);
}

TEST_F(RunnerTest, NotesACaseThatFails) {
    Counting counting;
    counting.before_second = [] { throw SolveError("second: is singular. Choose another."); };
    const RunResult result = run(counting);
    ASSERT_EQ(result.table.rows.size(), 3U);
    EXPECT_EQ(result.table.rows.back().text("note"), "second: is singular. Choose another.");
}

TEST_F(RunnerTest, RefusesToReportOnADamagedTable) {
    Counting counting;
    run(counting);
    const std::string whole = text("tiny.csv");
    const auto refusal = [&](const std::string& table) {
        std::ofstream(folder_.path() / "out" / "tiny.csv", std::ios::binary) << table;
        RunSettings settings;
        settings.folder = folder_.path() / "out";
        settings.report_only = true;
        Control control;
        StudyProgress progress;
        try {
            run_study(counting.study(), settings, progress, control);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal(whole), "");
    EXPECT_THAT(refusal(""), HasSubstr("columns"));
    EXPECT_THAT(refusal(whole.substr(0, whole.find('\n') + 1)), HasSubstr("no rows"));
    EXPECT_THAT(refusal(whole.substr(0, whole.size() - 1)), HasSubstr("line 4 has no end"));
    EXPECT_THAT(refusal(whole.substr(0, whole.size() - 9) + "\n"), HasSubstr("line 4 has"));
    EXPECT_THAT(refusal(whole + std::string(100, '\0') + "\n"), HasSubstr("line 5 is not text"));
    EXPECT_THAT(refusal("a,b\n1,2\n"), HasSubstr("columns"));
    EXPECT_THAT(refusal(whole), "");
}

TEST_F(RunnerTest, MakesTheReportAgainFromTheTable) {
    Counting counting;
    run(counting);
    RunSettings settings;
    settings.folder = folder_.path() / "out";
    settings.report_only = true;
    Control control;
    StudyProgress progress;
    EXPECT_EQ(run_study(counting.study(), settings, progress, control).table.rows.size(), 3U);
    EXPECT_EQ(counting.first, 1);
    EXPECT_THAT(text("README.md"), HasSubstr("3 rows"));
}

TEST_F(RunnerTest, SaysInTheReportWhichRowsAreOfAnotherMachine) {
    Counting counting;
    const RunResult result = run(counting);
    EXPECT_THAT(text("README.md"), testing::Not(HasSubstr("another machine")));
    Table table = result.table;
    table.rows.back().set("cpu", std::string("another"));
    EXPECT_THAT(report(counting.study(), {}, table, "out"), HasSubstr("1 of 3 rows are of another machine"));
}

Row origin(int seed) { return Row().set("study", std::string("tiny")).set("seed", seed); }

TEST(Journal, DropsACaseWhoseRowsAreNotAllThere) {
    const TemporaryFolder folder;
    folder.write("j.csv", "study=tiny,seed=1\nrow,one,x,1\ndone,one,1\nrow,two,x,2\n");
    EXPECT_EQ(Journal(folder.path() / "j.csv", origin(1)).n_finished(), 1);
    folder.write("j.csv", "study=tiny,seed=1\nrow,one,x,1\ndone,o");
    EXPECT_EQ(Journal(folder.path() / "j.csv", origin(1)).n_finished(), 0);
}

TEST(Journal, ComputesAgainWhatIsDamagedAndSaysSo) {
    using std::string_literals::operator""s;
    const std::string header = "study=tiny,seed=1\n", second = "row,two,x,2\ndone,two,1\n";
    for (const std::string& first :
         {"\0\0\0\0\0\0\0\0row,one,x,1\ndone,one,1\n"s,  // a block that was never written
          "row,one,x,1\ndone,one,2\n"s, "row,one,x\ndone,one,1\n"s, "done,one,1\n"s, "row,one,x,1\ndone,one\n"s}) {
        const TemporaryFolder folder;
        folder.write("j.csv", header + first + second);
        const Journal journal(folder.path() / "j.csv", origin(1));
        EXPECT_FALSE(journal.find("one")) << first;
        EXPECT_TRUE(journal.find("two")) << first;
        EXPECT_THAT(journal.notice(), HasSubstr("computed again")) << first;
    }
    const TemporaryFolder folder;
    folder.write("j.csv", header + "row,one,x,1\ndone,one,1\ndone,one,1\n");
    const Journal doubled(folder.path() / "j.csv", origin(1));
    ASSERT_TRUE(doubled.find("one"));
    EXPECT_EQ(doubled.find("one")->size(), 1U);
}

TEST(Journal, SetsAsideTheCasesOfAnotherRunAndSaysSo) {
    const TemporaryFolder folder;
    const std::string of_seed_1 = "study=tiny,seed=1\nrow,one,x,1\ndone,one,1\n";
    folder.write("j.csv", of_seed_1);
    folder.write("j-1.csv", "is taken");
    const Journal journal(folder.path() / "j.csv", origin(2));
    EXPECT_EQ(journal.n_finished(), 0);
    EXPECT_THAT(journal.notice(), HasSubstr("seed=1, now seed=2"));
    EXPECT_THAT(journal.notice(), HasSubstr("j-2.csv"));
    EXPECT_EQ(read_text(folder.path() / "j-2.csv"), of_seed_1);
    EXPECT_EQ(read_text(folder.path() / "j-1.csv"), "is taken");
}

TEST(Journal, SaysNothingWhenNothingIsLost) {
    const TemporaryFolder folder;
    folder.write("j.csv", "study=tiny,seed=1\nrow,one,x,1\n");
    EXPECT_EQ(Journal(folder.path() / "j.csv", origin(2)).notice(), "");
    EXPECT_THAT(folder.listing(), ElementsAre("j.csv"));
}

/// Killed while it is being rewritten, a file that is truncated first has lost everything. One that is written beside
/// and renamed is another file afterwards, and the old one is whole as long as somebody holds it.
TEST(Journal, IsRewrittenBesideTheOldOne) {
    const TemporaryFolder folder;
    const std::string text = "study=tiny,seed=1\nrow,one,x,1\ndone,one,1\nrow,tw";
    const auto file = folder.write("j.csv", text);
    std::filesystem::create_hard_link(file, folder.path() / "held");
    { const Journal journal(file, origin(1)); }
    EXPECT_EQ(read_text(folder.path() / "held"), text);
    EXPECT_EQ(read_text(file), "study=tiny,seed=1\nrow,one,x,1\ndone,one,1\n");
}

TEST(StudyProgress, EstimatesTheTimeLeftFromTheWeightDone) {
    StudyProgress progress;
    progress.begin(3, 0, 4.0);
    EXPECT_LT(progress.state().seconds_left, 0.0);
    progress.begin_case("a");
    progress.end_case(1.0);
    EXPECT_GE(progress.state().seconds_left, 0.0);
    EXPECT_EQ(progress.state().n_done, 1);
    EXPECT_DOUBLE_EQ(progress.state().fraction, 0.25);
}

}  // namespace
}  // namespace elastolab::test
