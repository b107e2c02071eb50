#include "python/loads.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "mesh/measures.hpp"
#include "python/arrays.hpp"
#include "python/surfaces.hpp"

namespace elastolab::python {

namespace {

Eigen::Vector3d vector_of(const py::object& object, const std::string& name) { return numbers(object, name, 3); }

/// Loaded triangles of a surface: at least one, of which none is named twice and whose area is not zero.
std::vector<int> loaded(const py::object& object, const Surface& surface) {
    std::vector<int> chosen = vertex_list(object, "triangles", surface.mesh->n_triangles(), "triangle");
    if (chosen.empty()) throw py::value_error("triangles: none is given. Give the triangles that are loaded.");
    std::vector<int> sorted = chosen;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
        throw py::value_error("triangles: one is given twice. Give each number once.");
    double area = 0.0;
    for (const int t : chosen) area += area_vector(triangle_points(*surface.mesh, t)).norm();
    if (!(area > 0.0)) throw py::value_error("triangles: they have no area. Choose others.");
    return chosen;
}

/// A load, and the surface whose triangles it names; null where it names none.
struct SurfaceLoad {
    UnitLoad load;
    std::shared_ptr<const SurfaceMesh> surface;

    bool is_for(const std::shared_ptr<const SurfaceMesh>& body) const {
        return !surface || surface == body ||
               (surface->n_vertices() == body->n_vertices() && surface->n_triangles() == body->n_triangles() &&
                surface->vertices == body->vertices && surface->triangles == body->triangles);
    }
};

SurfaceLoad body_force(const py::object& force) { return {{.body_force = vector_of(force, "force")}, nullptr}; }
SurfaceLoad total_force(const Surface& surface, const py::object& triangles, const py::object& force) {
    return {unit_force(*surface.mesh, loaded(triangles, surface), vector_of(force, "force")), surface.mesh};
}
SurfaceLoad traction(const Surface& surface, const py::object& triangles, const py::object& traction) {
    return {unit_traction(loaded(triangles, surface), vector_of(traction, "traction")), surface.mesh};
}
SurfaceLoad pressure(const Surface& surface, const py::object& triangles, double value) {
    if (!std::isfinite(value)) throw py::value_error("pressure: is not finite. Give a finite number.");
    UnitLoad load = unit_pressure(*surface.mesh, loaded(triangles, surface));
    load.tractions *= value;
    return {std::move(load), surface.mesh};
}

}  // namespace

std::vector<UnitLoad> loads_of(const py::object& loads, const Model& model) {
    std::vector<UnitLoad> result;
    if (loads.is_none()) return result;
    if (!py::isinstance<py::sequence>(loads)) throw py::type_error("loads: is no list. Give a list of Loads.");
    for (const py::handle& item : loads.cast<py::sequence>()) {
        if (!py::isinstance<SurfaceLoad>(item))
            throw py::type_error("loads: has an item that is no Load. Make it by Load.");
        const auto& given = item.cast<const SurfaceLoad&>();
        if (!given.is_for(model.body().surface))
            throw py::value_error("loads: load " + std::to_string(result.size()) +
                                  " is made for another surface. Make it for that of this body.");
        result.push_back(given.load);
    }
    return result;
}

void bind_loads(py::module_& module) {
    py::class_<SurfaceLoad>(
        module, "Load",
        R"(What acts on a body besides the handles; made by the functions below, taken by Model.constrain.

Of linear methods loads keep their size and direction while the body moves. Under large deformations a pressure
follows the surface; forces, and forces per area at rest, keep theirs.)")
        .def_static("body_force", &body_force, py::arg("force"),
                    "Everywhere inside: (3,) [force / length^3], such as density times gravity.")
        .def_static("force", &total_force, py::arg("surface"), py::arg("triangles"), py::arg("force"),
                    "A total force (3,), spread evenly over these triangles.")
        .def_static("traction", &traction, py::arg("surface"), py::arg("triangles"), py::arg("traction"),
                    "A force per area (3,) [force / length^2] on these triangles.")
        .def_static("pressure", &pressure, py::arg("surface"), py::arg("triangles"), py::arg("pressure"),
                    "[force / length^2]; presses into the body where it is positive.")
        .def("__repr__", [](const SurfaceLoad& its) {
            const std::size_t n = its.load.triangles.size();
            return n == 0 ? std::string("<elastolab.Load: a body force>")
                          : "<elastolab.Load on " + std::to_string(n) + " triangles>";
        });
}

}  // namespace elastolab::python
