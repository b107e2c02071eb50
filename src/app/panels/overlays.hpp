#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/panels/panel_context.hpp"

struct ImDrawList;
struct ImFont;
struct ImVec2;

namespace elastolab {

class LabelPlaces;

/// From the edges of the scene to what is written over it [logical pixels at scale 1].
inline constexpr float kOverlayMargin = 14.0f;

/// What is written and drawn over the scene, in logical pixels of the window.
ImVec2 im_point(double x, double y);

/// What lies behind words over the scene, so that they are readable on any body.
void chip(const PanelContext& context, ImDrawList& list, ImVec2 low, ImVec2 high, float opacity = 0.72f);

struct OverlayLine {
    ImFont* font;
    float size;
    Colour colour;
    std::string text;
};
/// Lines under one another on a chip, broken where they are wider than `width`; the lower right corner of the words.
ImVec2 draw_lines(const PanelContext& context, ImDrawList& list, ImVec2 place, float width,
                  const std::vector<OverlayLine>& lines, float opacity = 0.72f);

/// Draws what is at points of the body: forces, extremes, probes, gizmos.
void draw_marks(const PanelContext& context, ImDrawList& list, const SceneViewport& viewport, LabelPlaces& labels);

/// Draws the colours of the field that is shown, with round numbers, at the right of the scene; nothing where none is.
void draw_legend(const PanelContext& context, ImDrawList& list);

/// Draws messages, of which errors stay until they are dismissed.
void draw_messages(const PanelContext& context);

}  // namespace elastolab
