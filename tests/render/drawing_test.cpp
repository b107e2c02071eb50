#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "mesh/primitives.hpp"
#include "render/arrows_drawing.hpp"
#include "render/axes_gizmo.hpp"
#include "render/background_drawing.hpp"
#include "render/framebuffer.hpp"
#include "render/gl_window.hpp"
#include "render/ground_drawing.hpp"
#include "render/legend.hpp"
#include "render/lines_drawing.hpp"
#include "render/picking.hpp"
#include "render/points_drawing.hpp"
#include "render/surface_drawing.hpp"

namespace elastolab {
namespace {

constexpr Viewport kViewport{0, 0, 480, 360};
const Colour kTop = colour_of_hex(0x2b3038), kBottom = colour_of_hex(0x16181c);

/// A context, a picture and a camera that looks at the unit ball.
class Drawing : public testing::Test {
protected:
    Drawing() {
        camera_.set_view(ViewDirection::isometric);
        camera_.frame(SceneFrame{}, kViewport.aspect());
    }
    ~Drawing() override { EXPECT_STREQ(gl_error(), ""); }

    SceneView start() {
        picture_.bind();
        background_.draw(kTop, kBottom);
        return SceneView(camera_, kViewport);
    }
    /// The picture; also as a file in the folder $ELASTOLAB_SHOTS, to look at.
    Image finish() {
        const Image image = picture_.read();
        const char* const folder = std::getenv("ELASTOLAB_SHOTS");
        const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
        if (folder != nullptr) write_png(std::filesystem::path(folder) / (std::string(test->name()) + ".png"), image);
        return image;
    }
    std::array<int, 3> at(const Image& image, const Eigen::Vector3d& point) const {
        const Eigen::Vector2d pixel = camera_.project(point, kViewport).pixel;
        return image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
    }

    test::GlWindow window_;
    Camera camera_;
    Framebuffer picture_{480, 360};
    BackgroundDrawing background_;
};

int brightness(const std::array<int, 3>& rgb) { return rgb[0] + rgb[1] + rgb[2]; }

TEST_F(Drawing, ShowsALitSphereBeforeAnUntouchedBackground) {
    const SurfaceMesh mesh = make_sphere(12, 0.9);
    SurfaceDrawing sphere(mesh.vertices, mesh.triangles);
    sphere.draw(start(), {});
    const Image image = finish();
    EXPECT_GT(brightness(image.at(240, 180)), 400);
    EXPECT_LT(brightness(image.at(3, 357)), 90);
    EXPECT_NEAR(image.at(3, 1)[0], 0x2b, 1);
    EXPECT_NEAR(image.at(3, 1)[2], 0x38, 1);
}

}  // namespace
}  // namespace elastolab
