#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "app/panels/gui_fonts.hpp"
#include "app/window/input_event.hpp"
#include "app/window/window.hpp"

namespace elastolab {

/// Dear ImGui in a window. Its input comes from our own events, so that a replay drives the panels as a person does.
class Gui {
public:
    explicit Gui(Window& window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Sets fonts and sizes for the user's scale (1: as the screen suggests). Call it between frames.
    void set_scale(float scale) { fonts_.set_scale(scale); }
    /// Characters that will be shown, in UTF-8: those of scripts beside Latin and Greek get their glyphs from an
    /// installed font, from the next frame on.
    void want_characters(std::string_view text) { fonts_.want_characters(text); }
    /// Begins a frame with these events. `dt` > 0: seconds since the frame before.
    void begin(std::span<const InputEvent> events, double dt);
    /// Draws the panels.
    void end();
    /// Closes the windows that a panel left open when it threw.
    void recover();

    bool wants_mouse() const;
    bool is_in_use() const;   ///< something is pressed, such as a slider on its way
    bool wants_text() const;  ///< a field is being typed in
    /// Keys are for the panels: a field is being typed in, or a menu, a list of choices or a dialog is open.
    bool wants_keys() const;
    const Fonts& fonts() const { return fonts_.fonts(); }
    /// Logical pixels for a length that is 1 on an ordinary screen.
    float scale() const { return fonts_.scale(); }

    /// How many of these events one frame can take: a press and its release must not fall into the same frame,
    /// nor a press or release and what the cursor does after it.
    static std::size_t n_for_one_frame(std::span<const InputEvent> events);

private:
    void feed(const InputEvent& event);
    bool menu_is_open() const;
    void close_menus_on_escape();
    void update_cursor_shape();

    Window& window_;
    GuiFonts fonts_;
    bool popup_was_open_ = false;  ///< before the events of this frame, which may have closed it
};

}  // namespace elastolab
