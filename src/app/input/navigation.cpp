#include "app/input/navigation.hpp"

#include <GLFW/glfw3.h>

namespace elastolab {

namespace {

ViewDrag left_drag(Navigation navigation, bool shift, bool control) {
    if (navigation == Navigation::paraview && control) return ViewDrag::zoom;
    if (navigation == Navigation::polyscope && control && shift) return ViewDrag::zoom;
    return shift ? ViewDrag::pan : ViewDrag::orbit;
}

ViewDrag middle_drag(Navigation navigation, bool shift, bool control) {
    switch (navigation) {
        case Navigation::blender:
            return shift ? ViewDrag::pan : control ? ViewDrag::zoom : ViewDrag::orbit;
        case Navigation::paraview:
            return shift || control ? ViewDrag::orbit : ViewDrag::pan;
        case Navigation::standard:
        case Navigation::polyscope:
        case Navigation::trackpad:
            break;
    }
    return shift || control ? ViewDrag::pan : ViewDrag::orbit;
}

ViewDrag right_drag(Navigation navigation, bool shift, bool control) {
    if (navigation == Navigation::paraview && !shift) return ViewDrag::zoom;
    if (navigation == Navigation::polyscope && control && shift) return ViewDrag::zoom;
    return ViewDrag::pan;
}

}  // namespace

ViewDrag view_drag(Navigation navigation, int button, int modifiers) {
    const bool shift = (modifiers & GLFW_MOD_SHIFT) != 0, control = (modifiers & GLFW_MOD_CONTROL) != 0;
    if (button == GLFW_MOUSE_BUTTON_LEFT) return left_drag(navigation, shift, control);
    if (button == GLFW_MOUSE_BUTTON_MIDDLE) return middle_drag(navigation, shift, control);
    return right_drag(navigation, shift, control);
}

ViewDrag view_scroll(Navigation navigation, int modifiers) {
    if (navigation != Navigation::trackpad || (modifiers & GLFW_MOD_CONTROL) != 0) return ViewDrag::zoom;
    return (modifiers & GLFW_MOD_SHIFT) != 0 ? ViewDrag::pan : ViewDrag::orbit;
}

ViewHelp view_help(Navigation navigation) {
    switch (navigation) {
        case Navigation::blender:
            return {"middle button, on the body too; left beside the body",
                    "Shift + middle; right; Shift + left beside the body", "wheel; Ctrl + middle"};
        case Navigation::paraview:
            return {"left button beside the body; Shift or Ctrl + middle", "middle; Shift + right or left",
                    "wheel; right; Ctrl + left beside the body"};
        case Navigation::polyscope:
            return {"left button beside the body; middle", "right; Shift + left or middle; Ctrl + middle",
                    "wheel; Ctrl + Shift + left or right"};
        case Navigation::trackpad:
            return {"two fingers; left button beside the body; middle", "two fingers with Shift; right",
                    "two fingers with Ctrl"};
        case Navigation::standard:
            break;
    }
    return {"left button beside the body; middle, on the body too", "right; Shift + left or middle; Ctrl + middle",
            "wheel, to the cursor"};
}

}  // namespace elastolab
