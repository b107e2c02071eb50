#pragma once

#include <optional>
#include <string_view>

namespace elastolab {

/// Larger ones are mistakes, and no place that is drawn could be as far away; nor are smaller ones meant, but 0.
inline constexpr double kLargestTyped = 1e30, kSmallestTyped = 1e-30;

/// The number that a text in a field means: with a point or a comma before its decimals, a quotient or a product
/// ("1/8"), or what becomes of the number that stood there before ("*2"). Its unit may follow. Nothing for what is no
/// number, or one beyond these sizes.
std::optional<double> typed_number(std::string_view text, std::string_view unit, double before);

}  // namespace elastolab
