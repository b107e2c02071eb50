#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "deform/finding.hpp"

namespace elastolab {

/// A finding as one sentence or more for the user: what it is about, what was found, and a way forward.
std::string words(const Finding& finding);
std::vector<std::string> words(const Findings& findings);

/// In sentences on coarse meshes, before the number; and what may stand there instead where room is short.
inline constexpr std::string_view kAreOffBy = " are off by about ", kOffBy = " off by ";

}  // namespace elastolab
