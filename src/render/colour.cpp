#include "render/colour.hpp"

#include <cmath>
#include <Eigen/LU>

namespace elastolab {

namespace {

/// Linear sRGB to the cone compliance columns of OKLab, and their cube roots to Lab.
const Eigen::Matrix3d& cones() {
    static const Eigen::Matrix3d matrix{{0.4122214708, 0.5363325363, 0.0514459929},
                                        {0.2119034982, 0.6806995451, 0.1073969566},
                                        {0.0883024619, 0.2817188376, 0.6299787005}};
    return matrix;
}

const Eigen::Matrix3d& lab_of_cones() {
    static const Eigen::Matrix3d matrix{{0.2104542553, 0.7936177850, -0.0040720468},
                                        {1.9779984951, -2.4285922050, 0.4505937099},
                                        {0.0259040371, 0.7827717662, -0.8086757660}};
    return matrix;
}

}  // namespace

Colour colour_of_hex(unsigned rgb) {
    const auto part = [rgb](int shift) { return static_cast<float>((rgb >> shift) & 0xffu) / 255.0f; };
    return {part(16), part(8), part(0), 1.0f};
}

double to_linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }

double to_srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

Colour linear(const Colour& colour) {
    const auto part = [](float srgb) { return static_cast<float>(to_linear(srgb)); };
    return {part(colour.r), part(colour.g), part(colour.b), colour.a};
}

Eigen::Vector3d to_oklab(const Colour& colour) {
    const Eigen::Vector3d linear(to_linear(colour.r), to_linear(colour.g), to_linear(colour.b));
    const Eigen::Vector3d response = cones() * linear;
    return lab_of_cones() * response.unaryExpr([](double x) { return std::cbrt(x); });
}

Eigen::Vector3d oklab_to_srgb(const Eigen::Vector3d& lab) {
    static const Eigen::Matrix3d roots_of_lab = lab_of_cones().inverse(), linear_of_cones = cones().inverse();
    const Eigen::Vector3d response = (roots_of_lab * lab).array().cube();
    return (linear_of_cones * response).unaryExpr([](double x) { return to_srgb(x); });
}

Colour mix(const Colour& from, const Colour& to, double t) {
    const Eigen::Vector3d lab = (1.0 - t) * to_oklab(from) + t * to_oklab(to);
    const Eigen::Vector3f rgb = oklab_to_srgb(lab).cwiseMax(0.0).cwiseMin(1.0).cast<float>();
    return {rgb.x(), rgb.y(), rgb.z(), static_cast<float>((1.0 - t) * from.a + t * to.a)};
}

}  // namespace elastolab
