#pragma once

#include <string>
#include <vector>

#include "deform/finding.hpp"

namespace elastolab {

/// A finding as one sentence or more for the user: what it is about, what was found, and a way forward.
std::string words(const Finding& finding);
std::vector<std::string> words(const Findings& findings);

}  // namespace elastolab
