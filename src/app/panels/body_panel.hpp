#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "app/panels/widgets.hpp"

namespace elastolab {

struct PanelContext;
class ViewerState;

/// The body: its surface, what is wrong with it, how it is simulated, its material; and new bodies.
class BodyPanel {
public:
    /// ask_open: asks for a file to open.
    void draw(const PanelContext& context, const std::function<void()>& ask_open);
    /// Opens a new body of this shape, of the resolution that was chosen last.
    void make(ViewerState& state, const std::string& shape) {
        primitive_ = shape;
        make(state);
    }

private:
    void draw_defects(const PanelContext& context);
    void draw_proxy(ViewerState& state, float scale);
    void draw_young_modulus(ViewerState& state, float scale);
    void make(ViewerState& state);

    std::string primitive_ = "cube";
    int resolution_ = 13;
    NumberField young_modulus_;
    std::optional<int> proxy_vertices_;  ///< while the slider is held
    std::size_t n_flights_ = 0;          ///< to places of defects
};

}  // namespace elastolab
