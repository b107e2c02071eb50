#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "deform/deformer.hpp"

namespace elastolab::python {

/// Model.constrain.
std::shared_ptr<Deformer> constrained(const std::shared_ptr<Model>& model, const pybind11::object& fixed,
                                      const pybind11::object& handles, const pybind11::object& loads,
                                      const pybind11::object& progress);

/// Deformer, DragResponse, Reactions, ErrorEstimate.
void bind_deformers(pybind11::module_& module);

}  // namespace elastolab::python
