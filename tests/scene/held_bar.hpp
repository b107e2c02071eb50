#pragma once

#include "scene/document.hpp"
#include "scene/solve.hpp"

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

/// Solved, by ten nodes where the method has a choice of elements.
inline Solution ten_nodes(const Document& document, MethodKind kind) {
    Control control;
    Method method{.kind = kind};
    method.elements = ElementDegree::quadratic;
    return solve({.scene_file = "scene.json", .document = document, .method = method}, control);
}

}  // namespace elastolab
