#pragma once

#include <string>

#include "fuzz/random.hpp"

namespace elastolab::fuzz {

/// One change of a JSON text by its structure: a value replaced by an odd one or by another value of the file, a key
/// or an element removed, renamed or repeated, a value wrapped in many arrays. What JSON cannot hold (nan, 1e400) is
/// put in as text. A text that is no JSON comes back as it is.
std::string mutate_json(const std::string& text, Random& random);

/// The same in one line of a file that holds a JSON value in each.
std::string mutate_json_lines(const std::string& text, Random& random);

}  // namespace elastolab::fuzz
