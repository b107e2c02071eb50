#pragma once

#include <string>

#include "fuzz/random.hpp"

namespace elastolab::fuzz {

/// One change of a file as bytes: flipped, replaced, inserted, removed, repeated or moved bytes, an early end, a
/// number of 2, 4 or 8 bytes (either byte order) replaced by one that is near a limit, or a part of `other`.
std::string mutate_bytes(std::string bytes, const std::string& other, Random& random);

}  // namespace elastolab::fuzz
