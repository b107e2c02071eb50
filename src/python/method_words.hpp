#pragma once

#include <string>

#include "deform/method.hpp"
#include "elasticity/material.hpp"

namespace elastolab::python {

/// A method by the words of the command line; an empty one: the default. Throws ValueError for an unknown word
/// and for a number of rows along rims that is not offered.
Method method_of(const std::string& method, const std::string& mode, const std::string& tractions,
                 const std::string& update, const std::string& elements, int rims);

/// Throws ValueError, as scene files do, for a material that is none.
void require_material(const Material& material);

}  // namespace elastolab::python
