#pragma once

#include <pybind11/pybind11.h>

namespace elastolab::python {

/// Material, Method, Model, precompute.
void bind_models(pybind11::module_& module);

}  // namespace elastolab::python
