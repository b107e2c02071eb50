// Loads in the real window, by mouse and keys.
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "app/real_window.hpp"
#include "app/screen.hpp"
#include "app/stage.hpp"
#include "bem/galerkin/method.hpp"
#include "cli/program.hpp"
#include "fem/method.hpp"
#include "methods/registry.hpp"
#include "scene/file/scene_file.hpp"

namespace elastolab::test {
namespace {

constexpr double kLikeSolve = 1e-6;  // of the largest displacement

Positions vertices_of_obj(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<double> numbers;
    std::string word;
    for (std::string line; std::getline(in, line);) {
        std::istringstream fields(line);
        double x[3];
        if (fields >> word && word == "v" && fields >> x[0] >> x[1] >> x[2]) numbers.insert(numbers.end(), x, x + 3);
    }
    return Eigen::Map<const Positions>(numbers.data(), 3, std::ssize(numbers) / 3);
}

/// What the window has left is what `solve` makes of the scene that it has left.
void expect_shown_as_solved(const std::filesystem::path& folder, const Positions& rest) {
    ASSERT_EQ(run_program({"solve", "out.json", "--mesh-out", "solved.obj", "--quiet"}, folder).exit_code, 0);
    const Positions shown = vertices_of_obj(folder / "out.obj"), solved = vertices_of_obj(folder / "solved.obj");
    ASSERT_EQ(shown.cols(), rest.cols());
    ASSERT_EQ(solved.cols(), rest.cols());
    const double size = (solved - rest).colwise().norm().maxCoeff();
    EXPECT_GT(size, 1e-3);
    EXPECT_LT((solved - shown).colwise().norm().maxCoeff(), kLikeSolve * size);
}

/// A cube with FEM in a window that leaves its scene and its mesh.
struct RealLoads : testing::Test {
    const TemporaryFolder folder;
    const std::filesystem::path scene = saved_cube();
    const Screen screen{scene, {640, 480}};
    RealWindow window{{"cube.json", "--size", "640x480", "--scene-out", "out.json", "--mesh-out", "out.obj"},
                      folder.path()};

    RealLoads() { window.settle(); }
    Document document_left() {
        EXPECT_EQ(window.quit().exit_code, 0);
        return load_scene(folder.path() / "out.json");
    }

private:
    std::filesystem::path saved_cube() const {
        Document document = cube_document(8);
        document.method = kFem;
        save_scene(folder.path() / "cube.json", document);
        return folder.path() / "cube.json";
    }
};

/// The keys choose another method and the force tool, and the mouse presses at once, whether it is there or not.
TEST_F(RealLoads, AForceIsPressedAsSoonAsAMethodIsChosen) {
    window.key("4");  // Galerkin BEM
    window.key("l");
    const Eigen::Vector2d from = screen.pixel({0.75, 0.5, 1});
    window.drag(from, from + Eigen::Vector2d(40, -32));
    window.settle();
    const Document left = document_left();
    EXPECT_EQ(left.method, kGalerkinBem);
    ASSERT_EQ(left.loads.size(), 1u);
    EXPECT_TRUE(left.handles.empty());
    EXPECT_GT(std::get<ForceLoad>(left.loads[0].value).force.norm(), 0.0);
    expect_shown_as_solved(folder.path(), screen.mesh().vertices);
}

TEST_F(RealLoads, APressureIsPaintedAndUndone) {
    window.stroke("k");
    window.drag(screen.pixel({0.4, 0.3, 1}), screen.pixel({0.7, 0.7, 1}));
    window.settle();
    window.stroke("k");
    window.drag(screen.pixel({1, 0.3, 0.3}), screen.pixel({1, 0.7, 0.6}));  // grows the same pressure
    window.settle();
    window.stroke("ctrl+z");
    window.settle();
    const Document left = document_left();
    ASSERT_EQ(left.loads.size(), 1u);
    EXPECT_GT(std::get<PressureLoad>(left.loads[0].value).pressure, 0.0);
    const auto& loaded = std::get<VertexSelector>(left.loads[0].select.shape).vertices;
    EXPECT_GE(loaded.size(), 4u);
    for (const int v : loaded) EXPECT_GT(screen.mesh().vertices(2, v), 0.99) << "the second stroke was taken back";
    expect_shown_as_solved(folder.path(), screen.mesh().vertices);
}

}  // namespace
}  // namespace elastolab::test
