#pragma once

#include "scene/document.hpp"

namespace elastolab {

/// The support that a new body begins with: cubes, boxes and beams are held at the left, others at the bottom.
/// Throws MeshError when it cannot be made.
Selector default_support(const Primitive& primitive);

}  // namespace elastolab
