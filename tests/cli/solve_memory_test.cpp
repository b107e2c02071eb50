#include "cli/solve_case.hpp"
#include "support/sanitized.hpp"

namespace elastolab {
namespace {

using test::SolveTest;

TEST_F(SolveTest, PredictsTheMemoryThatItTakes) {
#ifdef ELASTOLAB_TEST_SANITIZED
    GTEST_SKIP() << "a sanitizer has memory of its own";
#endif
    const auto report_of = [&](const std::string& method, const std::string& update, int cells) {
        solve(test::cube_scene(method, cells), {"--update", update, "--report", "r.json", "--quiet"});
        return json("r.json");
    };
    for (const char* method : {"fem", "constant-bem", "linear-bem"})
        for (const std::string update : {"direct", "reduced"}) {
            SCOPED_TRACE(std::string(method) + ", " + update);
            const double program = report_of(method, update, 1)["peak_memory_bytes"].get<double>();
            const nlohmann::json report = report_of(method, update, method == std::string("fem") ? 9 : 7);
            const double taken = report["peak_memory_bytes"].get<double>() - program;
            EXPECT_GT(report["predicted_memory_bytes"].get<double>(), 0.75 * taken);
            EXPECT_LT(report["predicted_memory_bytes"].get<double>(), 1.7 * taken + 20e6);
        }
}

/// A bar that is turned at once, which takes no factor of a start, and along a way of turns.
TEST_F(SolveTest, PredictsTheMemoryOfEquilibria) {
#ifdef ELASTOLAB_TEST_SANITIZED
    GTEST_SKIP() << "a sanitizer has memory of its own";
#endif
    const auto report_of = [&](int cells, int degrees) {
        nlohmann::json scene = nlohmann::json::parse(test::cube_scene("nonlinear-fem", cells));
        scene["mesh"]["primitive"] = "beam";
        nlohmann::json& handle = scene["handles"][0];
        handle["select"]["plane"]["point"] = {4, 0, 0};
        handle.erase("translate");
        handle["rotate"] = {{"axis", {1, 0, 0}}, {"degrees", degrees}, {"center", {4, 0.5, 0.5}}};
        solve(scene.dump(), {"--report", "r.json", "--quiet"});
        return json("r.json");
    };
    const double program = report_of(1, 20)["peak_memory_bytes"].get<double>();
    for (const int degrees : {20, 200}) {
        SCOPED_TRACE(degrees);
        const nlohmann::json report = report_of(5, degrees);
        const double taken = report["peak_memory_bytes"].get<double>() - program;
        EXPECT_GT(report["predicted_memory_bytes"].get<double>(), 0.75 * taken);
        EXPECT_LT(report["predicted_memory_bytes"].get<double>(), 2.0 * taken + 20e6);
    }
}

}  // namespace
}  // namespace elastolab
