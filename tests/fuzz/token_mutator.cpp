#include "fuzz/token_mutator.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <utility>
#include <vector>

namespace elastolab::fuzz {

namespace {

constexpr std::array kOddNumbers = {"0",
                                    "-0",
                                    "1",
                                    "-1",
                                    "2",
                                    "3",
                                    "4",
                                    "255",
                                    "256",
                                    "65535",
                                    "65536",
                                    "1e5",
                                    "1000000",
                                    "2147483647",
                                    "2147483648",
                                    "-2147483648",
                                    "4294967295",
                                    "4294967296",
                                    "9223372036854775807",
                                    "-9223372036854775808",
                                    "18446744073709551615",
                                    "99999999999999999999",
                                    "0.5",
                                    "0.1",
                                    "-0.3",
                                    "1e-3",
                                    "1e-7",
                                    "1e-12",
                                    "1e-16",
                                    "1e-30",
                                    "1e-45",
                                    "1e-160",
                                    "1e-308",
                                    "5e-324",
                                    "1e-400",
                                    "1e7",
                                    "1e16",
                                    "1e30",
                                    "3.5e38",
                                    "1e154",
                                    "1e160",
                                    "1e300",
                                    "1e308",
                                    "-1e308",
                                    "1e309",
                                    "1e400",
                                    "nan",
                                    "-nan",
                                    "inf",
                                    "-inf",
                                    "infinity",
                                    "NaN(1)",
                                    "0x10",
                                    "0x1p3",
                                    "1e",
                                    "1e+",
                                    "1.2.3",
                                    "1,5",
                                    "--1",
                                    "+1",
                                    "1.",
                                    ".5",
                                    ".",
                                    "-",
                                    "1/0",
                                    "1e99999999",
                                    "00000001",
                                    "1f"};

/// Words and what is between them, in turns: separators and line ends stay as they are.
std::vector<std::string> split(const std::string& text) {
    const auto is_word = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+' || c == '_';
    };
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && is_word(text[end]) == is_word(text[i])) ++end;
        parts.push_back(text.substr(i, end - i));
        i = end;
    }
    return parts;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = std::min(text.find('\n', i), text.size() - 1) + 1;
        lines.push_back(text.substr(i, end - i));
        i = end;
    }
    return lines;
}

std::string join(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += part;
    return text;
}

bool is_number(const std::string& word) {
    char* end = nullptr;
    std::strtod(word.c_str(), &end);
    return !word.empty() && *end == '\0';
}

/// A number near the old one.
std::string nudged(const std::string& word, Random& random) {
    const double value = std::strtod(word.c_str(), nullptr);
    const std::array<double, 6> changed = {value + 1.0,  value - 1.0,          -value,
                                           value * 1e-6, value + 1e-9 * value, value * (0.5 + random.unit())};
    const double chosen = random.pick(changed);
    if (chosen == static_cast<double>(static_cast<long>(chosen))) return std::to_string(static_cast<long>(chosen));
    return std::to_string(chosen);
}

std::string changed_word(const std::string& word, const std::vector<std::string>& all, Random& random) {
    if (is_number(word)) return random.once_in(3) ? nudged(word, random) : odd_number(random);
    switch (random.below(4)) {
        case 0:
            return "";
        case 1:
            return odd_number(random);
        case 2:
            return word + word;
        default:
            return random.pick(all);
    }
}

void change_words(std::vector<std::string>& parts, Random& random) {
    // Numbers are most of a mesh: other words get their turn by a second draw.
    std::size_t place = random.below(parts.size());
    if (is_number(parts[place]) && random.once_in(2)) place = random.below(parts.size());
    const std::string before = parts[place];
    const std::string after = changed_word(before, parts, random);
    if (!random.once_in(16)) {
        parts[place] = after;
        return;
    }
    for (std::string& part : parts)  // the same word everywhere
        if (part == before) part = after;
}

void change_lines(std::vector<std::string>& lines, Random& random) {
    const std::size_t place = random.below(lines.size());
    const auto at = lines.begin() + static_cast<std::ptrdiff_t>(place);
    switch (random.below(4)) {
        case 0:
            lines.erase(at);
            break;
        case 1: {
            const std::string line = *at;
            lines.insert(at, random.once_in(8) ? 1 + random.below(1000) : 1, line);
            break;
        }
        case 2:
            std::swap(*at, lines[random.below(lines.size())]);
            break;
        default:
            at->pop_back();  // mostly: the line end
    }
}

}  // namespace

std::string odd_number(Random& random) { return random.pick(kOddNumbers); }

std::string mutate_tokens(const std::string& text, Random& random) {
    if (text.empty()) return text;
    std::vector<std::string> parts = random.once_in(4) ? lines_of(text) : split(text);
    if (random.once_in(4)) {
        parts = lines_of(text);
        change_lines(parts, random);
    } else {
        parts = split(text);
        change_words(parts, random);
    }
    return join(parts);
}

}  // namespace elastolab::fuzz
