#include <gmock/gmock.h>

#include <array>
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/solve_case.hpp"

namespace elastolab {
namespace {

using test::ProgramRun;
using test::run_program;
using test::SolveTest;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::string> kMethods = {"fem", "constant-bem", "linear-bem"};

/// Displacements are prescribed exactly for nodal methods; constant BEM shows a vertex at the mean of its triangles.
void expect_prescribed(const test::Table& table, const std::string& method) {
    const double tolerance = method == "constant-bem" ? 0.05 : 1e-9;  // relative to the motion of 0.11
    for (const std::vector<double>& row : table.rows) {
        if (row[0] != 0.0 && row[0] != 1.0) continue;
        const bool moved = row[0] == 1.0;
        EXPECT_NEAR(row[3], moved ? 0.1 : 0.0, tolerance);
        EXPECT_NEAR(row[4], 0.0, tolerance);
        EXPECT_NEAR(row[5], moved ? 0.05 : 0.0, tolerance);
    }
}

/// Largest sum of what the fixed part and the handle exert, over some columns, as a part of the pull.
double imbalance(const test::Table& forces, std::size_t begin, std::size_t end) {
    double largest = 0.0;
    for (std::size_t column = begin; column < end; ++column)
        largest = std::max(largest, std::abs(forces.rows[0][column] + forces.rows[1][column]));
    return largest / forces.rows[1][0];
}

TEST_F(SolveTest, WritesTheDisplacementOfEveryVertex) {
    for (const std::string& method : kMethods) {
        SCOPED_TRACE(method);
        solve(test::cube_scene(method), {"--displacements", "u.csv", "--quiet"});
        const test::Table table = test::read_csv(file("u.csv"));
        EXPECT_EQ(table.header, "vertex,x,y,z,ux,uy,uz");
        ASSERT_EQ(table.rows.size(), 98U);  // 6 * 4^2 + 2
        EXPECT_EQ(table.labels[97], "97");
        expect_prescribed(table, method);
    }
}

TEST_F(SolveTest, WritesForcesThatBalance) {
    for (const std::string& method : kMethods) {
        SCOPED_TRACE(method);
        solve(test::cube_scene(method), {"--forces", "f.csv", "--quiet"});
        const test::Table table = test::read_csv(file("f.csv"));
        EXPECT_EQ(table.header, "name,fx,fy,fz,mx,my,mz");
        ASSERT_THAT(table.labels, ElementsAre("fixed", "right"));
        EXPECT_GT(table.rows[1][0], 0.0) << "a pull needs a force along it";
        EXPECT_LT(imbalance(table, 0, 3), 1e-6);  // the mirror symmetry of this scene makes it exact for all methods
        if (method == "fem") {
            EXPECT_LT(imbalance(table, 3, 6), 1e-6);
        }
    }
}

/// A cube held at two faces, with names, one of them by a single vertex where `lone`.
std::string two_fixed_sets(bool lone) {
    std::string scene = test::cube_scene("fem");
    const std::string fixed = R"("fixed": {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}})";
    const std::string other = lone ? R"({"vertices": [0]})" : R"({"box": {"min": [0, 0, 0], "max": [0, 0.4, 1]}})";
    const std::string rest = lone ? R"({"box": {"min": [0.4, 0, 0], "max": [0.6, 1, 0]}})"
                                  : R"({"box": {"min": [0, 0.6, 0], "max": [0, 1, 1]}})";
    scene.replace(
        scene.find(fixed), fixed.size(),
        R"("fixed": [{"name": "near", "select": )" + other + R"(}, {"name": "far", "select": )" + rest + "}]");
    return scene;
}

Eigen::Vector3d vector(const nlohmann::json& numbers) {
    return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

TEST_F(SolveTest, TellsWhatEachFixedSetBears) {
    for (const char* proxy : {"never", "always"})
        for (const bool lone : {false, true}) {
            SCOPED_TRACE(std::string(proxy) + (lone ? ", a lone vertex" : ""));
            const ProgramRun run =
                solve(two_fixed_sets(lone), {"--report", "r.json", "--forces", "f.csv", "--proxy", proxy});
            const test::Table table = test::read_csv(file("f.csv"));
            ASSERT_THAT(table.labels, ElementsAre("fixed", "right"));
            const nlohmann::json sets = json("r.json")["fixed_sets"];
            ASSERT_EQ(sets.size(), 2U);
            EXPECT_EQ(sets[0]["name"], "near");
            EXPECT_EQ(sets[1]["name"], "far");
            EXPECT_THAT(run.out, AllOf(HasSubstr("  of near"), HasSubstr("  of far ")));
            const Eigen::Vector3d force = vector(sets[0]["force"]) + vector(sets[1]["force"]);
            const Eigen::Vector3d moment = vector(sets[0]["moment"]) + vector(sets[1]["moment"]);
            const double size = vector(sets[0]["force"]).norm() + vector(sets[1]["force"]).norm();
            for (int axis = 0; axis < 3; ++axis) {
                const auto column = static_cast<std::size_t>(axis);
                EXPECT_NEAR(force[axis], table.rows[0][column], 1e-9 * size);
                EXPECT_NEAR(moment[axis], table.rows[0][column + 3], 1e-9 * size);
            }
            EXPECT_GT(vector(sets[0]["force"]).norm(), 1e-3 * size);
            EXPECT_GT(vector(sets[1]["force"]).norm(), 1e-3 * size);
        }
}

TEST_F(SolveTest, MomentsOfBoundaryElementsBalanceBetterOnAFinerMesh) {
    for (const std::string method : {"constant-bem", "linear-bem"}) {  // collocation balances them only in the limit
        SCOPED_TRACE(method);
        std::vector<double> imbalances;
        for (const int cells : {2, 4, 8}) {
            solve(test::cube_scene(method, cells), {"--forces", "f.csv", "--quiet"});
            imbalances.push_back(imbalance(test::read_csv(file("f.csv")), 3, 6));
        }
        EXPECT_GT(imbalances[0], 1.5 * imbalances[1]);
        EXPECT_GT(imbalances[1], 1.5 * imbalances[2]);
    }
}

TEST_F(SolveTest, ForcesScaleWithYoungsModulusAndDisplacementsDoNot) {
    std::string stiff = test::cube_scene("linear-bem", 2);
    stiff.replace(stiff.find("1000"), 4, "2000");
    solve(test::cube_scene("linear-bem", 2), {"--forces", "f1.csv", "--displacements", "u1.csv", "--quiet"});
    solve(stiff, {"--forces", "f2.csv", "--displacements", "u2.csv", "--quiet"});
    const test::Table f1 = test::read_csv(file("f1.csv")), f2 = test::read_csv(file("f2.csv"));
    EXPECT_NEAR(f2.rows[1][0], 2.0 * f1.rows[1][0], 1e-9 * f2.rows[1][0]);
    const test::Table u1 = test::read_csv(file("u1.csv")), u2 = test::read_csv(file("u2.csv"));
    for (std::size_t v = 0; v < u1.rows.size(); ++v) EXPECT_NEAR(u1.rows[v][3], u2.rows[v][3], 1e-10);
}

TEST_F(SolveTest, WritesTheDeformedMesh) {
    for (const char* name : {"out.obj", "out.ply", "out.stl"}) {
        solve(test::cube_scene("linear-bem", 2), {"--mesh-out", name, "--quiet"});
        const ProgramRun info = run_program({"info", "--json", name}, folder_.path());
        const auto json = nlohmann::json::parse(info.out);
        EXPECT_EQ(json["vertices"], 26);
        EXPECT_NEAR(json["max"][0].get<double>(), 1.1, 1e-6);
    }
}

TEST_F(SolveTest, WritesFieldsAsTableAndForParaView) {
    solve(test::cube_scene("fem", 2),
          {"--fields", "f.csv", "--mesh-out", "m.vtu", "--displacements", "u.csv", "--quiet"});
    const test::Table fields = test::read_csv(file("f.csv")), moved = test::read_csv(file("u.csv"));
    ASSERT_EQ(fields.rows.size(), moved.rows.size());
    for (std::size_t v = 0; v < fields.rows.size(); ++v) {
        ASSERT_EQ(fields.rows[v].size(), moved.rows[v].size() + 10);
        EXPECT_TRUE(std::equal(moved.rows[v].begin(), moved.rows[v].end(), fields.rows[v].begin()));
    }
    EXPECT_THAT(test::read_text(file("m.vtu")), HasSubstr("<VTKFile type=\"UnstructuredGrid\""));
    const ProgramRun refused =
        run_program({"solve", "scene.json", "--method", "linear-bem", "--mesh-out", "n.vtu"}, folder_.path());
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("no tetrahedra inside"));
}

TEST_F(SolveTest, RefusesFieldsBeyondDoublePrecision) {
    std::string stiff = test::cube_scene("linear-bem", 2);
    stiff.replace(stiff.find("1000"), 4, "1.7e308");
    folder_.write("scene.json", stiff);
    for (const char* output : {"f.csv", "f.vtp"}) {
        const bool table = std::string(output) == "f.csv";
        const ProgramRun refused =
            run_program({"solve", "scene.json", table ? "--fields" : "--mesh-out", output}, folder_.path());
        EXPECT_EQ(refused.exit_code, 1);
        EXPECT_THAT(refused.err, HasSubstr("beyond double precision"));
        EXPECT_FALSE(std::filesystem::exists(file(output)));
    }
}

/// A body that one vertex does not hold: the direct update finds that out, and the reduced one takes over.
TEST_F(SolveTest, TellsEverythingOnceWhereAnotherUpdateTakesOver) {
    folder_.write("scene.json", R"({"elastolab": 1, "mesh": {"primitive": "beam", "resolution": 1},
        "material": {"young_modulus": 1, "poisson_ratio": 0.49}, "method": "fem",
        "handles": [{"select": {"vertices": [0]}, "translate": [0.1, 0, 0]}]})");
    const ProgramRun run = run_program({"solve", "scene.json", "--report", "r.json"}, folder_.path());
    ASSERT_EQ(run.exit_code, 0) << run.err;
    std::vector<std::string> warnings = json("r.json")["warnings"];
    EXPECT_THAT(warnings, testing::Contains(HasSubstr("lock at Poisson's ratio 0.49")));
    EXPECT_THAT(warnings, testing::Contains(HasSubstr("free to move")));
    std::sort(warnings.begin(), warnings.end());
    EXPECT_EQ(std::adjacent_find(warnings.begin(), warnings.end()), warnings.end());
}

/// Names come from scene files: one of a megabyte makes no summary of a megabyte, and is written in full elsewhere.
TEST_F(SolveTest, ShortensLongNamesInTheSummary) {
    const std::string name(1'000'000, 'n');
    folder_.write("scene.json",
                  R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 1},
        "fixed": {"box": {"min": [0, 0, 0], "max": [0, 1, 1]}},
        "handles": [{"name": ")" +
                      name +
                      R"(", "select": {"box": {"min": [1, 0, 0], "max": [1, 1, 1]}}, "translate": [0.1, 0, 0]}]})");
    const ProgramRun run = run_program({"solve", "scene.json", "--forces", "f.csv"}, folder_.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_LT(run.out.size(), 4000U);
    EXPECT_THAT(run.out, HasSubstr("nnn..."));
    EXPECT_THAT(test::read_text(file("f.csv")), HasSubstr(name));
}

TEST_F(SolveTest, WritesAReportWithEveryKey) {
    const std::vector<std::string> keys = {"version",
                                           "machine",
                                           "blas_kernels",
                                           "threads",
                                           "method",
                                           "mode",
                                           "tractions",
                                           "elements",
                                           "rims",
                                           "update",
                                           "vertices",
                                           "faces",
                                           "proxy",
                                           "tetrahedra",
                                           "degrees_of_freedom",
                                           "constrained_vertices",
                                           "seconds",
                                           "peak_memory_bytes",
                                           "predicted_memory_bytes",
                                           "residual",
                                           "condition_estimate",
                                           "fixed_sets",
                                           "loads",
                                           "compliance",
                                           "force_imbalance",
                                           "moment_imbalance",
                                           "error_estimate",
                                           "iterations",
                                           "energy",
                                           "largest_stretch",
                                           "linear_theory_error",
                                           "warnings"};
    for (const std::string& method : kMethods) {
        SCOPED_TRACE(method);
        solve(test::cube_scene(method), {"--report", "r.json", "--threads", "1", "--quiet"});
        const nlohmann::json report = json("r.json");
        EXPECT_EQ(report.size(), keys.size());
        for (const std::string& key : keys) EXPECT_TRUE(report.contains(key)) << key;
        EXPECT_EQ(report["method"], method);
        EXPECT_EQ(report["vertices"], 98);
        EXPECT_EQ(report["faces"], 192);
        EXPECT_EQ(report["constrained_vertices"], 50);
        EXPECT_EQ(report["threads"], 1);
        EXPECT_EQ(report["tetrahedra"].get<int>() > 0, method == "fem");
        EXPECT_LT(report["residual"].get<double>(), 1e-9);
        EXPECT_GE(report["condition_estimate"].get<double>(), 1.0);
        EXPECT_GT(report["seconds"]["total"].get<double>(), 0.0);
    }
}

TEST_F(SolveTest, PrintsASummaryUnlessItShallBeQuiet) {
    const ProgramRun run = solve(test::cube_scene("linear-bem", 2), {});
    for (const char* text : {"linear-bem, on-demand", "26 vertices", "residual", "right", "kernels"})
        EXPECT_THAT(run.out, HasSubstr(text));
    EXPECT_EQ(solve(test::cube_scene("linear-bem", 2), {"--quiet"}).out, "");
}

TEST_F(SolveTest, TheCommandLineOverridesTheMethodOfTheScene) {
    EXPECT_THAT(solve(test::cube_scene("linear-bem", 2), {"--method", "fem"}).out, HasSubstr("fem, on-demand"));
}

TEST_F(SolveTest, ModesAndUpdatesAgree) {
    for (const std::string& method : kMethods) {
        solve(test::cube_scene(method, 2), {"--displacements", "reference.csv", "--quiet"});
        const test::Table reference = test::read_csv(file("reference.csv"));
        for (const char* update : {"direct", "eqn9", "reduced"}) {
            SCOPED_TRACE(method + " " + update);
            solve(test::cube_scene(method, 2),
                  {"--mode", "full", "--update", update, "--displacements", "u.csv", "--quiet"});
            const test::Table table = test::read_csv(file("u.csv"));
            for (std::size_t v = 0; v < table.rows.size(); ++v)
                for (std::size_t axis = 3; axis < 6; ++axis)
                    EXPECT_NEAR(table.rows[v][axis], reference.rows[v][axis], 1e-9 * 0.1);
        }
    }
}

TEST_F(SolveTest, WritesTheMatricesOfTheMode) {
    solve(test::cube_scene("linear-bem", 2), {"--mode", "full", "--matrices", "m", "--quiet"});
    EXPECT_THAT(folder_.listing(), testing::IsSupersetOf({"m/H.npy", "m/G.npy", "m/K.npy", "m/Kinv.npy"}));
    const test::NpyFile h = test::read_npy(file("m/H.npy"));
    ASSERT_EQ(h.rows, 3 * 26);
    for (int row = 0; row < h.rows; ++row) {  // a translation needs no traction
        double sum = 0.0;
        for (int column = 0; column < h.columns; column += 3) sum += h(row, column);
        EXPECT_NEAR(sum, 0.0, 1e-12);
    }
}

TEST_F(SolveTest, WritesTheStiffnessOfFemAsMatrixMarket) {
    solve(test::cube_scene("fem", 2), {"--matrices", "m", "--quiet"});
    EXPECT_THAT(folder_.listing(), ElementsAre("m", "m/K.mtx", "scene.json"));
    EXPECT_THAT(test::read_text(file("m/K.mtx")), testing::StartsWith("%%MatrixMarket matrix coordinate real"));
}

TEST_F(SolveTest, ReplacesAnOutputThatIsThere) {
    folder_.write("u.csv", "before");
    solve(test::cube_scene("linear-bem", 2), {"--displacements", "u.csv", "--quiet"});
    EXPECT_EQ(test::read_csv(file("u.csv")).rows.size(), 26U);
    EXPECT_THAT(folder_.listing(), ElementsAre("scene.json", "u.csv"));
}

TEST_F(SolveTest, WritesOnStandardOutputWhenAskedTo) {
    const ProgramRun run = solve(test::cube_scene("linear-bem", 2), {"--forces", "/dev/stdout"});
    EXPECT_THAT(run.out, testing::StartsWith("name,fx,fy,fz"));
    EXPECT_THAT(run.out, HasSubstr("scene.json: linear-bem"));
}

TEST_F(SolveTest, SaysThatOnlyLinearBemHasAChoiceOfTractions) {
    EXPECT_THAT(solve(test::cube_scene("fem", 2), {"--tractions", "restricted"}).out, HasSubstr("was ignored"));
}

TEST_F(SolveTest, MakesFinerRimsForGalerkinBemAlone) {
    EXPECT_THAT(solve(test::cube_scene("fem", 2), {"--rims", "1"}).out,
                HasSubstr("--rims: applies to galerkin-bem only, and was ignored"));
    const auto report_of = [&](const std::string& rims) {
        EXPECT_THAT(solve(test::cube_scene("galerkin-bem", 6), {"--rims", rims, "--report", "r.json"}).out,
                    HasSubstr(rims == "0" ? "on-demand, " : "2 thin rows along rims"));
        return json("r.json");
    };
    const nlohmann::json given = report_of("0"), finer = report_of("2");
    EXPECT_EQ(given["rims"], 0);
    EXPECT_EQ(finer["rims"], 2);
    EXPECT_LT(finer["residual"].get<double>(), 1e-9);
    EXPECT_LT(finer["error_estimate"]["displacement"].get<double>(),
              given["error_estimate"]["displacement"].get<double>());
    const double taken = finer["peak_memory_bytes"].get<double>() - given["peak_memory_bytes"].get<double>();
    const double predicted =
        finer["predicted_memory_bytes"].get<double>() - given["predicted_memory_bytes"].get<double>();
    EXPECT_GT(predicted, 0.7 * taken);
    EXPECT_LT(predicted, 2.0 * taken + 20e6);
}

TEST_F(SolveTest, EndsWithoutOutputsWhenItIsInterrupted) {
    folder_.write("u.csv", "before");
    for (const std::string& method : kMethods) {
        SCOPED_TRACE(method);
        folder_.write("scene.json", test::cube_scene(method, 16));
        const ProgramRun run =
            test::interrupt_program({"solve", "scene.json", "--displacements", "u.csv"}, folder_.path());
        EXPECT_EQ(run.exit_code, 130);
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(run.err, "elastolab: Interrupted; no output was written.\n");
        EXPECT_EQ(test::read_text(file("u.csv")), "before");
        EXPECT_THAT(folder_.listing(), ElementsAre("scene.json", "u.csv"));
    }
}

/// Whoever asks for one learns so at once, and not after minutes that leave nothing.
TEST_F(SolveTest, FiguresThatCannotBeMadeAreRefusedBeforeAnythingIsComputed) {
    const std::string begin = R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 2},
        "fixed": {"box": {"min": [-1, -1, -1], "max": [2, 2, 0.1]}})";
    const std::string handle = R"(, "handles": [{"select": {"vertices": [26]}, "translate": [0.1, 0, 0]}]})";
    folder_.write("pulled.json", begin + handle);
    folder_.write("hung.json", begin + R"(, "gravity": [0, 0, -1]})");
    folder_.write("held.json", begin + "}");
    const std::vector<std::array<std::string, 3>> cases = {{"pulled.json", "nonlinear-fem", "Choose a linear method."},
                                                           {"hung.json", "fem", "Add a handle"},
                                                           {"held.json", "fem", "Add a handle"}};
    for (const std::string option : {"--figure f.html", "--mesh-out f.glb", "--mesh-out F.GLB"})
        for (const auto& [scene, method, why] : cases) {
            if (scene == "hung.json" && option != "--figure f.html") continue;  // what a load does can be shown
            const std::size_t space = option.find(' ');
            const ProgramRun run = run_program({"solve", scene, "--method", method, option.substr(0, space),
                                                option.substr(space + 1), "--displacements", "u.csv", "--quiet"},
                                               folder_.path());
            EXPECT_EQ(run.exit_code, 2) << option << ' ' << method;
            EXPECT_THAT(run.err, testing::HasSubstr(why));
            EXPECT_THAT(folder_.listing(), testing::UnorderedElementsAre("pulled.json", "hung.json", "held.json"));
        }
}

TEST_F(SolveTest, WritesMorphTargetsOfABodyUnderLoadsAlone) {
    folder_.write("hung.json", R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 2},
        "fixed": {"box": {"min": [-1, -1, -1], "max": [2, 2, 0.1]}}, "gravity": [0, 0, -1]})");
    const ProgramRun run = run_program({"solve", "hung.json", "--mesh-out", "hung.glb", "--quiet"}, folder_.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(test::read_text(folder_.path() / "hung.glb"), testing::HasSubstr(R"("targetNames":["scene"])"));
}

/// Not on a bar of one cell across, which is too stiff all over, nor beyond the finest.
TEST_F(SolveTest, FinerRimsAreAdvisedWhereTheyHelp) {
    const std::string beam = R"({"elastolab": 1, "mesh": {"primitive": "beam", "resolution": 1},
        "fixed": {"box": {"min": [-1, -1, -1], "max": [0.01, 2, 2]}},
        "handles": [{"select": {"box": {"min": [3.9, -1, -1], "max": [5, 2, 2]}}, "translate": [0, 0, 0.1]}]})";
    const std::string sphere = R"({"elastolab": 1, "mesh": {"primitive": "sphere", "resolution": 4},
        "fixed": {"box": {"min": [-2, -2, -2], "max": [2, 2, -0.85]}}, "handles": [{"select":
        {"box": {"min": [-2, -2, 0.85], "max": [2, 2, 2]}}, "rotate": {"axis": [1, 0, 0], "degrees": 5}}]})";
    const auto advice = [&](const std::string& scene, const std::string& rims) {
        solve(scene, {"--method", "galerkin-bem", "--rims", rims, "--report", "r.json", "--quiet"});
        const nlohmann::json report = json("r.json");
        for (const std::string warning : report.at("warnings"))
            if (warning.find("forces are off by") != std::string::npos) return warning;
        return std::string("none");
    };
    EXPECT_THAT(advice(beam, "0"), testing::EndsWith("Refine the mesh."));
    EXPECT_THAT(advice(sphere, "0"), HasSubstr("Choose finer rims"));
    EXPECT_THAT(advice(sphere, "3"), testing::EndsWith("Refine the mesh."));
}

}  // namespace
}  // namespace elastolab
