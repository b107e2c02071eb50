#pragma once

#include <string>

#include "fuzz/random.hpp"

namespace elastolab::fuzz {

/// A number as text, valid or not: limits of integers and of both precisions, words for infinity, other notations.
std::string odd_number(Random& random);

/// One change of a text file by its words and lines: numbers replaced by odd ones or changed a little, words or lines
/// removed, repeated, exchanged or replaced by other words of the file.
std::string mutate_tokens(const std::string& text, Random& random);

}  // namespace elastolab::fuzz
