#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "mesh/checks/check.hpp"
#include "mesh/surface_mesh.hpp"

namespace elastolab::python {

/// A checked and repaired surface, with its report.
struct Surface {
    std::string name;
    std::shared_ptr<const SurfaceMesh> mesh;
    MeshReport report;
    std::string warning;  ///< of the reader of a file; empty: none
};

/// Surface, MeshReport, Defect, Proxy.
void bind_surfaces(pybind11::module_& module);

}  // namespace elastolab::python
