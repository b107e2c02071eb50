#include "fuzz/oracle.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "support/temporary_folder.hpp"

namespace elastolab::fuzz {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr double kMostMemory = 2e9;  ///< bytes, for small bodies
constexpr std::size_t kLongestLine = 1000;

std::string complaint_about_end(const Run& run, const Command& most) {
    if (run.stuck) return "does not end and does nothing";
    // The kernel may end it a moment before the time that it then reports.
    if (run.signal == SIGXCPU || run.cpu_seconds > most.cpu_seconds - 0.1)
        return "takes more than " + std::to_string(std::lround(most.cpu_seconds)) + " s";
    if (run.signal != 0) return "ended by signal " + std::to_string(run.signal);
    if (run.exit_code > 2) return "exit code " + std::to_string(run.exit_code);
    if (run.peak_memory > kMostMemory) return "takes " + std::to_string(run.peak_memory / 1e9) + " GB";
    return "";
}

bool is_one_line(const std::string& text) {
    return !text.empty() && text.size() <= kLongestLine && text.find('\n') == text.size() - 1;
}

std::string complaint_about_text(const Run& run) {
    if (!is_clean(run.out)) return "control characters on standard output";
    if (!is_clean(run.err)) return "control characters on standard error";
    if (run.exit_code == 0) return "";
    if (!run.out.empty()) return "output although it failed";
    if (!is_one_line(run.err)) return "not one line on standard error";
    return run.err.starts_with("elastolab: ") ? "" : "an error line without the program's name";
}

/// A character of a UTF-8 text.
struct Character {
    std::uint32_t code = 0;
    std::size_t size = 0;  ///< bytes; 0: not valid
};

Character character_at(const std::string& text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(at);
    if (first < 0x80) return {first, 1};
    const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || at + size > text.size()) return {};
    Character result{first & (0xffU >> (size + 1)), size};
    for (std::size_t i = at + 1; i < at + size; ++i) {
        if ((byte(i) & 0xc0U) != 0x80U) return {};
        result.code = result.code << 6U | (byte(i) & 0x3fU);
    }
    return result;
}

/// The first word of a text that stands for a number that is none.
std::string odd_word(const std::string& text) {
    std::string word;
    for (const char c : text + " ") {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            continue;
        }
        if (word == "nan" || word == "inf" || word == "infinity") return word;
        word.clear();
    }
    return "";
}

std::string odd_word_in_csv(const std::string& text) {
    std::istringstream stream(text);
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line)) {
        // A quoted name may have line breaks (RFC 4180).
        for (std::string rest; std::count(line.begin(), line.end(), '"') % 2 != 0 && std::getline(stream, rest);)
            line += '\n' + rest;
        const bool quoted = line.starts_with('"');
        const std::size_t first = line.find(',', quoted ? line.rfind('"') : 0);
        if (first == std::string::npos) return "a row without numbers";
        if (const std::string word = odd_word(line.substr(first)); !word.empty()) return word;
    }
    return "";
}

std::string null_in(const Json& json, const std::string& path) {
    // What not all methods and bodies have.
    static const std::set<std::string> may_lack = {"/tractions", "/proxy",           "/elements",
                                                   "/rims",      "/compliance",      "/iterations",
                                                   "/energy",    "/largest_stretch", "/linear_theory_error"};
    const bool may_be_null = may_lack.contains(path) || path.starts_with("/error_estimate/");
    if (json.is_null()) return may_be_null ? "" : "null at " + path;
    if (!json.is_structured()) return "";
    for (const auto& [key, value] : json.items())
        if (std::string found = null_in(value, path + "/" + key); !found.empty()) return found;
    return "";
}

template <class Number>
bool are_finite(const std::string& bytes, std::size_t first, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
        Number number{};
        std::memcpy(&number, bytes.data() + first + i * sizeof(number), sizeof(number));
        if (!std::isfinite(number)) return false;
    }
    return true;
}

std::string odd_number_in_stl(const std::string& bytes) {
    constexpr std::size_t kHeader = 84, kTriangle = 50;
    for (std::size_t at = kHeader; at < bytes.size(); at += kTriangle) {
        if (at + kTriangle > bytes.size()) return "an end within a triangle";
        if (!are_finite<float>(bytes, at, 12)) return "a triangle that is not finite";
    }
    return bytes.size() <= kHeader ? "no triangle" : "";
}

std::string odd_number_in_ply(const std::string& bytes) {
    const std::string element = "element vertex ", end = "end_header\n";
    const std::size_t count = bytes.find(element), body = bytes.find(end);
    if (count == std::string::npos || body == std::string::npos) return "no header";
    const std::size_t n = 3 * std::stoul(bytes.substr(count + element.size()));
    if (bytes.size() < body + end.size() + n * sizeof(double)) return "too few bytes";
    return are_finite<double>(bytes, body + end.size(), n) ? "" : "a vertex that is not finite";
}

std::string odd_part(const std::string& extension, const std::string& text) {
    if (text.empty()) return "no content";
    if (extension == ".csv") return odd_word_in_csv(text);
    if (extension == ".stl") return odd_number_in_stl(text);
    if (extension == ".ply") return odd_number_in_ply(text);
    if (extension != ".json") return odd_word(text);
    const Json json = Json::parse(text, nullptr, false);
    return json.is_discarded() ? "text that is not JSON" : null_in(json, "");
}

}  // namespace

std::string complaint_about(const Run& run, const Command& most) {
    const std::string end = complaint_about_end(run, most);
    return end.empty() ? complaint_about_text(run) : end;
}

bool is_clean(const std::string& text) {
    for (std::size_t i = 0; i < text.size();) {
        const Character c = character_at(text, i);
        if (c.size == 0 || (c.code < 0x20 && c.code != '\n') || (c.code >= 0x7f && c.code < 0xa0)) return false;
        i += c.size;
    }
    return true;
}

std::string not_finite_in(const fs::path& file) {
    if (!fs::exists(file)) return file.filename().string() + " is missing";
    const std::string found = odd_part(file.extension().string(), test::read_text(file));
    return found.empty() ? "" : file.filename().string() + " has " + found;
}

}  // namespace elastolab::fuzz
