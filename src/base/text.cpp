#include "base/text.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace elastolab {

namespace {

std::string formatted(const char* format, double value) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, value);
    return buffer.data();
}

}  // namespace

std::string one_line(std::string_view text) {
    std::string line(text);
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return line;
}

std::string readable_bytes(double bytes) {
    constexpr std::array kUnits = {"kB", "MB", "GB", "TB", "PB", "EB"};
    if (bytes < 1000.0) return formatted("%.0f bytes", bytes);
    std::size_t unit = 0;
    double value = bytes / 1000.0;
    for (; value >= 999.95 && unit + 1 < kUnits.size(); ++unit) value /= 1000.0;
    return formatted(value < 9.995 ? "%.2f " : "%.1f ", value) + kUnits.at(unit);
}

std::string readable_seconds(double seconds) {
    if (seconds < 1e-3) return formatted("%.0f us", 1e6 * seconds);
    if (seconds < 1.0) return formatted("%.3g ms", 1e3 * seconds);
    if (seconds < 120.0) return formatted("%.3g s", seconds);
    if (seconds < 7200.0) return formatted("%.1f min", seconds / 60.0);
    return formatted("%.1f h", seconds / 3600.0);
}

std::string readable_number(double value, int digits) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
    return buffer.data();
}

std::string exact(double value) { return formatted("%.17g", value); }

}  // namespace elastolab
