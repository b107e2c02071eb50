// The real program killed at random moments: what was there stays whole, what was finished is not lost.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "cli/program.hpp"
#include "fuzz/random.hpp"

namespace elastolab::test {
namespace {

using testing::IsSupersetOf;
namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

constexpr int kKills = 12;
const std::string kOld = "of an earlier run\n";

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return Seconds(std::chrono::steady_clock::now() - begin).count();
}

bool has_temporary(const fs::path& folder) {
    std::error_code vanished;
    for (const auto& entry : fs::directory_iterator(folder, vanished))
        if (entry.path().filename().string().starts_with(".elastolab")) return true;
    return false;
}

class KilledSolve : public testing::Test {
protected:
    KilledSolve() {
        folder_.write("scene.json", cube_scene("linear-bem", 6));
        const auto begin = std::chrono::steady_clock::now();
        const ProgramRun run = run_program(arguments(), folder_.path());
        EXPECT_EQ(run.exit_code, 0) << run.err;
        seconds_ = seconds_since(begin);
        for (const std::string& output : kOutputs) complete_[output] = content(output);
    }

    std::vector<std::string> arguments() const {
        return {"solve",      "scene.json", "--quiet",  "--threads", "1",        "--displacements", kOutputs[0],
                "--mesh-out", kOutputs[1],  "--forces", kOutputs[2], "--report", kOutputs[3]};
    }

    std::string content(const std::string& output) const { return read_text(folder_.path() / output); }

    void write_old() const {
        for (const std::string& output : kOutputs) folder_.write(output, kOld);
    }

    /// Reports hold times, which differ from run to run.
    bool is_complete(const std::string& output) const {
        if (output != "report.json") return content(output) == complete_.at(output);
        const nlohmann::json report = nlohmann::json::parse(content(output), nullptr, false);
        return report.is_object() && report.size() == nlohmann::json::parse(complete_.at(output)).size();
    }

    void expect_old_or_complete() const {
        for (const std::string& output : kOutputs)
            EXPECT_TRUE(content(output) == kOld || is_complete(output)) << output << ":\n" << content(output);
    }

    static inline const std::vector<std::string> kOutputs = {"displacements.csv", "mesh.obj", "forces.csv",
                                                             "report.json"};
    TemporaryFolder folder_;
    double seconds_ = 0.0;  ///< of a run that is not killed
    std::map<std::string, std::string> complete_;
};

TEST_F(KilledSolve, LeavesEveryOutputOldOrCompleteWhenItIsKilledAtAnyMoment) {
    fuzz::Random random(1);
    for (int i = 0; i < kKills; ++i) {
        write_old();
        const RunningProgram program(arguments(), folder_.path());
        std::this_thread::sleep_for(Seconds(random.unit() * seconds_));
    }
    expect_old_or_complete();
}

TEST_F(KilledSolve, LeavesEveryOutputOldOrCompleteWhenItIsKilledWhileItWrites) {
    fuzz::Random random(2);
    int n_killed = 0;
    for (int i = 0; i < kKills; ++i) {
        write_old();
        RunningProgram program(arguments(), folder_.path());
        const auto end = std::chrono::steady_clock::now() + Seconds(60.0);
        while (!has_temporary(folder_.path()) && !program.ended()) {
            std::this_thread::yield();
            ASSERT_LT(std::chrono::steady_clock::now(), end);
        }
        std::this_thread::sleep_for(Seconds(random.unit() * 0.003));
        n_killed += program.ended() ? 0 : 1;
    }
    expect_old_or_complete();
    EXPECT_GT(n_killed, 0);
}

/// Keys of the finished cases in the journal of a study.
std::set<std::string> finished_cases(const fs::path& journal) {
    std::set<std::string> keys;
    std::ifstream stream(journal);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("done,")) keys.insert(line.substr(5));
    return keys;
}

TEST(KilledBench, KeepsEveryFinishedCase) {
    const TemporaryFolder folder;
    // The study with the shortest cases.
    const std::vector<std::string> arguments = {"bench", "large", "--quick", "--quiet", "--threads", "1", "--out", "o"};
    const fs::path journal = folder.path() / "o" / "large.partial.csv", table = folder.path() / "o" / "large.csv";
    fuzz::Random random(3);
    std::set<std::string> finished;
    for (int i = 0; i < 2 * kKills; ++i) {
        {
            RunningProgram program(arguments, folder.path());
            // Half of them at its start, when it takes over the journal, others when it has finished a further case.
            const auto end = std::chrono::steady_clock::now() + Seconds(60.0);
            while (i % 2 == 1 && finished_cases(journal).size() <= finished.size() && !program.ended()) {
                std::this_thread::sleep_for(Seconds(0.01));
                ASSERT_LT(std::chrono::steady_clock::now(), end);
            }
            std::this_thread::sleep_for(Seconds(random.unit() * (i % 2 == 0 ? 0.05 : 0.3)));
            if (program.ended()) break;
        }
        if (fs::exists(table)) break;  // it was done, and only about to end
        const std::set<std::string> now = finished_cases(journal);
        ASSERT_THAT(now, IsSupersetOf(finished)) << "after kill " << i;
        finished = now;
    }
    EXPECT_FALSE(finished.empty());
    const ProgramRun run = run_program(arguments, folder.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_FALSE(fs::exists(journal));
    const std::string rows = read_text(table);
    EXPECT_GE(static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')), finished.size());
}

}  // namespace
}  // namespace elastolab::test
