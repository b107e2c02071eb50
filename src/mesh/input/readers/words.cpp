#include "mesh/input/readers/words.hpp"

#include <algorithm>

namespace elastolab {

namespace {

/// from_chars takes no plus sign.
std::string_view without_plus(std::string_view word) {
    const bool signed_number = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
    return signed_number ? word.substr(1) : word;
}

}  // namespace

std::size_t line_number(std::string_view text, std::size_t position) {
    std::size_t line = 1;
    for (std::size_t i = 0; i < std::min(position, text.size()); ++i) {
        const bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (is_line_end(text[i]) && !pair) ++line;
    }
    return line;
}

std::optional<double> to_double(std::string_view word) {
    word = without_plus(word);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size()) return std::nullopt;
    if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
    if (error != std::errc()) return std::nullopt;
    return value;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
    word = without_plus(word);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error != std::errc()) return std::nullopt;
    return value;
}

std::string in_quotes(std::string_view word) {
    constexpr std::size_t kLongest = 30;
    return "'" + std::string(word.substr(0, kLongest)) + (word.size() > kLongest ? "..." : "") + "'";
}

}  // namespace elastolab
