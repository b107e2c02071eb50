#include "base/text.hpp"

#include <algorithm>
#include <array>
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

/// Bytes of the UTF-8 character that the text begins with; 0 when it is none, or a control code of two bytes, which
/// terminals obey as they obey those of one.
std::size_t size_of_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    if (byte(0) < 0x80) return byte(0) < 0x20 || byte(0) == 0x7f ? 0 : 1;
    const std::size_t size = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (byte(0) < 0xc2 || byte(0) > 0xf4 || (byte(0) == 0xc2 && byte(1) < 0xa0)) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
    return size;
}

}  // namespace

std::string one_line(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        const std::size_t size = size_of_character(text);
        line += size == 0 ? std::string_view(" ") : text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return line;
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

std::string readable_point(const Eigen::Vector3d& x) { return formatted("(%.4g, %.4g, %.4g)", x[0], x[1], x[2]); }

std::string exact(double value) { return formatted("%.17g", value); }

}  // namespace elastolab
