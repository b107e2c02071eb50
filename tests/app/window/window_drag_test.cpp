// A person's drag in a real window: the vertex stays under the cursor, and the body is what `solve` computes.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "app/real_window.hpp"
#include "app/screen.hpp"
#include "app/stage.hpp"
#include "mesh/primitives.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

constexpr double kCursorPixels = 2.0;
constexpr double kSameAsSolve = 1e-6;  // of the largest displacement

int vertex_near(const SurfaceMesh& mesh, const Eigen::Vector3d& point) {
    int nearest = 0;
    (mesh.vertices.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
    return nearest;
}

/// The vertices of an OBJ file, in its order.
Positions read_vertices(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<Eigen::Vector3d> points;
    std::string word;
    for (std::string line; std::getline(in, line);) {
        std::istringstream fields(line);
        Eigen::Vector3d x;
        if (fields >> word && word == "v" && fields >> x[0] >> x[1] >> x[2]) points.push_back(x);
    }
    Positions positions(3, std::ssize(points));
    for (std::size_t i = 0; i < points.size(); ++i) positions.col(static_cast<Eigen::Index>(i)) = points[i];
    return positions;
}

class RealDrag : public testing::TestWithParam<MethodKind> {};
INSTANTIATE_TEST_SUITE_P(Window, RealDrag, testing::ValuesIn(all_methods()),
                         [](const auto& tested) { return test_name(tested.param); });

TEST_P(RealDrag, KeepsTheVertexUnderTheCursorAndTheBodyIsThatOfSolve) {
    const TemporaryFolder folder;
    Document document = cube_document(4);
    document.method = GetParam();
    save_scene(folder.path() / "cube.json", document);
    const Screen screen(folder.path() / "cube.json", {640, 480});
    RealWindow window({"cube.json", "--size", "640x480", "--scene-out", "out.json", "--mesh-out", "out.obj"},
                      folder.path());
    window.settle();

    // Two handles, the second where the first has carried it.
    Positions shown = screen.mesh().vertices;
    const int first = vertex_near(screen.mesh(), {0.75, 0.5, 1}), second = vertex_near(screen.mesh(), {1, 0.25, 0.5});
    const Eigen::Vector2d from = screen.pixel(shown.col(first)), to = from + Eigen::Vector2d(40, -32);
    window.drag(from, to);
    window.settle();
    const Eigen::Vector2d there = screen.pixel(shown.col(second));
    window.drag(there, there + Eigen::Vector2d(20, 26));
    window.settle();
    const ProgramRun run = window.quit();
    ASSERT_EQ(run.exit_code, 0) << run.err;

    shown = read_vertices(folder.path() / "out.obj");
    ASSERT_EQ(shown.cols(), screen.mesh().n_vertices());
    EXPECT_LT((screen.pixel(shown.col(first)) - to).norm(), kCursorPixels);
    const Document left = load_scene(folder.path() / "out.json");
    EXPECT_EQ(left.handles.size(), 2u);
    EXPECT_EQ(left.method, GetParam());

    ASSERT_EQ(run_program({"solve", "out.json", "--mesh-out", "solved.obj", "--quiet"}, folder.path()).exit_code, 0);
    const Positions solved = read_vertices(folder.path() / "solved.obj");
    ASSERT_EQ(solved.cols(), shown.cols());
    const double size = (solved - screen.mesh().vertices).colwise().norm().maxCoeff();
    EXPECT_GT(size, 0.05);
    EXPECT_LT((solved - shown).colwise().norm().maxCoeff(), kSameAsSolve * size);
}

/// A press on a handle chooses it; then its arrow moves it along one axis and its ring turns it about one.
TEST(RealGizmo, MovesAndTurnsTheChosenHandle) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document_with_handle(4));
    const Screen screen(folder.path() / "cube.json", {640, 480});
    RealWindow window({"cube.json", "--size", "640x480", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.click(screen.pixel({1, 0.5, 0.5}));
    window.settle();
    const Gizmo gizmo = screen.gizmo(0);  // of the world: it stays as it is while the handle turns about its middle
    const std::vector<Eigen::Vector2d> ring = screen.outline(gizmo, {GizmoPart::Kind::ring, 0});
    window.drag(ring[3 * ring.size() / 4], ring[9 * ring.size() / 10]);
    window.settle();
    const Eigen::Vector2d arrow = screen.outline(gizmo, {GizmoPart::Kind::arrow, 2}).back();
    window.drag(arrow, arrow + screen.pixel({1, 0.5, 0.7}) - screen.pixel({1, 0.5, 0.5}));
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);

    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.handles.size(), 1u);
    EXPECT_EQ(left.handles[0].name, "end");
    const auto& motion = std::get<AffineMotion>(left.handles[0].motion);
    const Eigen::Vector3d moved = map_of(motion).displacement({1, 0.5, 0.5});
    EXPECT_NEAR(moved.z(), 0.2, 0.04);
    EXPECT_LT(moved.head<2>().norm(), 1e-9);
    EXPECT_GT(std::abs(motion.rotate.degrees), 4.0);
    EXPECT_NEAR(std::abs(motion.rotate.axis.x()), 1.0, 1e-9);
}

/// A ball without its cap, in triangles that do not hang together, as careless scans come: pressed as soon as the
/// window is there, before anything is computed.
TEST(RealDragOfAScan, MovesWithTheMouseAtOnceAndIsWhatSolveComputes) {
    const TemporaryFolder folder;
    std::ofstream scan(folder.path() / "scan.obj");
    const SurfaceMesh ball = make_primitive("sphere", 10, {});
    int n_vertices = 0;
    for (const auto& t : ball.triangles.colwise()) {
        const Positions corners = ball.vertices(Eigen::all, t);
        if (corners.row(2).mean() > 0.9) continue;
        for (int i = 0; i < 3; ++i)
            scan << "v " << corners(0, i) + 1e-4 * i << " " << corners(1, i) << " " << corners(2, i) << "\n";
        scan << "f " << n_vertices + 1 << " " << n_vertices + 2 << " " << n_vertices + 3 << "\n";
        n_vertices += 3;
    }
    scan.close();
    folder.write("scan.json", R"({"elastolab": 1, "mesh": {"file": "scan.obj"}, "proxy": {"vertices": 300}})");
    RealWindow window({"scan.json", "--size", "1000x700", "--scene-out", "out.json", "--mesh-out", "out.obj"},
                      folder.path());
    const Screen screen(folder.path() / "scan.obj");
    const Eigen::Vector2d from = screen.pixel(Eigen::Vector3d(0.4, 0.4, 0.75)), to = from + Eigen::Vector2d(60, -40);
    // The first may come while the file is still being read; whichever finds the body pulls it, without waiting for
    // more.
    for (int i = 0; i < 4; ++i) {
        window.drag(from, to);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);
    ASSERT_GE(load_scene(folder.path() / "out.json").handles.size(), 1u);

    const Positions shown = read_vertices(folder.path() / "out.obj");
    ASSERT_EQ(run_program({"solve", "out.json", "--mesh-out", "solved.obj", "--quiet"}, folder.path()).exit_code, 0);
    const Positions solved = read_vertices(folder.path() / "solved.obj");
    ASSERT_EQ(shown.cols(), screen.mesh().n_vertices());
    ASSERT_EQ(solved.cols(), shown.cols());
    const double size = (solved - screen.mesh().vertices).colwise().norm().maxCoeff();
    EXPECT_GT(size, 0.05);
    EXPECT_LT((solved - shown).colwise().norm().maxCoeff(), kSameAsSolve * size);
}

}  // namespace
}  // namespace elastolab::test
