#include "app/panels/typed_number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace elastolab {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::optional<double> plain_number(std::string_view text) {
    std::string digits(trimmed(text));
    if (std::count(digits.begin(), digits.end(), ',') == 1 && digits.find('.') == std::string::npos)
        std::replace(digits.begin(), digits.end(), ',', '.');
    if (digits.starts_with('+')) digits.erase(0, 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    // An underflow is no number either: what it would become is 0.
    if (error != std::errc() || end != digits.data() + digits.size()) return {};
    return value;
}

}  // namespace

std::optional<double> typed_number(std::string_view text, std::string_view unit, double before) {
    text = trimmed(text);
    if (!unit.empty() && text.ends_with(unit)) text = trimmed(text.substr(0, text.size() - unit.size()));
    const bool changes = text.starts_with('*') || text.starts_with('/');
    double value = changes ? before : 1.0;
    char operation = changes ? text.front() : '*';
    if (changes) text.remove_prefix(1);
    while (true) {
        const auto next = text.find_first_of("*/");
        const std::optional<double> number = plain_number(text.substr(0, next));
        if (!number) return {};
        value = operation == '*' ? value * *number : value / *number;
        if (next == std::string_view::npos) break;
        operation = text[next];
        text.remove_prefix(next + 1);
    }
    const double size = std::abs(value);
    if (!(size <= kLargestTyped) || (size > 0.0 && size < kSmallestTyped)) return {};
    return value;
}

}  // namespace elastolab
