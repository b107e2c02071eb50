#pragma once

#include <span>
#include <string_view>

namespace elastolab {

/// A file of shaders/. The build generates the source of this list.
struct EmbeddedShader {
    std::string_view file, text;
};
std::span<const EmbeddedShader> embedded_shaders();

}  // namespace elastolab
