#pragma once

#include <filesystem>
#include <string>

#include "fuzz/child.hpp"

namespace elastolab::fuzz {

/// What is wrong with the way in which a run ended; empty when nothing is. Right is: exit code 0, 1 or 2, no signal,
/// no more time or memory than `most`; printed text without control characters; on failure nothing on standard output
/// and one line on standard error that begins with the program's name.
std::string complaint_about(const Run& run, const Command& most);

/// Whether a text is UTF-8 without control characters, line ends aside.
bool is_clean(const std::string& text);

/// The first number that is none (not-a-number, infinite) in a file that solve wrote; empty when there is none. Knows
/// CSV (but for the first column, which may hold names), OBJ, JSON (where such numbers are null), binary STL and PLY in
/// double precision, by the extension. A file that is missing or shorter than it says is a complaint, too.
std::string not_finite_in(const std::filesystem::path& file);

}  // namespace elastolab::fuzz
