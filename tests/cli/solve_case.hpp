#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/program.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab::test {

class SolveTest : public testing::Test {
protected:
    /// Runs solve on a scene with these options; it must succeed silently.
    ProgramRun solve(const std::string& scene, std::vector<std::string> options) {
        folder_.write("scene.json", scene);
        options.insert(options.begin(), {"solve", "scene.json"});
        const ProgramRun run = run_program(options, folder_.path());
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err, "");
        return run;
    }
    std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
    nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(read_text(file(name))); }

    TemporaryFolder folder_;
};

}  // namespace elastolab::test
