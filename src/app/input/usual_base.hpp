#pragma once

#include "scene/document.hpp"

namespace elastolab {

/// Holds a body where its kind is usually held: cubes, boxes and beams at the left, others at the bottom.
/// Throws MeshError when it cannot be made.
Selector usual_base(const Primitive& primitive);

}  // namespace elastolab
