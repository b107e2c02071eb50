// solve of bodies that are held all over, by parts or not at all.
#include <gmock/gmock.h>

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/solve_case.hpp"

namespace elastolab {
namespace {

using test::ProgramRun;
using test::SolveTest;

/// A simple shear, prescribed on all of the surface by sets that touch, so that no vertex is free, and of a tetrahedron
/// no node: every method whose forces are energies' derivatives is exact, which is what it must say. The stress is G
/// times the shear, in finite elasticity too: a neo-Hookean body in simple shear has the shear stress G gamma.
TEST_F(SolveTest, ABodyThatIsPrescribedAllOverBySetsThatTouchIsToldToBeExact) {
    folder_.write("tet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const std::string material = R"("elastolab": 1, "material": {"young_modulus": 2.6, "poisson_ratio": 0.3})";
    const std::vector<std::pair<std::string, double>> scenes = {
        // and the force at the fixed set over the stress
        {"{" + material + R"(, "mesh": {"file": "tet.obj"}, "fixed": {"vertices": [0, 1, 2]},
            "handles": [{"select": {"vertices": [3]}, "translate": [0.1, 0.1, 0]}]})",
         1.0 / 6.0},
        {"{" + material + R"(, "mesh": {"primitive": "cube", "resolution": 1},
            "fixed": {"box": {"min": [-1, -1, -1], "max": [2, 2, 0.1]}},
            "handles": [{"select": {"box": {"min": [-1, -1, 0.9], "max": [2, 2, 2]}}, "translate": [0.1, 0.1, 0]}]})",
         1.0}};
    for (const auto& [scene, force_of_stress] : scenes)
        for (const std::string method :
             {"fem", "quadratic-fem", "nonlinear-fem --elements linear", "nonlinear-fem", "galerkin-bem"}) {
            SCOPED_TRACE(method + " of " + scene);
            std::vector<std::string> options = {"--report", "r.json", "--quiet", "--method"};
            std::istringstream words(method);
            for (std::string word; words >> word;) options.push_back(word);
            solve(scene, options);
            const auto report = json("r.json");
            const double force = 0.1 * force_of_stress;
            EXPECT_NEAR(report["fixed_sets"][0]["force"][0], -force, 1e-6 * force);
            EXPECT_NEAR(report["fixed_sets"][0]["force"][1], -force, 1e-6 * force);
            EXPECT_NEAR(report["fixed_sets"][0]["force"][2], 0.0, 1e-6 * force);
            EXPECT_EQ(report["error_estimate"]["displacement"], 0.0);
            EXPECT_LT(report["error_estimate"]["force"], 1e-6);
        }
}

TEST_F(SolveTest, TreatsTheSolidsOfASceneByThemselves) {
    folder_.write("two.obj",
                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n"
                  "f 2 3 4\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n");
    const std::string scene = R"({"elastolab": 1, "mesh": {"file": "two.obj"}, "fixed": {"vertices": [0, 1, 2]},
                                  "handles": [{"select": {"vertices": [3]}, "translate": [0, 0, 0.1]}]})";
    for (const std::string method : {"fem", "constant-bem", "linear-bem"}) {
        SCOPED_TRACE(method);
        solve(scene, {"--method", method, "--mode", "full", "--displacements", "u.csv", "--matrices", "m", "--quiet"});
        const test::Table table = test::read_csv(file("u.csv"));
        ASSERT_EQ(table.rows.size(), 8U);
        for (std::size_t v = 4; v < 8; ++v) EXPECT_EQ(table.rows[v][5], 0.0) << "nothing holds or moves this solid";
        EXPECT_THAT(folder_.listing(), testing::IsSupersetOf({"m/K-solid1.npy", "m/K-solid2.npy"}));
    }
}

/// A solid that is held all over, or that nothing moves, rests, and takes no other's estimate away.
TEST_F(SolveTest, EstimatesTheErrorBesideASolidThatRests) {
    folder_.write("two.obj",
                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n"
                  "f 2 3 4\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n");
    std::map<std::string, double> estimates;
    for (const std::string fixed : {"0, 1", "0, 1, 4, 5, 6, 7"}) {
        const std::string scene = R"({"elastolab": 1, "mesh": {"file": "two.obj"}, "fixed": {"vertices": [)" + fixed +
                                  R"(]}, "handles": [{"select": {"vertices": [3]}, "translate": [0, 0, 0.1]}]})";
        for (const std::string method : {"fem", "quadratic-fem", "nonlinear-fem", "linear-bem", "galerkin-bem"}) {
            SCOPED_TRACE(method + " " + fixed);
            solve(scene, {"--method", method, "--report", "r.json", "--quiet"});
            const auto estimate = json("r.json").at("error_estimate");
            ASSERT_TRUE(estimate.is_object() && estimate.at("displacement").is_number()) << estimate.dump();
            const auto [first, is_first] = estimates.try_emplace(method, estimate.at("displacement"));
            EXPECT_NEAR(estimate.at("displacement"), first->second, 1e-6 * first->second);
        }
    }
}

/// Arrays without rows: BLAS complains of them on standard output.
TEST_F(SolveTest, ABodyThatNothingHoldsOrMovesIsAtRestAndNothingIsSaid) {
    const std::string scene = R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 2}, "method": ")";
    for (const char* method : {"fem", "quadratic-fem", "nonlinear-fem", "constant-bem", "linear-bem", "galerkin-bem"}) {
        SCOPED_TRACE(method);
        const ProgramRun run = solve(scene + method + "\"}", {"--quiet", "--displacements", "u.csv", "--forces",
                                                              "f.csv", "--report", "r.json", "--fields", "fields.csv"});
        EXPECT_EQ(run.out, "");
        for (const std::vector<double>& row : test::read_csv(file("u.csv")).rows) EXPECT_EQ(row[4], 0.0);
        EXPECT_THAT(solve(scene + method + "\"}", {}).out, testing::StartsWith("scene.json: "));
    }
}

/// A pressure that balances itself has no resultant that anything could be compared with.
TEST_F(SolveTest, AFreeBodyUnderPressureIsNotSaidToLackBalance) {
    std::string all_warnings;
    for (const char* mesh :
         {R"({"primitive": "cube", "resolution": 2})", R"({"primitive": "hollow-sphere", "resolution": 3})"})
        for (const char* method :
             {"fem", "quadratic-fem", "nonlinear-fem", "constant-bem", "linear-bem", "galerkin-bem"}) {
            SCOPED_TRACE(std::string(mesh) + " " + method);
            const ProgramRun run =
                solve(std::string(R"({"elastolab": 1, "mesh": )") + mesh + R"(, "method": ")" + method +
                          R"(", "loads": [{"name": "air", "select": {"box": {"min": [-2, -2, -2], "max": [2, 2, 2]}},
                                           "pressure": 0.01}]})",
                      {"--quiet", "--report", "r.json"});
            EXPECT_EQ(run.exit_code, 0) << run.err;
            EXPECT_EQ(run.out, "");
            const nlohmann::json report = json("r.json");
            EXPECT_LT(report.at("force_imbalance").get<double>(), 1e-6);
            EXPECT_LT(report.at("moment_imbalance").get<double>(), 1e-6);
            EXPECT_LT(report.at("condition_estimate").get<double>(), 1e9);
            all_warnings += report.at("warnings").dump();
        }
    EXPECT_THAT(all_warnings, testing::Not(testing::HasSubstr("balance")));
    // Some are too coarse; no patch is constrained, whose rims could be refined.
    EXPECT_THAT(all_warnings, testing::HasSubstr("Refine the mesh."));
    EXPECT_THAT(all_warnings, testing::Not(testing::HasSubstr("rims")));
}

}  // namespace
}  // namespace elastolab
