// The triangles that stand for a large surface while it moves.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "mesh/primitives.hpp"
#include "render/drawing/background_drawing.hpp"
#include "render/drawing/surface_drawing.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/gl_window.hpp"

namespace elastolab {
namespace {

class CoarseDrawing : public testing::Test {
protected:
    CoarseDrawing() { camera_.frame(SceneFrame{}, kViewport.aspect()); }
    ~CoarseDrawing() override { EXPECT_STREQ(gl_error(), ""); }

    std::vector<std::uint8_t> picture(SurfaceDrawing& surface, bool coarse) {
        picture_.bind();
        background_.draw(Colour{}, Colour{});
        surface.draw(SceneView(camera_, kViewport), {.coarse = coarse});
        return picture_.read().pixels;
    }
    /// Mean difference of a channel, of 255.
    static double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
        return sum / static_cast<double>(a.size());
    }

    static constexpr Viewport kViewport{0, 0, 640, 480};
    test::GlWindow window_;
    Camera camera_;
    Framebuffer picture_{640, 480};
    BackgroundDrawing background_;
};

TEST_F(CoarseDrawing, OfALargeSphereLooksAsAllOfIt) {
    const SurfaceMesh mesh = make_sphere(120);
    ASSERT_GT(mesh.n_triangles(), 2 * SurfaceDrawing::kFewTriangles);
    SurfaceDrawing sphere(mesh.vertices, mesh.triangles);
    const auto fine = picture(sphere, false), coarse = picture(sphere, true);
    EXPECT_GT(difference(fine, std::vector<std::uint8_t>(fine.size(), 0)), 10.0) << "something is drawn";
    EXPECT_GT(difference(fine, coarse), 0.0);
    EXPECT_LT(difference(fine, coarse), 1.0);
}

TEST_F(CoarseDrawing, OfASmallSphereOrOfValuesOfTrianglesIsAllOfIt) {
    const SurfaceMesh small = make_sphere(20), large = make_sphere(120);
    SurfaceDrawing few(small.vertices, small.triangles), many(large.vertices, large.triangles);
    EXPECT_EQ(picture(few, false), picture(few, true));
    std::vector<float> values(static_cast<std::size_t>(large.n_triangles()));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 2);
    many.set_triangle_scalars(values);
    EXPECT_EQ(picture(many, false), picture(many, true));
}

}  // namespace
}  // namespace elastolab
