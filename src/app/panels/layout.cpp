#include "app/panels/layout.hpp"
#include "methods/registry.hpp"

#include <algorithm>
#include <cmath>

namespace elastolab {

namespace {

constexpr double kMenu = 23.0, kStatus = 27.0, kGap = 2.0;
constexpr double kPanel = 320.0, kLeastPanel = 216.0, kPanelPart = 0.34;  ///< of the window
constexpr double kLeastScene = 160.0;
constexpr double kShortPanel = 690.0;
constexpr double kLegendWidth = kLegendHeadingWidth + 26.0;  // with the chip's margins
constexpr std::size_t kMostInARow = 3;                       ///< viewports; more share two rows
constexpr double kMostOfScene = 0.3;                         // of its width, for the legend

/// As wide as the person made it, else by the window's width; 0 where it leaves no room for the scene.
double panel_width(double window, double scale, const DisplaySettings& display) {
    if (!display.panel) return 0.0;
    const double most = window - kLeastScene * scale, least = kLeastPanel * scale;
    if (most < least) return 0.0;
    const double wanted =
        display.panel_width > 0.0 ? display.panel_width * scale : std::min(kPanel * scale, kPanelPart * window);
    return std::round(std::clamp(wanted, least, most));
}

double legend_width(const DisplaySettings& display, const Viewport& scene, double scale) {
    return display.field == Field::none ? 0.0 : std::min(kLegendWidth * scale, kMostOfScene * scene.width);
}

}  // namespace

Layout layout_of(const Eigen::Vector2i& window, float scale, const DisplaySettings& display) {
    const double w = std::max(1, window.x()), h = std::max(1, window.y());
    const double menu = std::min(h, kMenu * scale), status = std::min(h - menu, kStatus * scale);
    const double panel = panel_width(w, scale, display);
    const double middle = std::max(1.0, h - menu - status);
    return {.menu = {0, 0, w, menu},
            .panel = {0, menu, panel, middle},
            .scene = {panel, menu, w - panel, middle},
            .status = {0, h - status, w, status}};
}

bool is_short(const Layout& layout, double scale) { return layout.panel.height < kShortPanel * scale; }
bool is_very_tall(const Layout& layout, double scale) { return layout.panel.height >= kVeryTallPanel * scale; }

std::vector<SceneViewport> viewports_of(const ViewerState& state, const Viewport& scene, double scale) {
    if (state.blank()) return {};
    const std::vector<MethodKind> kinds = state.shown_kinds();
    const double legend = legend_width(state.display, scene, scale);
    if (state.compare.mode != CompareMode::side_by_side) {
        std::vector<SceneViewport> one = {{scene, kinds}};
        one.front().place.covered = legend;
        return one;
    }
    // In the order of all methods, so that a switch does not make them jump.
    std::vector<SceneViewport> viewports;
    for (const MethodKind kind : all_methods())
        if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) viewports.push_back({scene, {kind}});
    const std::size_t n_columns = viewports.size() < kMostInARow + 1 ? viewports.size() : (viewports.size() + 1) / 2;
    const std::size_t n_rows = (viewports.size() + n_columns - 1) / n_columns;
    const auto part = [](double whole, double taken, std::size_t n) {
        return std::max(1.0, (whole - taken - kGap * static_cast<double>(n - 1)) / static_cast<double>(n));
    };
    const double width = part(scene.width, legend, n_columns), height = part(scene.height, 0.0, n_rows);
    for (std::size_t i = 0; i < viewports.size(); ++i) {
        const std::size_t column = i % n_columns, row = i / n_columns;
        Viewport& place = viewports[i].place;
        place.x = scene.x + static_cast<double>(column) * (width + kGap);
        place.y = scene.y + static_cast<double>(row) * (height + kGap);
        place.width = width;
        place.height = height;
        if (column + 1 < n_columns) continue;
        place.width += legend;
        place.covered = legend;
    }
    return viewports;
}

}  // namespace elastolab
