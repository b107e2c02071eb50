#pragma once

#include <pybind11/pybind11.h>

namespace elastolab::python {

/// Scene files as text, solve, Solution, Reaction.
void bind_scenes(pybind11::module_& module);

}  // namespace elastolab::python
