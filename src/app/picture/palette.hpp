#pragma once

#include <array>

#include "deform/method.hpp"
#include "methods/registry.hpp"
#include "render/colour.hpp"

namespace elastolab {

/// The colours of a theme, for the scene and the panels.
struct Palette {
    Colour background_top, background_bottom;
    Colour panel, panel_raised, border, text, text_dim, accent;
    Colour good, busy, bad;
    Colour wire, grid, outline;
    Colour fixed, fixed_active, handle, active, hover, probe, load;
    std::array<Colour, 3> axes;
    std::array<Colour, 6> bodies;  ///< by MethodTraits::colour

    const Colour& body(MethodKind kind) const;
    /// The same for words on a panel.
    Colour words(MethodKind kind) const;
};

const Palette& dark_palette();
const Palette& light_palette();

/// Gives Dear ImGui these colours, and measures for this scale.
void apply_style(const Palette& palette, float scale);

}  // namespace elastolab
