#pragma once

#include <Eigen/Core>

namespace elastolab {

/// A colour as screens and ImGui know it: sRGB components and opacity, in [0, 1].
struct Colour {
    float r = 0.0f, g = 0.0f, b = 0.0f, a = 1.0f;

    Colour with_opacity(float opacity) const { return {r, g, b, opacity}; }
    bool operator==(const Colour&) const = default;
};

/// From 0xRRGGBB, opaque.
Colour colour_of_hex(unsigned rgb);
/// Linear light of an sRGB component, and back.
double to_linear(double srgb);
double to_srgb(double linear);
/// The components in linear light, as shaders compute with them; the opacity as it is.
Colour linear(const Colour& colour);

/// OKLab coordinates (lightness L in [0, 1], a: green to red, b: blue to yellow), in which equal distances look equally
/// different. Reference: B. Ottosson, "A perceptual color space for image processing", 2020.
Eigen::Vector3d to_oklab(const Colour& colour);
/// sRGB components, unclamped: outside [0, 1] when no screen can show it.
Eigen::Vector3d oklab_to_srgb(const Eigen::Vector3d& lab);

/// Between two colours by OKLab, t in [0, 1]; the opacity goes along.
Colour mix(const Colour& from, const Colour& to, double t);

}  // namespace elastolab
