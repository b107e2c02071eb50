// The plane that cuts the body open, moved and turned with the mouse in a real window.
#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

#include "app/pixels.hpp"
#include "app/real_window.hpp"
#include "app/screen.hpp"
#include "app/stage.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

using Kind = GizmoPart::Kind;

const Eigen::Vector2i kSize(1000, 940);
const Eigen::Vector3d kMiddle(0.5, 0.5, 0.5);
constexpr double kNear = 0.03;  ///< of the cube: some pixels of the mouse and of the line where it is cut

/// A cube that nothing holds, so that it stays at rest and has no marks.
class RealCut : public testing::Test {
protected:
    RealCut() : screen_(saved_cube(), kSize) {}

    /// Cuts the cube open across x in the middle, drags, and keeps a picture of the scene alone.
    void cut_and_drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
        const Viewport& place = screen_.place();
        const auto text = [](double length) { return std::to_string(std::lround(length)); };
        RealWindow window({"cube.json", "--size", text(kSize.x()) + "x" + text(kSize.y()), "--picture", "cut.png",
                           "--picture-size", text(place.width) + "x" + text(place.height)},
                          folder_.path());
        window.settle();
        window.click({24, 711});  // no wireframe
        window.settle();
        window.click({24, 856});  // "cut open"
        window.settle();
        window.drag(from, to);
        window.settle();
        ASSERT_EQ(window.quit().exit_code, 0);
    }
    /// How far along a line over a face of the cube, 0 to 1, that face is seen.
    double end_of_face(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
        constexpr int kSteps = 500;
        constexpr int kEdge = 25;  // of all three colours: within a face they change little by little
        const Pixels picture(folder_.path() / "cut.png");
        const Eigen::Vector2d corner(screen_.place().x, screen_.place().y);
        const auto at = [&](int i) { return picture.at(screen_.pixel(from + (to - from) * i / kSteps) - corner); };
        for (int i = 1; i <= kSteps; ++i)
            if ((at(i) - at(i - 1)).cwiseAbs().sum() > kEdge) return static_cast<double>(i) / kSteps;
        return 1.0;
    }
    /// Lines along x over the top and over the front, which are seen, end at the plane through `point`.
    void expect_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
        for (const double s : {0.15, 0.4, 0.7})
            for (const Eigen::Vector3d& beside : {Eigen::Vector3d(0, s, 1), Eigen::Vector3d(0, 0, s)}) {
                const Eigen::Vector3d from = beside + Eigen::Vector3d(0.03, 0, 0),
                                      to = beside + Eigen::Vector3d(1, 0, 0);
                const double expected = normal.dot(point - from) / normal.dot(to - from);
                EXPECT_NEAR(end_of_face(from, to), expected, kNear) << "from " << from.transpose();
            }
    }
    void drag_ring_and_expect_its_turn(int axis) {
        const Gizmo gizmo = screen_.plane_gizmo();
        const GizmoPart ring{Kind::ring, axis};
        const std::vector<Eigen::Vector2d> line = screen_.outline(gizmo, ring);
        std::size_t begin = 0;
        while (begin < line.size() && !screen_.takes(gizmo, ring, line[begin])) ++begin;
        std::size_t end = begin;
        const auto angle = [&] { return screen_.dragged(gizmo, ring, line[begin], line[end]); };
        while (end < line.size() && std::abs(angle()) < 0.35) ++end;
        ASSERT_LT(end, line.size());
        cut_and_drag(line[begin], line[end]);
        expect_plane(kMiddle, Eigen::AngleAxisd(angle(), gizmo.axes.col(axis)) * gizmo.axes.col(0));
    }

    const TemporaryFolder folder_;
    const Screen screen_;

private:
    std::filesystem::path saved_cube() const {
        Document document = cube_document(4);
        document.fixed.clear();
        save_scene(folder_.path() / "cube.json", document);
        return folder_.path() / "cube.json";
    }
};

TEST_F(RealCut, MovesWithTheArrow) {
    const Eigen::Vector2d tip = screen_.outline(screen_.plane_gizmo(), {Kind::arrow, 0}).back();
    const Eigen::Vector3d moved = kMiddle + Eigen::Vector3d(0.2, 0, 0);
    cut_and_drag(tip, tip + screen_.pixel(moved) - screen_.pixel(kMiddle));
    expect_plane(moved, Eigen::Vector3d::UnitX());
}

TEST_F(RealCut, TurnsWithTheFirstRing) { drag_ring_and_expect_its_turn(1); }
TEST_F(RealCut, TiltsWithTheSecondRing) { drag_ring_and_expect_its_turn(2); }

}  // namespace
}  // namespace elastolab::test
