#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "mesh/primitives.hpp"
#include "render/drawing/arrows_drawing.hpp"
#include "render/drawing/axes_gizmo.hpp"
#include "render/drawing/background_drawing.hpp"
#include "render/drawing/ground_drawing.hpp"
#include "render/drawing/legend.hpp"
#include "render/drawing/lines_drawing.hpp"
#include "render/drawing/occlusion_drawing.hpp"
#include "render/drawing/points_drawing.hpp"
#include "render/drawing/shadow_drawing.hpp"
#include "render/drawing/surface_drawing.hpp"
#include "render/geometry/picking.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/gl_window.hpp"

namespace elastolab {
namespace {

constexpr int kWidth = 960, kHeight = 720;
constexpr Viewport kViewport{0, 0, kWidth, kHeight};
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
    Framebuffer picture_{kWidth, kHeight};
    BackgroundDrawing background_;
};

int brightness(const std::array<int, 3>& rgb) { return rgb[0] + rgb[1] + rgb[2]; }

/// A beam along x, twisted by up to `angle` [radians] about its axis.
Eigen::Matrix3Xd twisted(const Eigen::Matrix3Xd& rest, double angle) {
    Eigen::Matrix3Xd positions = rest;
    const double length = rest.row(0).maxCoeff() - rest.row(0).minCoeff();
    const Eigen::Vector3d axis = 0.5 * (rest.rowwise().maxCoeff() + rest.rowwise().minCoeff());
    for (Eigen::Index i = 0; i < rest.cols(); ++i) {
        const double turn = angle * (rest(0, i) - rest.row(0).minCoeff()) / length;
        positions.col(i) = axis + Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX()) * (rest.col(i) - axis);
    }
    return positions;
}

std::vector<float> heights(const Eigen::Matrix3Xd& positions) {
    std::vector<float> values;
    for (Eigen::Index i = 0; i < positions.cols(); ++i) values.push_back(static_cast<float>(positions(2, i)));
    return values;
}

double linear_of_byte(int byte) { return to_linear(byte / 255.0); }

TEST_F(Drawing, ShowsALitSphereBeforeAnUntouchedBackground) {
    const SurfaceMesh mesh = make_sphere(12, 0.9);
    SurfaceDrawing sphere(mesh.vertices, mesh.triangles);
    sphere.draw(start(), {});
    const Image image = finish();
    EXPECT_GT(brightness(at(image, Eigen::Vector3d::Zero())), 400);
    EXPECT_LT(brightness(image.at(3, kHeight - 4)), 90);
    EXPECT_NEAR(image.at(3, 1)[0], 0x2b, 1);
    EXPECT_NEAR(image.at(3, 1)[2], 0x38, 1);
}

TEST_F(Drawing, ShadesACubeEvenlyOnEachFaceWithItsWiresOnTop) {
    const SurfaceMesh mesh = make_box(4, Eigen::Vector3d::Constant(1.0));
    camera_.set_scene({Eigen::Vector3d::Constant(0.5), 0.9});
    camera_.frame(camera_.scene(), kViewport.aspect());
    SurfaceDrawing cube(mesh.vertices, mesh.triangles);
    cube.draw(start(), {});
    const Image plain = finish();
    const auto a = at(plain, {0.2, 0.0, 0.2}), b = at(plain, {0.8, 0.0, 0.8}), top = at(plain, {0.5, 0.5, 1.0});
    EXPECT_NEAR(brightness(a), brightness(b), 25);
    EXPECT_GT(std::abs(brightness(top) - brightness(a)), 40);
    cube.draw(start(), {.wireframe = true, .feature_edges = true});
    const Image wired = finish();
    EXPECT_LT(brightness(at(wired, {0.25, 0.0, 0.4})), brightness(at(plain, {0.25, 0.0, 0.4})) - 60);
    EXPECT_EQ(at(wired, {0.4, 0.0, 0.6 - 0.02}), at(plain, {0.4, 0.0, 0.6 - 0.02}));
}

TEST_F(Drawing, GivesAScalarTheColourOfItsMapUpToShading) {
    const SurfaceMesh mesh = make_sphere(16, 0.9);
    SurfaceDrawing sphere(mesh.vertices, mesh.triangles);
    for (const double value : {0.1, 0.5, 0.9}) {
        const std::vector<float> values(static_cast<std::size_t>(mesh.n_vertices()), static_cast<float>(value));
        sphere.set_vertex_scalars(values);
        for (const float light : {0.0f, 1.0f}) {
            sphere.draw(start(), {.light = light});
            const auto seen = at(finish(), Eigen::Vector3d::Zero());
            const Colour map = colour_maps().front().sample(value);
            const double shade = linear_of_byte(seen[1]) / to_linear(map.g);
            EXPECT_NEAR(shade, 1.0, light > 0.0f ? 0.3 : 0.04);
            EXPECT_NEAR(linear_of_byte(seen[2]) / to_linear(map.b) / shade, 1.0, 0.15);
        }
    }
}

TEST_F(Drawing, GivesEachTriangleItsOwnFlatColour) {
    const SurfaceMesh mesh = make_box(1);
    camera_.set_scene({Eigen::Vector3d::Constant(0.5), 0.9});
    camera_.frame(camera_.scene(), kViewport.aspect());
    SurfaceDrawing cube(mesh.vertices, mesh.triangles);
    std::vector<float> values;
    for (int t = 0; t < mesh.n_triangles(); ++t) values.push_back(static_cast<float>(t) / 11.0f);
    cube.set_triangle_scalars(values);
    cube.draw(start(), {.light = 0.0f});
    const Image image = finish();
    const auto hit = pick(camera_, kViewport, {kWidth / 2 - 60.0, kHeight / 2 + 40.0}, mesh.vertices, mesh.triangles);
    ASSERT_TRUE(hit && hit->triangle >= 0);
    const Colour map = colour_maps().front().sample(hit->triangle / 11.0);
    const auto seen = image.at(kWidth / 2 - 60, kHeight / 2 + 40);
    EXPECT_NEAR(seen[0], 255 * map.r, 2);
    EXPECT_NEAR(seen[1], 255 * map.g, 2);
    EXPECT_NEAR(seen[2], 255 * map.b, 2);
}

TEST_F(Drawing, PutsThePointSpriteWhereThePickedVertexProjects) {
    const SurfaceMesh mesh = make_sphere(6, 0.9);
    SurfaceDrawing sphere(mesh.vertices, mesh.triangles);
    const auto hit = pick(camera_, kViewport, {kWidth / 2 + 50.0, kHeight / 2 - 70.0}, mesh.vertices, mesh.triangles);
    ASSERT_TRUE(hit);
    PointsDrawing points;
    const std::vector<PointSprite> sprites = {{mesh.vertices.col(hit->vertex), colour_of_hex(0xff0000), 10.0f}};
    points.update(sprites, SceneFrame{});
    const SceneView view = start();
    sphere.draw(view, {});
    points.draw(view, {.outline = colour_of_hex(0x00ff00), .outline_width = 3.0f});
    const Image image = finish();
    const Eigen::Vector2d pixel = camera_.project(mesh.vertices.col(hit->vertex), kViewport).pixel;
    const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
    EXPECT_GT(image.at(x, y)[0], 200);
    EXPECT_LT(image.at(x, y)[1], 40);
    for (const int sign : {-1, 1}) EXPECT_GT(image.at(x + sign * 6, y)[1], 200);
    for (const int sign : {-1, 1}) EXPECT_GT(image.at(x + sign * 12, y)[2], 60);
}

TEST_F(Drawing, HidesPointsBehindTheSurfaceUnlessTheyShouldShine) {
    const SurfaceMesh mesh = make_sphere(8, 0.9);
    SurfaceDrawing sphere(mesh.vertices, mesh.triangles);
    PointsDrawing points;
    const Eigen::Vector3d back = -0.9 * camera_.backward();
    points.update(std::vector<PointSprite>{{back, colour_of_hex(0xff0000), 12.0f}}, SceneFrame{});
    SceneView view = start();
    sphere.draw(view, {});
    const auto without = at(finish(), back);
    points.draw(view, {});
    EXPECT_EQ(at(finish(), back), without);
    points.draw(view, {.hidden_opacity = 0.3f});
    EXPECT_LT(at(finish(), back)[2], without[2] - 20);
}

TEST_F(Drawing, DrawsArrowsFromTailToTip) {
    ArrowsDrawing arrows;
    const Eigen::Vector3d right = camera_.right();
    arrows.update(std::vector<Arrow>{{Eigen::Vector3d::Zero(), right, colour_of_hex(0xff8800)}}, SceneFrame{});
    const SceneView view = start();
    arrows.draw(view, {.width = 8.0f});
    const Image image = finish();
    const auto is_orange = [&](double t) {
        const auto seen = at(image, t * right);
        return seen[0] > 120 && seen[0] > 2 * seen[2];
    };
    EXPECT_TRUE(is_orange(0.02) && is_orange(0.5) && is_orange(0.97));
    EXPECT_FALSE(is_orange(-0.03) || is_orange(1.03));
}

TEST_F(Drawing, LooksTheSameAtAnySizeAndPlace) {
    const SurfaceMesh mesh = make_torus(6);
    Image reference;
    for (const SceneFrame& ball : {SceneFrame{Eigen::Vector3d::Zero(), 1.0}, SceneFrame{{3e-9, 0, 1e-9}, 1e-9},
                                   SceneFrame{{-2e9, 5e9, 1e9}, 1e9}}) {
        const Eigen::Matrix3Xd positions = (ball.radius / 1.5 * mesh.vertices).colwise() + ball.center;
        camera_.set_scene(ball);
        camera_.frame(ball, kViewport.aspect());
        SurfaceDrawing torus(positions, mesh.triangles);
        torus.draw(start(), {.wireframe = true});
        const Image image = finish();
        if (reference.pixels.empty()) reference = image;
        std::size_t n_different = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            n_different += std::abs(image.pixels[i] - reference.pixels[i]) > 3;
        EXPECT_LT(n_different, image.pixels.size() / 1000);
    }
}

TEST_F(Drawing, ShowsTheBackFacesThroughATranslucentBody) {
    const SurfaceMesh mesh = make_sphere(8, 0.9);
    SurfaceDrawing sphere(mesh.vertices, mesh.triangles);
    sphere.draw(start(), {.opacity = 0.3f});
    const Image image = finish();
    EXPECT_GT(brightness(at(image, Eigen::Vector3d::Zero())), 150);
    EXPECT_LT(brightness(at(image, Eigen::Vector3d::Zero())), 450);
}

/// How many pixels of a picture have about this colour of the theme.
int n_pixels_of(const Image& image, const Colour& colour, int tolerance = 40) {
    int n = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::array<int, 3> rgb = image.at(x, y);
            n += std::abs(rgb[0] - std::lround(255 * colour.r)) < tolerance &&
                 std::abs(rgb[1] - std::lround(255 * colour.g)) < tolerance &&
                 std::abs(rgb[2] - std::lround(255 * colour.b)) < tolerance;
        }
    return n;
}

/// How many pixels differ between two pictures of one size.
int n_different(const Image& a, const Image& b) {
    int n = 0;
    for (std::size_t i = 0; i + 2 < a.pixels.size(); i += 3)
        n += std::abs(a.pixels[i] - b.pixels[i]) + std::abs(a.pixels[i + 1] - b.pixels[i + 1]) +
                 std::abs(a.pixels[i + 2] - b.pixels[i + 2]) >
             30;
    return n;
}

/// Everything together, as the viewer shows it; also to be looked at ($ELASTOLAB_SHOTS).
class Showcase : public Drawing {
protected:
    Image draw_all(const Colour& top, const Colour& bottom, const Colour& ghost, const std::string& map) {
        const SurfaceMesh mesh = make_box(8, {3.0, 1.0, 1.0});
        const Eigen::Matrix3Xd positions = twisted(mesh.vertices, 1.2);
        const SceneFrame frame = frame_of(positions);
        camera_.set_scene(frame);
        camera_.frame(frame, kViewport.aspect());
        SurfaceDrawing surface(mesh.vertices, mesh.triangles);
        SurfaceDrawing rest(mesh.vertices, mesh.triangles);
        LinesDrawing rim(unpaired_edges(mesh.triangles.leftCols(mesh.n_triangles() / 2)));
        surface.update(positions, frame);
        surface.set_vertex_scalars(heights(positions));
        rest.update(mesh.vertices, frame);
        rim.update(positions, frame);
        picture_.bind();
        background_.draw(top, bottom);
        const SceneView view(camera_, kViewport);
        SurfaceStyle style{.wireframe = true, .feature_edges = true, .colour_map = &colour_map(map)};
        style.low = positions.row(2).minCoeff();
        style.high = positions.row(2).maxCoeff();
        surface.draw(view, style);
        OcclusionDrawing().draw(view, picture_);
        const SceneFrame ground{{frame.center.x(), frame.center.y(), -0.3}, 4.0 * frame.radius};
        ShadowDrawing shadow;
        shadow.update(surface, ground, Eigen::Vector3d::UnitZ());
        picture_.bind();
        ground_.draw(view, ground, Eigen::Vector3d::UnitZ(),
                     {.line = ghost.with_opacity(0.35f), .spacing = 0.5, .shadow = shadow.texture()});
        rest.draw(view, {.colour = ghost, .opacity = 0.1f, .ghost = true});
        rim.draw(view, {.colour = ghost.with_opacity(0.25f), .width = 1.0f});
        draw_marks(view, frame, positions);
        gizmo_.draw(camera_, kViewport, {kWidth - 110.0, 10.0, 100.0, 100.0}, 1.0);
        return finish();
    }
    void draw_marks(const SceneView& view, const SceneFrame& frame, const Eigen::Matrix3Xd& positions) {
        std::vector<PointSprite> sprites;
        std::vector<Arrow> arrows;
        for (Eigen::Index i = 0; i < positions.cols(); ++i) {
            if (positions(0, i) < 1e-9) sprites.push_back({positions.col(i), colour_of_hex(0x2f6fde), 9.0f});
            if (positions(0, i) > 3.0 - 1e-9 && i % 3 == 0) {
                sprites.push_back({positions.col(i), colour_of_hex(0xf08c2e), 9.0f});
                arrows.push_back({positions.col(i), {0.5, 0.0, 0.1}, colour_of_hex(0xf08c2e)});
            }
        }
        points_.update(sprites, frame);
        arrows_.update(arrows, frame);
        arrows_.draw(view, {.hidden_opacity = 0.25f});
        points_.draw(view, {.hidden_opacity = 0.2f});
    }

    GroundDrawing ground_;
    PointsDrawing points_;
    ArrowsDrawing arrows_;
    AxesGizmo gizmo_{{colour_of_hex(0xe05252), colour_of_hex(0x5fb04c), colour_of_hex(0x4a86e8)}};
};

/// Body, supports, handles with their arrows, the gizmo in its corner, and an untouched corner of the background.
TEST_F(Showcase, HasEveryPartOnEveryBackground) {
    struct Theme {
        Colour top, bottom, ghost;
        const char* map;
    };
    const Colour white = colour_of_hex(0xffffff), mist = colour_of_hex(0xdfe5ec), ink = colour_of_hex(0x30353c);
    std::vector<Image> images;
    for (const Theme& theme : {Theme{kTop, kBottom, white, "lagoon"}, Theme{white, mist, ink, "ember"},
                               Theme{white, mist, ink, "balance"}}) {
        const Image image = draw_all(theme.top, theme.bottom, theme.ghost, theme.map);
        EXPECT_GT(n_pixels_of(image, colour_of_hex(0x2f6fde)), 100) << theme.map;  // supports
        EXPECT_GT(n_pixels_of(image, colour_of_hex(0xf08c2e)), 100) << theme.map;  // handles and arrows
        EXPECT_NEAR(image.at(3, 1)[0], std::lround(255 * theme.top.r), 2) << theme.map;
        bool has_gizmo = false;
        for (int x = kWidth - 105; x < kWidth - 15; ++x)
            for (int y = 15; y < 105; ++y) {
                const std::array<int, 3> rgb = image.at(x, y);
                has_gizmo = has_gizmo || rgb[0] > rgb[2] + 80;  // its red axis
            }
        EXPECT_TRUE(has_gizmo) << theme.map;
        images.push_back(image);
    }
    EXPECT_GT(n_different(images[0], images[1]), kWidth * kHeight / 2);   // the background
    EXPECT_GT(n_different(images[1], images[2]), kWidth * kHeight / 50);  // the colours of the body
}

/// Contour bands: far fewer colours than a smooth field has.
TEST_F(Showcase, HasBandsOfOneColour) {
    const SurfaceMesh mesh = make_torus(16, 0.65, 0.27);
    SurfaceDrawing torus(mesh.vertices, mesh.triangles);
    std::vector<float> values;
    for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i)
        values.push_back(static_cast<float>(mesh.vertices(0, i) + 0.5 * mesh.vertices(2, i)));
    torus.set_vertex_scalars(values);
    torus.draw(start(), {.low = -0.9, .high = 0.9});
    const Image smooth = finish();
    torus.draw(start(), {.low = -0.9, .high = 0.9, .contour_bands = 12});
    EXPECT_GT(n_different(smooth, finish()), 1000);
}

/// Wires of triangles of a few pixels fade, and do not cover the surface.
TEST_F(Showcase, HasNoBlackSurfaceOfManyTriangles) {
    const SurfaceMesh mesh = make_torus(60, 0.65, 0.27);
    SurfaceDrawing torus(mesh.vertices, mesh.triangles);
    const auto mean_brightness = [&](bool wireframe) {
        torus.draw(start(), {.wireframe = wireframe});
        const Image image = finish();
        double sum = 0.0;
        for (const std::uint8_t value : image.pixels) sum += value;
        return sum;
    };
    const double plain = mean_brightness(false), wires = mean_brightness(true);
    EXPECT_LT(wires, plain);
    EXPECT_GT(wires, 0.6 * plain);
}

TEST_F(Showcase, HasTheBodyBeforeTheGroundCloseBy) {
    const SurfaceMesh mesh = make_box(8, {3.0, 1.0, 1.0});
    camera_.set_scene(frame_of(mesh.vertices));
    camera_.frame(camera_.scene(), kViewport.aspect());
    const Eigen::Vector3d corner(0.0, 0.0, 1.0);
    camera_.zoom_to(camera_.project(corner, kViewport).pixel, 6.0, corner, kViewport);
    SurfaceDrawing surface(mesh.vertices, mesh.triangles);
    surface.draw(start(), {});
    const Image plain = finish();
    const SceneView view = start();
    surface.draw(view, {.wireframe = true, .feature_edges = true});
    const Image body = finish();
    EXPECT_GT(n_different(plain, body), 1000);
    EXPECT_GT(brightness(body.at(kWidth / 2, kHeight - 5)), brightness({0x2b, 0x30, 0x38}));  // it fills the middle
    ground_.draw(view, camera_.scene(), Eigen::Vector3d::UnitZ(), {.line = colour_of_hex(0xffffff)});
    EXPECT_EQ(n_different(body, finish()), 0);  // the ground is behind it
}

/// What is inside a glass ball shows through it.
TEST_F(Showcase, HasTheInsideOfGlass) {
    const auto drawn = [&](const SurfaceMesh& mesh) {
        SurfaceDrawing surface(mesh.vertices, mesh.triangles);
        surface.draw(start(), {.opacity = 0.35f, .wireframe = true, .wire_opacity = 0.2f});
        return finish();
    };
    const Image hollow = drawn(make_hollow_sphere(16, 0.9, 0.4)), full = drawn(make_sphere(16, 0.9));
    EXPECT_GT(n_different(hollow, full), 1000);
    EXPECT_NE(at(hollow, Eigen::Vector3d::Zero()), at(full, Eigen::Vector3d::Zero()));
}

/// Neighbouring colours differ little, the ends and the middle clearly; sequential maps grow lighter all the way.
TEST(ColourMaps, AreEvenAndTellTheirValuesApart) {
    const auto lightness = [](const Colour& c) {
        return 0.2126 * to_linear(c.r) + 0.7152 * to_linear(c.g) + 0.0722 * to_linear(c.b);
    };
    for (const ColourMap& map : colour_maps()) {
        const auto distance = [&](double a, double b) {
            const Colour p = map.sample(a), q = map.sample(b);
            return std::hypot(p.r - q.r, p.g - q.g, p.b - q.b);
        };
        for (int i = 0; i < 511; ++i) {
            EXPECT_LT(distance(i / 511.0, (i + 1) / 511.0), 0.03) << map.name() << " at " << i;
            if (!map.is_diverging()) {
                EXPECT_LE(lightness(map.sample(i / 511.0)), lightness(map.sample((i + 1) / 511.0)) + 1e-3)
                    << map.name();
            }
        }
        for (const auto& [a, b] : {std::pair{0.0, 0.5}, {0.5, 1.0}, {0.0, 1.0}})
            EXPECT_GT(distance(a, b), 0.2) << map.name();
    }
}

}  // namespace
}  // namespace elastolab
