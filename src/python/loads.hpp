#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "deform/model.hpp"
#include "deform/unit_load.hpp"

namespace elastolab::python {

namespace py = pybind11;

/// None or a sequence of Loads, for this body. Throws TypeError for anything else, ValueError for a load that is made
/// for another surface.
std::vector<UnitLoad> loads_of(const py::object& loads, const Model& model);

void bind_loads(py::module_& module);

}  // namespace elastolab::python
