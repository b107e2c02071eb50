#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace elastolab {

/// printf into a string of any length; the compiler checks the arguments against the format.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// `text` on one line, for messages that quote a user's data: control characters become spaces, broken UTF-8 a '?'.
std::string one_line(std::string_view text);

/// At most `longest` bytes of `text`, whole characters of UTF-8, and "..." where some are left out: for messages that
/// quote a user's data.
std::string shortened(std::string_view text, std::size_t longest);

/// ASCII letters in lower case, the rest as it is.
std::string lower_case(std::string_view text);

/// A number of bytes for people: "812 bytes", "3.4 MB", "14.1 GB" (powers of 1000).
std::string readable_bytes(double bytes);

/// A duration for people: "85 us", "12.3 ms", "4.52 s", "7.4 min".
std::string readable_seconds(double seconds);

/// A number for people, few digits: "0.13", "1.2e+07".
std::string readable_number(double value, int digits = 2);

/// Whether people read a number better as a whole one, without decimals or an exponent: its size is 999.5 or more, and
/// less than `limit`.
bool reads_as_whole(double value, double limit = 999999.5);

/// So written where that reads better, else with few digits: "12346", "0.1235", "1.235e+06".
std::string plain_number(double value, int digits);

/// A place for people: "(0.5, 1, -2.25)".
std::string readable_point(const Eigen::Vector3d& x);

/// All 17 significant digits, so that the number is read back exactly.
std::string exact(double value);

/// The characters of a text in UTF-8; U+FFFD for bytes that are not valid.
std::vector<char32_t> characters_of(std::string_view text);

}  // namespace elastolab
