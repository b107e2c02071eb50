#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace elastolab {

std::string formatted(const char* format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = std::vsnprintf(nullptr, 0, format, arguments);
    std::string text(static_cast<std::size_t>(std::max(length, 0)), '\0');
    std::vsnprintf(text.data(), text.size() + 1, format, again);
    va_end(again);
    va_end(arguments);
    return text;
}

namespace {

/// Bytes of the UTF-8 character that begins here; 0 when it is not valid.
std::size_t character_size(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x80) return 1;
    if (byte(0) < 0xc2 || byte(0) > 0xf4) return 0;
    const std::size_t size = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (text.size() < size) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(i) & 0xc0U) != 0x80U) return 0;
    return size;
}

/// An ASCII control character, or one of those from U+0080 to U+009F, which terminals obey, too.
bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    return first < 0x20 || first == 0x7f ||
           (first == 0xc2 && character.size() == 2 && static_cast<unsigned char>(character[1]) < 0xa0);
}

}  // namespace

std::string shortened(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) return std::string(text);
    const auto is_inside_character = [&](std::size_t i) {
        return (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80;
    };
    std::size_t size = longest;
    while (size > 0 && longest - size < 3 && is_inside_character(size)) --size;
    return std::string(text.substr(0, size)) + "...";
}

std::string one_line(std::string_view text) {
    std::string line;
    line.reserve(text.size());
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        if (size == 0)
            line += '?';
        else if (is_control(text.substr(0, size)))
            line += ' ';
        else
            line += text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return line;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

std::string readable_bytes(double bytes) {
    constexpr std::array kUnits = {"kB", "MB", "GB", "TB", "PB", "EB"};
    if (bytes < 1000.0) return formatted("%.0f bytes", bytes);
    std::size_t unit = 0;
    double value = bytes / 1000.0;
    for (; value >= 999.95 && unit + 1 < kUnits.size(); ++unit) value /= 1000.0;
    return formatted("%.*f ", value < 9.995 ? 2 : 1, value) + kUnits.at(unit);
}

std::string readable_seconds(double seconds) {
    if (seconds < 1e-3) return formatted("%.0f us", 1e6 * seconds);
    if (seconds < 1.0) return formatted("%.3g ms", 1e3 * seconds);
    if (seconds < 120.0) return formatted("%.3g s", seconds);
    if (seconds < 7200.0) return formatted("%.1f min", seconds / 60.0);
    return formatted("%.1f h", seconds / 3600.0);
}

std::string readable_number(double value, int digits) { return formatted("%.*g", digits, value); }

bool reads_as_whole(double value, double limit) {
    constexpr double kLeast = 999.5;
    return std::abs(value) >= kLeast && std::abs(value) < limit;
}

std::string plain_number(double value, int digits) {
    return reads_as_whole(value) ? formatted("%.0f", value) : readable_number(value, digits);
}

std::string readable_point(const Eigen::Vector3d& x) { return formatted("(%.4g, %.4g, %.4g)", x[0], x[1], x[2]); }

std::string exact(double value) {  // as printf by "%.17g", in an eighth of the time
    std::array<char, 32> text;
    return {text.begin(), std::to_chars(text.begin(), text.end(), value, std::chars_format::general, 17).ptr};
}

std::vector<char32_t> characters_of(std::string_view text) {
    constexpr char32_t kNone = 0xFFFD;
    std::vector<char32_t> characters;
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
        char32_t character = size == 0 ? kNone : size == 1 ? byte(0) : byte(0) & (0x7Fu >> size);
        for (std::size_t i = 1; i < size; ++i) character = character << 6 | (byte(i) & 0x3Fu);
        const bool is_too_long = (size == 3 && character < 0x800) || (size == 4 && character < 0x10000);
        const bool is_no_character = (character >= 0xD800 && character < 0xE000) || character > 0x10FFFF;
        characters.push_back(is_too_long || is_no_character ? kNone : character);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return characters;
}

}  // namespace elastolab
