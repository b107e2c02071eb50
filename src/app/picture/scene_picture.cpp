#include "app/picture/scene_picture.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/matte.hpp"

namespace elastolab {

namespace {

/// Restores what is changed in the state for a picture.
class LookGuard {
public:
    explicit LookGuard(ViewerState& state)
        : state_(state), pose_(state.camera.pose()), viewports_(state.shown.viewports), grid_(state.display.grid) {}
    ~LookGuard() {
        state_.camera.set_pose(pose_);
        state_.shown.viewports = viewports_;
        state_.display.grid = grid_;
    }
    LookGuard(const LookGuard&) = delete;
    LookGuard& operator=(const LookGuard&) = delete;

private:
    ViewerState& state_;
    CameraPose pose_;
    std::vector<SceneViewport> viewports_;
    bool grid_;
};

void require_possible(const Eigen::Vector2i& size) {
    Eigen::Vector2i largest(0, 0);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, largest.data());
    if (size.minCoeff() < 1 || (size.array() > largest.array()).any())
        throw Error("picture: " + std::to_string(size.x()) + " x " + std::to_string(size.y()) +
                    " pixels; this graphics driver draws up to " + std::to_string(largest.x()) + " x " +
                    std::to_string(largest.y()) + ". Choose a smaller size.");
}

/// The rectangle around all viewports [logical pixels].
Viewport around(const std::vector<SceneViewport>& viewports) {
    Viewport all = viewports.front().place;
    double right = all.x + all.width, bottom = all.y + all.height;
    for (const SceneViewport& viewport : viewports) {
        all.x = std::min(all.x, viewport.place.x);
        all.y = std::min(all.y, viewport.place.y);
        right = std::max(right, viewport.place.x + viewport.place.width);
        bottom = std::max(bottom, viewport.place.y + viewport.place.height);
    }
    all.width = right - all.x;
    all.height = bottom - all.y;
    return all;
}

/// A part of the picture, in its pixels from the top left.
struct Area {
    int x = 0, y = 0, width = 0, height = 0;
};

void fill(Image& image, const Colour& colour) {
    const auto byte = [](float part) { return static_cast<unsigned char>(std::lround(255.0f * part)); };
    const std::array<unsigned char, 3> pixel = {byte(colour.r), byte(colour.g), byte(colour.b)};
    image.pixels.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = pixel[i % 3];
}

void copy_into(const Image& part, int x, int y, Image& whole) {
    for (int row = 0; row < part.height; ++row) {
        const auto from = part.pixels.begin() + std::ptrdiff_t{3} * row * part.width;
        std::copy(from, from + std::ptrdiff_t{3} * part.width,
                  whole.pixels.begin() + std::ptrdiff_t{3} * ((std::ptrdiff_t{y} + row) * whole.width + x));
    }
}

/// Whether an area of the picture is drawn in tiles.
bool is_tiled(const Area& area, int largest_tile) { return std::max(area.width, area.height) > largest_tile; }

/// Draws one viewport in tiles: each a window onto the whole of it, which OpenGL clips. `draw` gets the tile, bound,
/// and the place of its top left corner in the area.
template <class Draw>
void draw_tiles(const Area& area, int largest_tile, const Draw& draw) {
    for (int y = 0; y < area.height; y += largest_tile)
        for (int x = 0; x < area.width; x += largest_tile) {
            const int width = std::min(largest_tile, area.width - x), height = std::min(largest_tile, area.height - y);
            Framebuffer tile(width, height);
            if (is_tiled(area, largest_tile)) tile.be_tile_of(area.width, area.height, x, area.height - height - y);
            tile.bind();
            draw(tile, x, y);
        }
}

}  // namespace

Image scene_picture(SceneRenderer& renderer, ViewerState& state, const Palette& palette, const Eigen::Vector2i& size,
                    int largest_tile) {
    require_possible(size);
    Image picture{size.x(), size.y(), {}};
    fill(picture, palette.border);  // between the viewports
    if (state.shown.viewports.empty()) return picture;
    const LookGuard guard(state);
    const Viewport all = around(state.shown.viewports);
    const double scale_x = size.x() / all.width, scale_y = size.y() / all.height;
    const double pixel_ratio = std::min(scale_x, scale_y);
    CameraPose pose = state.camera.pose();
    pose.distance *= std::max(1.0, scale_y / scale_x);
    state.camera.set_pose(pose);
    for (SceneViewport viewport : state.shown.viewports) {
        const Viewport& place = viewport.place;
        const auto left = static_cast<int>(std::lround((place.x - all.x) * scale_x));
        const auto top = static_cast<int>(std::lround((place.y - all.y) * scale_y));
        const auto right = static_cast<int>(std::lround((place.x + place.width - all.x) * scale_x));
        const auto bottom = static_cast<int>(std::lround((place.y + place.height - all.y) * scale_y));
        const Area area{left, top, std::max(1, right - left), std::max(1, bottom - top)};
        viewport.place = {0.0, 0.0, area.width / pixel_ratio, area.height / pixel_ratio, place.covered};
        std::optional<DepthBuffer> depths;  // occlusion reaches over the borders of tiles
        if (state.display.soft_shadows && is_tiled(area, largest_tile)) {
            depths.emplace(area.width, area.height);
            draw_tiles(area, largest_tile, [&](const Framebuffer& tile, int, int) {
                renderer.draw_depths(state, viewport, palette, pixel_ratio, tile, *depths);
            });
        }
        draw_tiles(area, largest_tile, [&](const Framebuffer& tile, int x, int y) {
            renderer.draw_plain(state, viewport, palette, pixel_ratio, tile, depths ? &*depths : nullptr);
            copy_into(tile.read(), area.x + x, area.y + y, picture);
        });
    }
    return picture;
}

void write_picture(const std::filesystem::path& file, SceneRenderer& renderer, ViewerState& state,
                   const Palette& palette, const Eigen::Vector2i& size, const PictureOptions& options) {
    const auto finish = [&](auto picture) {
        if (options.legend && !state.shown.viewports.empty()) {
            const Viewport all = around(state.shown.viewports);
            Canvas canvas(picture);
            draw_legend(canvas, *options.legend, palette, std::min(size.x() / all.width, size.y() / all.height));
        }
        write_png(file, picture);
    };
    const LookGuard guard(state);
    if (!options.legend)
        for (SceneViewport& viewport : state.shown.viewports) viewport.place.covered = 0.0;
    if (!options.transparent) return finish(scene_picture(renderer, state, palette, size));
    state.display.grid = false;  // it has no edge
    const auto before = [&](float grey) {
        Palette plain = palette;
        plain.background_top = plain.background_bottom = plain.border = {grey, grey, grey, 1.0f};
        return scene_picture(renderer, state, plain, size);
    };
    finish(matte(before(0.0f), before(1.0f)));
}

CameraPose turned(const Camera& camera, const CameraPose& pose, double part) {
    CameraPose result = pose;
    const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * part, camera.up_axis());
    result.orientation = (turn * pose.orientation).normalized();
    return result;
}

}  // namespace elastolab
