#pragma once

#include "scene/document.hpp"

namespace elastolab {

/// A bar of 4 x 1 x 1 along x with so many cells across, fixed at x = 0.
inline Document held_bar(double young_modulus, int cells) {
    Document document;
    document.mesh = Primitive{.name = "beam", .resolution = cells, .size = {}};
    document.material = {young_modulus, 0.3};
    document.fixed = {{.name = "wall", .select = {PlaneSelector{{0, 0, 0}, {1, 0, 0}, 1e-9}}}};
    return document;
}
/// Its other end.
inline Selector end_of_bar() { return {PlaneSelector{{4, 0, 0}, {1, 0, 0}, 1e-9}}; }

}  // namespace elastolab
