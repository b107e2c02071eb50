// Forces at haptic rate, as the program gives them.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "cli/solve_case.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"

namespace elastolab {
namespace {

using test::ProgramRun;
using test::run_program;

class FeelTest : public test::SolveTest {
protected:
    /// A cube of edge 1 whose right end is the handle, with this motion in `solve`; more: further keys.
    void write_scene(const std::string& motion, const std::string& more) {
        folder_.write("scene.json", R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 6},
            "method": "galerkin-bem", "material": {"young_modulus": 1000, "poisson_ratio": 0.3},
            "fixed": {"box": {"min": [-1, -1, -1], "max": [0.1, 2, 2]}}, )" +
                                        more +
                                        R"("handles": [{"name": "h", "select": {"box": {"min": [0.9, -1, -1],
            "max": [2, 2, 2]}}, )" + motion +
                                        "}]}");
    }
    /// Force over moment about the middle of the handle, as the hand exerts them, by `solve`.
    Eigen::VectorXd solved() {
        const ProgramRun run = run_program({"solve", "scene.json", "--forces", "f.csv", "--quiet"}, folder_.path());
        EXPECT_EQ(run.exit_code, 0) << run.err;
        const test::Table forces = test::read_csv(file("f.csv"));
        Eigen::Matrix<double, 6, 1> felt(forces.rows.at(1).data());
        felt.tail<3>() -= Eigen::Vector3d(1.0, 0.5, 0.5).cross(felt.head<3>());
        return felt;
    }
    /// The same by `feel`, at rest in this pose.
    Eigen::VectorXd felt(const std::string& pose) {
        folder_.write("path.csv", "time_s,tx,ty,tz,rx,ry,rz\n0," + pose + "\n1," + pose + "\n");
        const ProgramRun run = run_program(
            {"feel", "scene.json", "--path", "path.csv", "--seconds", "0.05", "--forces", "felt.csv"}, folder_.path());
        EXPECT_EQ(run.exit_code, 0) << run.err;
        const test::Table forces = test::read_csv(file("felt.csv"));
        return -Eigen::Matrix<double, 6, 1>(forces.rows.at(0).data());
    }
};

/// Shifted; and turned, by so little that linear theory's turn is a turn.
TEST_F(FeelTest, TellsWhatSolveTells) {
    for (const std::string proxy : {"", R"("proxy": {"use": "always", "vertices": 80}, )"}) {
        write_scene(R"("translate": [0.1, 0, 0.05])", proxy);
        const Eigen::VectorXd shift = solved();
        EXPECT_LT((felt("0.1,0,0.05,0,0,0") - shift).norm(), 1e-9 * shift.norm()) << proxy;
        write_scene(R"("rotate": {"axis": [0, 1, 0], "degrees": 5.729577951308232e-6, "center": [1, 0.5, 0.5]})",
                    proxy);
        const Eigen::VectorXd turn = solved();
        EXPECT_LT((felt("0,0,0,0,1e-7,0") - turn).norm(), 1e-6 * turn.norm()) << proxy;
    }
}

/// The proxy has other vertices, fewer than the cube: other forces.
TEST_F(FeelTest, TakesTheProxyOfTheScene) {
    write_scene(R"("translate": [0.1, 0, 0])", "");
    const double own = felt("0.1,0,0,0,0,0")[0];
    write_scene(R"("translate": [0.1, 0, 0])", R"("proxy": {"use": "always", "vertices": 80}, )");
    EXPECT_GT(std::abs(felt("0.1,0,0,0,0,0")[0] / own - 1.0), 1e-4);
}

/// What balances is the proxy around both cubes, of which one is held: the other one by itself is not.
TEST_F(FeelTest, TakesPartsThatOverlapAsSolveDoes) {
    const SurfaceMesh one = make_box(3);
    SurfaceMesh both{Positions(3, 2 * one.n_vertices()), Triangles(3, 2 * one.n_triangles())};
    both.vertices << one.vertices, one.vertices.colwise() + Eigen::Vector3d(0.5, 0.3, 0.2);
    both.triangles << one.triangles, one.triangles.array() + one.n_vertices();
    save_surface(file("both.obj"), both);
    folder_.write("both.json", R"({"elastolab": 1, "mesh": {"file": "both.obj"}, "method": "fem",
        "fixed": {"plane": {"point": [0, 0, 0], "normal": [1, 0, 0], "tolerance": 1e-9}},
        "gravity": [0, 0, -1e-3], "density": 1,
        "handles": [{"name": "end", "select": {"box": {"min": [1.45, -9, -9], "max": [2, 9, 9]}}, "translate": [0, 0, 0]}]})");
    const ProgramRun solved = run_program({"solve", "both.json", "--quiet"}, folder_.path());
    EXPECT_EQ(solved.exit_code, 0) << solved.err;
    const ProgramRun felt = run_program({"feel", "both.json", "--seconds", "0.05"}, folder_.path());
    EXPECT_EQ(felt.exit_code, 0) << felt.err;
}

TEST_F(FeelTest, ReadsPathsWithAndWithoutHeadings) {
    write_scene(R"("translate": [0, 0, 0])", "");
    folder_.write("plain.csv", "0,0.1,0,0,0,0,0\n1,0.1,0,0,0,0,0\n");
    const ProgramRun run =
        run_program({"feel", "scene.json", "--path", "plain.csv", "--seconds", "0.05", "--forces", "plain-felt.csv"},
                    folder_.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(-test::read_csv(file("plain-felt.csv")).rows.at(0).at(0), felt("0.1,0,0,0,0,0")[0]);
    folder_.write("spreadsheet.csv",
                  "\xEF\xBB\xBFtime_s,tx,ty,tz,rx,ry,rz\r\n\r\n0,0.1,0,0,0,0,0\r\n1,0.1,0,0,0,0,0\r\n\r\n");
    const ProgramRun spreadsheet =
        run_program({"feel", "scene.json", "--path", "spreadsheet.csv", "--seconds", "0.05"}, folder_.path());
    EXPECT_EQ(spreadsheet.exit_code, 0) << spreadsheet.err;
    folder_.write("wide.csv", "0,0.1,0,0,0,0,0\n1,0.1,0,0,0,0,0,7\n");
    const ProgramRun wide = run_program({"feel", "scene.json", "--path", "wide.csv"}, folder_.path());
    EXPECT_EQ(wide.exit_code, 1);
    EXPECT_THAT(wide.err, testing::HasSubstr("wide.csv: line 2 is not"));
    folder_.write("other.csv", "tx,time_s,ty,tz,rx,ry,rz\n0,0.1,0,0,0,0,0\n1,0.1,0,0,0,0,0\n");
    const ProgramRun other = run_program({"feel", "scene.json", "--path", "other.csv"}, folder_.path());
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.err, testing::HasSubstr("other.csv: line 1 names other columns"));
}

/// At haptic rate only the handle that is felt gives way.
TEST_F(FeelTest, RefusesWhatItCannotFollowOrWrite) {
    folder_.write("two.json", R"({"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 2},
        "fixed": {"box": {"min": [-1, -1, -1], "max": [2, 2, 0.1]}},
        "handles": [{"name": "felt", "select": {"box": {"min": [0.9, -1, 0.9], "max": [2, 0.1, 2]}}, "force": [0, 0, 1]},
                    {"name": "pushed", "select": {"box": {"min": [0.9, 0.9, 0.9], "max": [2, 2, 2]}}, "force": [0, 0, 1]}]})");
    const auto refused = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"feel", "two.json", "--method", "fem", "--seconds", "0.1"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = run_program(words, folder_.path());
        EXPECT_NE(run.exit_code, 0);
        return run.err;
    };
    EXPECT_THAT(refused({}), testing::HasSubstr("\"pushed\" moves by a force"));
    EXPECT_THAT(refused({"--handle", "pushed"}), testing::HasSubstr("\"felt\" moves by a force"));
    EXPECT_THAT(refused({"--forces", "missing/f.csv"}), testing::HasSubstr("missing"));
    EXPECT_THAT(refused({"--seconds", "1e12"}), testing::HasSubstr("--seconds"));
    EXPECT_THAT(refused({"--forces", "two.json"}), testing::HasSubstr("is an input"));
    folder_.write("path.csv", "0,0,0,0,0,0,0\n1,0,0,0,0,0,0\n");
    EXPECT_THAT(refused({"--path", "path.csv", "--forces", "path.csv"}), testing::HasSubstr("is an input"));
}

}  // namespace
}  // namespace elastolab
