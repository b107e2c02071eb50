#pragma once

namespace elastolab {

/// Which gestures turn, move and zoom the view. All but the last two of `standard` are what people know from other
/// programs; pulling with the left button on the body is the same in all.
enum class Navigation { standard, blender, paraview, polyscope, trackpad };

/// What a drag, or the wheel, does to the view.
enum class ViewDrag { orbit, pan, zoom };

/// Of a mouse button with these modifiers (codes of GLFW); the left button: where it meets no body.
ViewDrag view_drag(Navigation navigation, int button, int modifiers);
/// Of the wheel, or of two fingers on a trackpad.
ViewDrag view_scroll(Navigation navigation, int modifiers);

/// What these two say, for people: what turns the view, moves it and zooms.
struct ViewHelp {
    const char *turn, *move, *zoom;
};
ViewHelp view_help(Navigation navigation);

}  // namespace elastolab
