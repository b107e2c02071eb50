#include "scene/shown.hpp"

#include <algorithm>
#include <array>

namespace elastolab {

namespace {

/// By the numbers of Field.
constexpr std::array kFieldNames = {
    "none",           "displacement", "difference",      "traction",        "displacement-x", "displacement-y",
    "displacement-z", "von-mises",    "first-principal", "third-principal", "stress-xx",      "stress-yy",
    "stress-zz",      "stress-xy",    "stress-yz",       "stress-xz"};
static_assert(kFieldNames.size() == static_cast<std::size_t>(Field::stress_xz) + 1);

}  // namespace

std::vector<std::string> field_names() { return {kFieldNames.begin(), kFieldNames.end()}; }

std::string name(Field field) { return kFieldNames[static_cast<std::size_t>(field)]; }

std::optional<Field> parse_field(std::string_view name) {
    const auto found = std::find(kFieldNames.begin(), kFieldNames.end(), name);
    if (found == kFieldNames.end()) return std::nullopt;
    return static_cast<Field>(found - kFieldNames.begin());
}

std::optional<StressMeasure> stress_of(Field field) {
    if (field < Field::von_mises) return std::nullopt;
    static_assert(static_cast<int>(Field::stress_xz) - static_cast<int>(Field::von_mises) ==
                  static_cast<int>(StressMeasure::xz) - static_cast<int>(StressMeasure::von_mises));
    return static_cast<StressMeasure>(static_cast<int>(field) - static_cast<int>(Field::von_mises));
}

std::optional<int> displacement_axis(Field field) {
    if (field < Field::displacement_x || field > Field::displacement_z) return std::nullopt;
    return static_cast<int>(field) - static_cast<int>(Field::displacement_x);
}

bool is_signed(Field field) { return field > Field::von_mises || displacement_axis(field); }

}  // namespace elastolab
