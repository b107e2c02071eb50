#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "elasticity/stress.hpp"

namespace elastolab {

/// What colours the body: lengths and measures, which are not negative, or a stress of either sign.
enum class Field {
    none,
    displacement,
    difference,
    traction,
    displacement_x,
    displacement_y,
    displacement_z,
    von_mises,
    first_principal,
    third_principal,
    stress_xx,
    stress_yy,
    stress_zz,
    stress_xy,
    stress_yz,
    stress_xz
};
/// Names of the fields, as scene files and options have them: "displacement", "von-mises", "stress-xx".
std::vector<std::string> field_names();
std::string name(Field field);
/// Nothing for another text.
std::optional<Field> parse_field(std::string_view name);
/// The stress that a field is; nothing for the others.
std::optional<StressMeasure> stress_of(Field field);
/// The axis along which a field is the displacement; nothing for others.
std::optional<int> displacement_axis(Field field);
/// Whether it has values of either sign, so that zero is in the middle of the colours.
bool is_signed(Field field);

/// A plane through the body at rest, which opens it.
struct Cut {
    int axis = 0;                   ///< the plane's normal before it is turned
    double turn = 0.0, tilt = 0.0;  ///< from there [degree]
    double place = 0.5;             ///< 0 to 1 along its normal, through the body
    bool flip = false;              ///< the other side stays
    bool operator==(const Cut&) const = default;
};

/// What is seen of a scene beside its shape.
struct Shown {
    Field field = Field::none;
    /// Ends of the colours, in the unit of the field; nothing: those of the data.
    std::optional<std::pair<double, double>> range = {};
    std::optional<Cut> cut = {};
    bool operator==(const Shown&) const = default;
};

}  // namespace elastolab
