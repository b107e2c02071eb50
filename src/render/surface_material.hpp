#pragma once

namespace elastolab {

/// What a surface appears to be made of; shaders/lighting.glsl knows them by number.
enum class SurfaceMaterial { studio, clay, wax, metal };

}  // namespace elastolab
