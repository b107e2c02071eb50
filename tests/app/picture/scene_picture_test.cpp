// Pictures of the scene at any size, drawn off the screen.
#include "app/picture/scene_picture.hpp"

#include <gmock/gmock.h>
#include <stb_image.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "app/panels/layout.hpp"
#include "app/stage.hpp"
#include "app/window/window.hpp"
#include "base/error.hpp"
#include "fem/method.hpp"
#include "mesh/input/export.hpp"
#include "mesh/primitives.hpp"
#include "support/temporary_folder.hpp"

namespace elastolab {
namespace {

using test::Stage;

class ScenePicture : public testing::Test {
protected:
    ScenePicture() {
        stage.state.frame_body();
        stage.settle();
        renderer.upload(stage.state, palette);
    }
    Window window{{.title = "test", .width = 320, .height = 200, .visible = false}};
    Stage stage{3};
    const Palette& palette = dark_palette();
    SceneRenderer renderer;
};

constexpr int kDither = 2;  ///< noise that hides the steps of the background

int largest_difference(const Image& a, const Image& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
    return largest;
}

TEST_F(ScenePicture, IsTheSameInTilesAndWhole) {
    const Eigen::Vector2i size(501, 333);
    const Image whole = scene_picture(renderer, stage.state, palette, size);
    const Image tiles = scene_picture(renderer, stage.state, palette, size, 64);
    EXPECT_EQ(whole.width, 501);
    EXPECT_EQ(whole.height, 333);
    EXPECT_GT(largest_difference(whole, Image{501, 333, std::vector<std::uint8_t>(whole.pixels.size(), 20)}), 50);
    EXPECT_LE(largest_difference(whole, tiles), kDither);
}

/// In a tall view it is seen nearer to the eye than all of the body, where its lines fade away.
TEST_F(ScenePicture, HasAGroundThatEndsNowhereAtOnce) {
    constexpr int kFaint = 8;
    const Eigen::Vector2i size(240, 800);
    const SceneFrame body = stage.state.camera.scene();
    stage.state.camera.frame(body, 0.3);
    stage.state.camera.orbit(0.0, -72.0, {0, 0, 240, 800});  // lower
    stage.state.display.soft_shadows = false;
    const Image with = scene_picture(renderer, stage.state, palette, size);
    stage.state.display.grid = false;
    const Image without = scene_picture(renderer, stage.state, palette, size);
    const auto row_of = [](const Image& image, std::ptrdiff_t row) {
        const std::ptrdiff_t length = std::ssize(image.pixels) / image.height;
        const auto begin = image.pixels.begin() + row * length;
        return Image{image.width, 1, {begin, begin + length}};
    };
    std::vector<int> lines;  // by row, as strong as they are
    for (int row = size.y() / 2; row < size.y(); ++row)
        lines.push_back(largest_difference(row_of(with, row), row_of(without, row)));
    while (!lines.empty() && lines.back() <= kDither) lines.pop_back();
    ASSERT_FALSE(lines.empty());
    EXPECT_LT(lines.size(), static_cast<std::size_t>(size.y()) / 2) << "all of it is seen";
    EXPECT_LE(lines.back(), kFaint) << testing::PrintToString(lines);
}

/// What covers a point may be tiles away.
TEST_F(ScenePicture, HasTheSameOcclusionInTilesAndWhole) {
    Document document;
    document.mesh = Primitive{.name = "torus", .resolution = 6, .size = {}};
    stage.open(document);
    stage.state.frame_body();
    stage.settle();
    DisplaySettings& display = stage.state.display;
    display.wireframe = display.feature_edges = display.grid = false;
    renderer.upload(stage.state, palette);
    const Eigen::Vector2i size(333, 261);
    const Image whole = scene_picture(renderer, stage.state, palette, size);
    for (const int tile : {50, 97}) {
        const Image tiles = scene_picture(renderer, stage.state, palette, size, tile);
        EXPECT_LE(largest_difference(whole, tiles), kDither) << tile;
    }
    display.soft_shadows = false;
    EXPECT_GT(largest_difference(whole, scene_picture(renderer, stage.state, palette, size)), 30);
}

TEST_F(ScenePicture, ShowsAllOfTheBodyInANarrowOneAndLeavesTheCameraAlone) {
    stage.state.display.grid = false;
    const CameraPose pose = stage.state.camera.pose();
    Palette plain = palette;
    plain.background_top = plain.background_bottom = {0.0f, 0.0f, 0.0f, 1.0f};
    const Image picture = scene_picture(renderer, stage.state, plain, {120, 600});
    int lit = 0;
    for (int y = 0; y < picture.height; ++y)
        for (const int x : {0, 1, picture.width - 2, picture.width - 1}) {
            const auto [r, g, b] = picture.at(x, y);
            lit += r + g + b > 30 ? 1 : 0;
        }
    EXPECT_EQ(lit, 0) << "the body ends before the sides";
    const auto [r, g, b] = picture.at(60, 300);
    EXPECT_GT(r + g + b, 60);
    EXPECT_EQ(stage.state.camera.pose().distance, pose.distance);
}

/// A legend explains colours that nothing else changes: a body that hangs below the ground, before its rest shape.
TEST_F(ScenePicture, TheGroundAndTheRestShapeLeaveTheColoursOfAField) {
    LiveScene& scene = stage.state.scene();
    std::vector<int> right;
    for (int v = 0; v < scene.mesh().n_vertices(); ++v)
        if (scene.mesh().vertices(0, v) > 1.0 - 1e-9) right.push_back(v);
    scene.set_motion(scene.add_handle(right), AffineMotion{.translate = {0.4, 0, -1.6}});
    DisplaySettings& display = stage.state.display;
    display.field = Field::von_mises;
    display.wireframe = display.feature_edges = display.arrows = false;
    stage.settle();
    stage.state.frame_body();
    Palette plain = palette;
    plain.background_top = plain.background_bottom = {0.0f, 0.0f, 0.0f, 1.0f};
    const auto picture = [&](bool ground, bool rest) {
        display.grid = display.soft_shadows = ground;
        display.rest_shape = rest;
        renderer.upload(stage.state, plain);
        return scene_picture(renderer, stage.state, plain, {300, 300});
    };
    const Image body = picture(false, false), before_rest = picture(false, true), on_ground = picture(true, false);
    int n_body = 0, n_tinted = 0, n_dark = 0;
    for (int y = 0; y < body.height; ++y)
        for (int x = 0; x < body.width; ++x) {
            const auto [r, g, b] = body.at(x, y);
            if (r + g + b < 60) continue;
            const auto [rr, rg, rb] = before_rest.at(x, y);
            const auto [gr, gg, gb] = on_ground.at(x, y);
            ++n_body;
            n_tinted += std::abs(rr - r) + std::abs(rg - g) + std::abs(rb - b) > 24;
            n_dark += 2 * (gr + gg + gb) < r + g + b;
        }
    EXPECT_GT(n_body, 3000);
    EXPECT_LT(n_tinted, n_body / 20) << "of " << n_body << ": but for the outline";
    EXPECT_LT(n_dark, n_body / 200) << "of " << n_body;
}

TEST_F(ScenePicture, WithoutBackgroundIsOpaqueOnTheBodyAndClearBesideIt) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "clear.png";
    write_picture(file, renderer, stage.state, palette, {400, 300}, {.transparent = true, .legend = {}});
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(stbi_load(file.c_str(), &width, &height, &channels, 0),
                                                           stbi_image_free);
    ASSERT_NE(pixels, nullptr);
    ASSERT_EQ(channels, 4);
    ASSERT_EQ(width, 400);
    const auto at = [&](int x, int y) { return pixels.get() + 4 * (y * width + x); };
    EXPECT_EQ(at(200, 150)[3], 255);
    EXPECT_GT(at(200, 150)[0] + at(200, 150)[1] + at(200, 150)[2], 60);
    for (const auto& [x, y] : {std::pair(2, 2), std::pair(397, 2), std::pair(2, 297), std::pair(397, 297)})
        EXPECT_EQ(at(x, y)[3], 0);
}

/// What is changed by marks of this colour is a face of the cube, and hardly a pixel of it has the colour itself.
void expect_tint(const Image& with, const Image& without, const Colour& colour) {
    const Eigen::Vector3f dot = 255.0f * Eigen::Vector3f(colour.r, colour.g, colour.b);
    int changed = 0, tinted = 0;
    for (std::size_t i = 0; i + 2 < with.pixels.size(); i += 3) {
        const auto at = [&](const Image& image) {
            return Eigen::Vector3f(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
        };
        if ((at(with) - at(without)).norm() < 12.0f) continue;
        ++changed;
        if ((at(with) - dot).norm() > 30.0f) ++tinted;
    }
    EXPECT_GT(changed, 4000);
    EXPECT_GT(tinted, 0.8 * changed);
}

/// Dots at a patch of more than 300 vertices would hide the body: most of what it changes is a tint.
TEST_F(ScenePicture, TintsALargePatch) {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = 20, .size = {}};
    document.method = kFem;
    document.fixed = {{.select = {PlaneSelector{{0, 0, 0}, {0, 1, 0}, 1e-9}}}};
    stage.open(document);
    stage.state.frame_body();
    stage.state.display.wireframe = false;
    const auto picture = [&](bool constraints) {
        stage.state.display.constraints = constraints;
        stage.settle();
        stage.state.update_picture();
        renderer.upload(stage.state, palette);
        return scene_picture(renderer, stage.state, palette, {640, 400});
    };
    ASSERT_GT(stage.scene().fixed_vertices(0).size(), PatchAreas::kMostDots);
    expect_tint(picture(true), picture(false), palette.fixed);
}

/// So would they where the mouse points at.
TEST_F(ScenePicture, TintsALargePatchThatTheMousePointsAt) {
    Document document;
    document.mesh = Primitive{.name = "cube", .resolution = 20, .size = {}};
    document.method = kFem;
    stage.open(document);
    stage.state.frame_body();
    stage.state.display.wireframe = false;
    stage.state.tools.patch_radius = 0.6;
    const auto picture = [&](const Eigen::Vector2d& cursor) {
        stage.move(cursor);
        stage.settle();
        stage.state.update_picture();
        renderer.upload(stage.state, palette);
        return scene_picture(renderer, stage.state, palette, {640, 400});
    };
    const Image with = picture(stage.pixel(stage.vertex_near({0.5, 0.0, 0.5})));
    ASSERT_GT(stage.state.gestures.hover().patch.size(), PatchAreas::kMostDots);
    expect_tint(with, picture(stage.empty_place()), palette.hover);
}

/// A box whose triangles hang together nowhere.
SurfaceMesh loose_box(int cells) {
    const SurfaceMesh box = make_box(cells);
    SurfaceMesh loose{Positions(3, 3 * box.n_triangles()), Triangles(3, box.n_triangles())};
    for (int t = 0; t < box.n_triangles(); ++t) {
        const Positions corners = box.vertices(Eigen::all, box.triangles.col(t));
        const Eigen::Vector3d middle = corners.rowwise().mean();
        loose.vertices.middleCols<3>(3 * t) = (0.9 * corners).colwise() + 0.1 * middle;
        loose.triangles.col(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    }
    return loose;
}

/// The body has to be seen behind them.
TEST_F(ScenePicture, DrawsThousandsOfOpenEdgesFaintly) {
    const test::TemporaryFolder folder;
    const Eigen::Vector3f bad = 255.0f * Eigen::Vector3f(palette.bad.r, palette.bad.g, palette.bad.b);
    const auto n_bad = [&](int cells) {
        save_surface(folder.path() / "loose.ply", loose_box(cells));
        stage.state.files.open_now(folder.path() / "loose.ply");
        stage.frame();
        stage.state.update_picture();
        renderer.upload(stage.state, palette);
        const Image image = scene_picture(renderer, stage.state, palette, {640, 400});
        int n = 0;
        for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3)
            if ((Eigen::Vector3f(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]) - bad).norm() < 40.0f) ++n;
        return n;
    };
    const int few = n_bad(4);  // 576 edges, and then 5184
    EXPECT_GT(few, 1000);
    EXPECT_LT(n_bad(12), few / 10);
}

TEST_F(ScenePicture, PutsMarksTogetherAnewOnlyWhenTheyHaveChanged) {
    const auto updates = [&] {
        renderer.upload(stage.state, palette);
        return renderer.n_mark_updates();
    };
    const int before = updates();
    EXPECT_GT(before, 0);
    stage.state.camera.orbit(10.0, 5.0, {0, 0, 320, 200});
    stage.frame();
    stage.move(stage.pixel(0));
    stage.frame();
    EXPECT_EQ(updates(), before) << "another view, and what the mouse points at";
    stage.state.gestures.select_fixed(0);
    EXPECT_EQ(updates(), before + 1) << "selected";
    stage.scene().remove_fixed_set(0);
    stage.scene().commit();
    EXPECT_GT(updates(), before + 1) << "another set";
}

TEST_F(ScenePicture, HasALegendWithTheColoursOfTheFieldWhereThatIsWanted) {
    EXPECT_FALSE(legend_of(stage.state)) << "nothing is coloured";
    stage.state.display.field = Field::displacement;
    stage.state.display.typed_ranges[Field::displacement] = {0.0, 2.0};
    stage.settle();
    stage.state.update_picture();
    renderer.upload(stage.state, palette);
    const std::optional<PictureLegend> legend = legend_of(stage.state);
    ASSERT_TRUE(legend);
    EXPECT_EQ(legend->scale.low, 0.0);
    EXPECT_EQ(legend->scale.high, 2.0);
    EXPECT_NE(legend->heading.find("displacement"), std::string::npos);

    const Image plain = scene_picture(renderer, stage.state, palette, {640, 400});
    Image drawn = plain;
    Canvas canvas(drawn);
    draw_legend(canvas, *legend, palette, 1.0);
    int left = drawn.width, top = drawn.height;
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x)
            if (drawn.at(x, y) != plain.at(x, y)) {
                left = std::min(left, x);
                top = std::min(top, y);
            }
    EXPECT_GT(left, 400) << "at the right";
    EXPECT_GT(top, 100) << "at the bottom";
    EXPECT_LT(left, 600);
    const auto shows = [&](const Colour& colour) {
        for (int y = top; y < drawn.height; ++y)
            for (int x = left; x < drawn.width; ++x) {
                const auto [r, g, b] = drawn.at(x, y);
                if (std::abs(r - 255.0f * colour.r) < 2.0f && std::abs(g - 255.0f * colour.g) < 2.0f &&
                    std::abs(b - 255.0f * colour.b) < 2.0f)
                    return true;
            }
        return false;
    };
    for (const double t : {0.02, 0.5, 0.98}) EXPECT_TRUE(shows(legend->colours->sample(t))) << t;
}

TEST_F(ScenePicture, OfASizeBeyondTheDriverIsRefused) {
    EXPECT_THROW(scene_picture(renderer, stage.state, palette, {100, 1 << 30}), Error);
}

}  // namespace
}  // namespace elastolab
