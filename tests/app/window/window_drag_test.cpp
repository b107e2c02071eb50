// A person's drag in a real window: the vertex stays under the cursor, and the body is what `solve` computes.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <thread>

#include "app/pixels.hpp"
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
    const Screen screen(folder.path() / "cube.json");
    RealWindow window({"cube.json", "--size", "1000x700", "--scene-out", "out.json", "--mesh-out", "out.obj"},
                      folder.path());
    window.settle();

    // Two handles, the second where the first has carried it.
    Positions shown = screen.mesh().vertices;
    const int first = vertex_near(screen.mesh(), {0.75, 0.5, 1}), second = vertex_near(screen.mesh(), {1, 0.25, 0.5});
    const Eigen::Vector2d from = screen.pixel(shown.col(first)), to = from + Eigen::Vector2d(60, -50);
    window.drag(from, to);
    window.settle();
    const Eigen::Vector2d there = screen.pixel(shown.col(second));
    window.drag(there, there + Eigen::Vector2d(30, 40));
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

/// Its face at x = 1 is the handle "end", at rest.
void save_cube_with_handle(const std::filesystem::path& file) {
    Document document = cube_document(4);
    document.handles.push_back(
        {.name = "end", .select = {PlaneSelector{{1, 0, 0}, {1, 0, 0}, 1e-9}}, .motion = AffineMotion{}});
    save_scene(file, document);
}

/// A press on a handle chooses it; then its arrow moves it along one axis and its ring turns it about one.
TEST(RealGizmo, MovesAndTurnsTheChosenHandle) {
    const TemporaryFolder folder;
    save_cube_with_handle(folder.path() / "cube.json");
    const Screen screen(folder.path() / "cube.json");
    RealWindow window({"cube.json", "--size", "1000x700", "--scene-out", "out.json"}, folder.path());
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
    const Eigen::Vector3d moved = motion.matrix * Eigen::Vector3d(1, 0.5, 0.5) + motion.translate;
    EXPECT_NEAR(moved.z(), 0.2, 0.04);
    EXPECT_LT(moved.head<2>().norm(), 1e-9);
    EXPECT_GT(motion.matrix.norm(), 0.1);
    EXPECT_LT(motion.matrix.row(0).norm() + motion.matrix.col(0).norm(), 1e-9);  // about x
}

// Places in the panel of a window of 1000 x 1000 pixels.
const Eigen::Vector2d kSecondRow(60, 434), kRemoveFirst(261, 413), kNewFixedSet(58, 527), kName(90, 577),
    kMove(38, 606);

/// The row of a handle in the panel chooses it; its name and numbers are typed, from field to field by the Tab key.
TEST(RealPanel, AHandleIsNamedMovedAndTurnedByTyping) {
    const TemporaryFolder folder;
    save_cube_with_handle(folder.path() / "cube.json");
    RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.click(kSecondRow);
    window.settle();
    window.type_into(kName, "tip");
    window.click(kMove);  // along x
    window.stroke("ctrl+a");
    for (const char* key : {"0", "period", "2", "5", "Tab", "Tab", "Tab", "Tab", "Tab", "3", "0"}) window.stroke(key);
    window.type("");
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);

    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.handles.size(), 1u);
    EXPECT_EQ(left.handles[0].name, "tip");
    const auto& motion = std::get<AffineMotion>(left.handles[0].motion);
    const Eigen::Vector3d middle(1, 0.5, 0.5);
    EXPECT_LT((motion.matrix * middle + motion.translate - Eigen::Vector3d(0.25, 0, 0)).norm(), 1e-6);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(std::acos(-1.0) / 6.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_LT((motion.matrix - (turn - Eigen::Matrix3d::Identity())).norm(), 1e-6) << motion.matrix;
}

/// What is selected is named after F2, whether it is a handle or a fixed set, and removed by Del.
TEST(RealPanel, KeysNameAndRemoveWhatIsSelected) {
    const TemporaryFolder folder;
    Document document = cube_document(4);
    for (const double x : {0.5, 1.0})
        document.handles.push_back(
            {.name = "", .select = {PlaneSelector{{x, 0, 0}, {1, 0, 0}, 1e-9}}, .motion = AffineMotion{}});
    save_scene(folder.path() / "cube.json", document);
    RealWindow window({"cube.json", "--size", "800x600", "--scene-out", "out.json"}, folder.path());
    window.settle();
    const auto name_selection = [&](const std::string& name) {
        window.stroke("F2");
        window.settle();
        window.type(name);
        window.settle();
    };
    window.stroke("h");
    name_selection("middle");
    window.stroke("j");
    name_selection("wall");
    window.stroke("h");
    window.stroke("Delete");
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);
    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.handles.size(), 1u);
    EXPECT_EQ(left.handles[0].name, "middle");
    ASSERT_EQ(left.fixed.size(), 1u);
    EXPECT_EQ(left.fixed[0].name, "wall");
}

/// Where the bars that head the sections of the panel begin and end: right of everything else in it.
std::vector<int> bars(const std::filesystem::path& picture) {
    const Pixels pixels(picture);
    std::vector<int> places;
    for (int y = 30; y < 960; ++y)
        if (pixels.at({299, y}) != pixels.at({299, y - 1})) places.push_back(y);
    return places;
}

/// The panel of a cube after what was done with its window: before, while and after something is pulled.
TEST(RealPanel, NothingInItMovesDuringADrag) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    const Screen screen(folder.path() / "cube.json", {1000, 1000});
    const Eigen::Vector2d beside(600, 930);
    const auto bars_after = [&](const std::function<void(RealWindow&)>& action) {
        RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json", "--screenshot", "panel.png"},
                          folder.path());
        window.settle();
        action(window);
        EXPECT_EQ(window.wait().exit_code, 0);
        return bars(folder.path() / "panel.png");
    };
    const std::vector<int> at_rest = bars_after([&](RealWindow& window) {
        window.move(beside);  // nothing of the panel explains itself
        window.settle();
        window.close();
    });
    EXPECT_GE(at_rest.size(), 6u);
    const Eigen::Vector2d from = screen.pixel({0.75, 0.25, 1}), to = from + Eigen::Vector2d(20, -30);
    EXPECT_EQ(at_rest, bars_after([&](RealWindow& window) {
                  window.move(from);
                  window.press();
                  for (const double part : {0.3, 0.6, 1.0}) window.move(from + part * (to - from));
                  window.settle();
                  window.close();
              }));
    EXPECT_EQ(at_rest, bars_after([&](RealWindow& window) {
                  window.drag(from, to);
                  window.settle();
                  window.close();
              }));
}

/// Nor does it when another tool is chosen, each of which has settings of its own.
TEST(RealPanel, AnotherToolMovesNothingBelowIt) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    const auto bars_with = [&](const char* tool) {
        RealWindow window({"cube.json", "--size", "1000x1000", "--screenshot", "panel.png"}, folder.path());
        window.settle();
        window.move({600, 930});
        window.stroke(tool);
        window.settle();
        EXPECT_EQ(window.quit().exit_code, 0);
        return bars(folder.path() / "panel.png");
    };
    const std::vector<int> pulling = bars_with("v");
    EXPECT_GE(pulling.size(), 6u);
    for (const char* tool : {"b", "n", "i"}) EXPECT_EQ(bars_with(tool), pulling) << tool;
}

/// Of a handle and a fixed set that were selected one after the other, the list shows only the last as selected; none
/// when that is given up.
TEST(RealPanel, OneRowAtMostIsShownAsSelected) {
    const TemporaryFolder folder;
    save_cube_with_handle(folder.path() / "cube.json");
    const auto selected_rows = [&](const std::vector<const char*>& keys, bool gives_up) {
        RealWindow window({"cube.json", "--size", "1000x1000", "--screenshot", "panel.png"}, folder.path());
        window.settle();
        for (const char* key : keys) window.stroke(key);
        if (gives_up) window.click(kSecondRow);
        window.move({500, 900});
        window.settle();
        EXPECT_EQ(window.quit().exit_code, 0);
        const Pixels pixels(folder.path() / "panel.png");
        const Eigen::Vector2d right(140, 0), first = kSecondRow + right - Eigen::Vector2d(0, 21),
                                             second = kSecondRow + right, empty = second + Eigen::Vector2d(0, 42);
        return std::vector{pixels.at(first) != pixels.at(empty), pixels.at(second) != pixels.at(empty)};
    };
    EXPECT_EQ(selected_rows({"j"}, false), (std::vector{true, false}));
    EXPECT_EQ(selected_rows({"j", "h"}, false), (std::vector{false, true}));
    EXPECT_EQ(selected_rows({"j", "h"}, true), (std::vector{false, false}));
}

/// In a small window the sections share the room below the method: what "Show" has is one click away, not scrolled to.
TEST(RealPanel, ShowIsWithinReachInASmallWindow) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    RealWindow window({"cube.json", "--method", "fem", "--size", "800x600", "--screenshot", "panel.png"},
                      folder.path());
    window.settle();
    window.click({126, 251});  // "Show"
    window.settle();
    window.click({136, 518});  // "light theme"
    window.settle();
    EXPECT_EQ(window.quit().exit_code, 0);
    EXPECT_GT(Pixels(folder.path() / "panel.png").at({300, 500}).minCoeff(), 128);
}

/// Where there is no room for the panel, the name is typed over the scene.
TEST(RealPanel, ANameIsTypedInAWindowTooSmallForThePanel) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    RealWindow window({"cube.json", "--size", "340x300", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.stroke("j");
    window.stroke("F2");
    window.settle();
    window.stroke("ctrl+a");
    window.type("wall");
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);
    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.fixed.size(), 1u);
    EXPECT_EQ(left.fixed[0].name, "wall");
}

/// The button begins a set, a stroke of the brush makes it, its name is typed, and the set that was there is removed.
TEST(RealPanel, AFixedSetIsBegunPaintedNamedAndAnotherRemoved) {
    const TemporaryFolder folder;
    save_cube_with_handle(folder.path() / "cube.json");
    const Screen screen(folder.path() / "cube.json", {1000, 1000});
    RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json"}, folder.path());
    window.settle();
    window.click(kNewFixedSet);
    window.settle();
    window.drag(screen.pixel({0.25, 0.5, 1}), screen.pixel({0.75, 0.5, 1}));
    window.settle();
    window.type_into(kName, "clamp");
    window.click(kRemoveFirst);
    window.settle();
    ASSERT_EQ(window.quit().exit_code, 0);

    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.fixed.size(), 1u);
    EXPECT_EQ(left.fixed[0].name, "clamp");
    const auto& painted = std::get<VertexSelector>(left.fixed[0].select.shape).vertices;
    EXPECT_GE(painted.size(), 2u);
    for (const int v : painted) {
        EXPECT_EQ(screen.mesh().vertices(2, v), 1.0) << "on the top";
        EXPECT_EQ(screen.mesh().vertices(1, v), 0.5) << "along the stroke";
    }
}

/// A single vertex is pulled, which is warned of as soon as the button is let go: the field for its name is where it
/// was.
TEST(RealPanel, AWarningDoesNotMoveWhatIsToBeClicked) {
    const TemporaryFolder folder;
    save_scene(folder.path() / "cube.json", cube_document(4));
    const Screen screen(folder.path() / "cube.json", {1000, 1000});
    RealWindow window({"cube.json", "--size", "1000x1000", "--scene-out", "out.json"}, folder.path());
    window.settle();
    for (int i = 0; i < 20; ++i) window.key("bracketleft");
    const Eigen::Vector2d from = screen.pixel({0.75, 0.25, 1});
    window.drag(from, from + Eigen::Vector2d(20, -30));
    window.settle();
    window.type_into(kName, "tip");
    ASSERT_EQ(window.quit().exit_code, 0);
    const Document left = load_scene(folder.path() / "out.json");
    ASSERT_EQ(left.handles.size(), 1u);
    EXPECT_EQ(left.handles[0].name, "tip");
    ASSERT_EQ(run_program({"solve", "out.json", "--report", "report.json", "--quiet"}, folder.path()).exit_code, 0);
    EXPECT_NE(read_text(folder.path() / "report.json").find("moved alone"), std::string::npos) << "nothing warned of";
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
    folder.write("scan.json", R"({"elastolab": 1, "mesh": {"file": "scan.obj"}, "proxy": {"vertices": 700}})");
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
