#pragma once

#include <string>

#include "deform/finding.hpp"

namespace elastolab {

/// Whether what only some methods can choose was chosen by a person.
struct ChoicesForSome {
    bool tractions = false, elements = false, rims = false;
};

/// Those that mean nothing to the method, each with one to which they do. prefix: of the names of options, "--".
Findings choices_left_aside(const ChoicesForSome& given, MethodKind kind, const std::string& prefix);

}  // namespace elastolab
