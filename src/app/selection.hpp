#pragma once

#include <optional>
#include <string>

namespace elastolab {

class ViewerState;

// What keys and menu entries act on. Gestures keeps which one it is; nothing more is kept.

/// A handle, or a fixed set, by its number.
struct Selection {
    bool fixed = false;
    int number = -1;
    bool operator==(const Selection&) const = default;
};

/// The one that was chosen or pulled last; nothing where none is.
std::optional<Selection> selection(const ViewerState& state);
std::string selected_name(const ViewerState& state);  ///< empty where none is

/// Removes it, or the load or gravity when one of these was chosen last.
void remove_selection(ViewerState& state);
void frame_selection(ViewerState& state);
/// Selects the next one in the list, after the last the first; does nothing where there is none.
void select_next_handle(ViewerState& state);
void select_next_fixed_set(ViewerState& state);
/// The next stroke of brush or box, of which one becomes the tool, makes a fixed set.
void begin_fixed_set(ViewerState& state);

}  // namespace elastolab
