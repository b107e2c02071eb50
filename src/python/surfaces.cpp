#include "python/surfaces.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/input/export.hpp"
#include "mesh/input/import.hpp"
#include "mesh/primitives.hpp"
#include "python/arrays.hpp"
#include "python/watch.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/proxy/carried_constraints.hpp"
#include "scene/proxy/proxy.hpp"
#include "scene/selectors.hpp"

namespace elastolab::python {

namespace {

namespace fs = std::filesystem;
using SurfacePointer = std::shared_ptr<Surface>;

SurfacePointer checked(std::string name, ImportedSurface imported, Control& control) {
    CheckedMesh checked = check_and_repair(std::move(imported.mesh), control);
    return std::make_shared<Surface>(Surface{.name = std::move(name),
                                             .mesh = std::make_shared<const SurfaceMesh>(std::move(checked.mesh)),
                                             .report = std::move(checked.report),
                                             .warning = std::move(imported.warning)});
}

SurfacePointer from_arrays(const py::object& vertices, const py::object& corners, const std::string& name,
                           const py::object& progress) {
    SurfaceMesh mesh{points(vertices, "vertices"), {}};
    mesh.triangles = triangles(corners, "triangles", mesh.vertices.cols());
    return watched(progress, [&](Control& control) {
        control.begin_stage("check");
        return checked(name, {std::move(mesh), {}}, control);
    });
}

SurfacePointer from_file(const fs::path& file, const py::object& progress) {
    return watched(progress, [&](Control& control) {
        control.begin_stage("load");
        return checked(file.filename().string(), import_surface(file, control), control);
    });
}

SurfacePointer from_primitive(const std::string& name, int resolution, const std::vector<double>& size) {
    return watched(py::none(), [&](Control& control) {
        return checked(name, {make_primitive(name, resolution, size), {}}, control);
    });
}

const char* word(Defect::Kind kind) {
    using Kind = Defect::Kind;
    // clang-format off
    switch (kind) {
        case Kind::no_triangles: return "no-triangles";
        case Kind::non_finite: return "non-finite";
        case Kind::open_edges: return "open-edges";
        case Kind::non_manifold_edges: return "non-manifold-edges";
        case Kind::non_manifold_vertices: return "non-manifold-vertices";
        case Kind::inconsistent_orientation: return "inconsistent-orientation";
        case Kind::inside_out: return "inside-out";
        case Kind::degenerate_triangles: return "degenerate-triangles";
        case Kind::sliver_triangles: return "sliver-triangles";
        case Kind::duplicate_triangles: return "duplicate-triangles";
        case Kind::unreferenced_vertices: return "unreferenced-vertices";
        case Kind::self_intersections: return "self-intersections";
        case Kind::zero_volume: return "zero-volume";
        case Kind::coarse_coordinates: return "coarse-coordinates";
        case Kind::too_small: return "too-small";
    }
    // clang-format on
    return "";
}

py::array places_of(const Defect& defect) {
    Eigen::Matrix3Xd columns(3, std::ssize(defect.places));
    for (Eigen::Index i = 0; i < columns.cols(); ++i) columns.col(i) = defect.places[static_cast<std::size_t>(i)];
    return as_rows(columns);
}

/// Arrays that belong to the surface: read-only views.
py::array vertices_of(const py::object& self) {
    const auto& mesh = *self.cast<const Surface&>().mesh;
    py::array_t<double> view({py::ssize_t{mesh.n_vertices()}, py::ssize_t{3}}, mesh.vertices.data(), self);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
}

py::array triangles_of(const py::object& self) {
    const auto& mesh = *self.cast<const Surface&>().mesh;
    py::array_t<int> view({py::ssize_t{mesh.n_triangles()}, py::ssize_t{3}}, mesh.triangles.data(), self);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return view;
}

/// By the reader of scene files, so that selectors are those of scenes.
py::array select(const Surface& surface, const py::object& selector) {
    const auto dumps = py::module_::import("json").attr("dumps");
    const auto plain = py::module_::import("elastolab._scene").attr("_plain");
    std::string text;
    try {
        text = dumps(selector, py::arg("default") = plain).cast<std::string>();
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw;
        throw py::type_error(
            "selector: has a value that is no number, list or dict of such. Give one as in scene files.");
    }
    const std::string scene =
        R"({"elastolab":1,"mesh":{"primitive":"cube","resolution":1},"material":{"young_modulus":1,"poisson_ratio":0},)"
        R"("method":"fem","handles":[],"fixed":[{"select":)" +
        text + "}]}";
    const Document document = parse_scene(scene, surface.name);
    return as_integers(select_vertices(*surface.mesh, document.fixed.at(0).select, surface.name + ": selector"));
}

using ProxyPointer = std::shared_ptr<const Proxy>;

ProxyPointer proxy_of(const Surface& surface, int n_vertices, bool fill, const std::string& taken_for,
                      const py::object& progress) {
    const std::optional<OpenSurface> taken = parse_open_surface(taken_for);
    if (!taken)
        throw py::value_error("taken_for '" + one_line(taken_for) + "' is unknown. Use '" +
                              std::string(name(OpenSurface::automatic)) + "', 'solid' or 'sheet'.");
    if (n_vertices < kFewestProxyVertices || n_vertices > kMostProxyVertices)
        throw py::value_error("vertices: must be from " + std::to_string(kFewestProxyVertices) + " to " +
                              std::to_string(kMostProxyVertices) + ", is " + std::to_string(n_vertices) + ".");
    const ProxyChoice choice{
        .use = fill ? ProxyUse::fill : ProxyUse::always, .n_vertices = n_vertices, .taken_for = *taken};
    return watched(progress, [&](Control& control) {
        control.begin_stage("proxy");
        return make_proxy(surface.name, surface.mesh, surface.report, choice, control);
    });
}

SurfacePointer surface_of(const ProxyPointer& proxy) {
    return watched(py::none(), [&](Control& control) {
        return checked("proxy", {SurfaceMesh(*proxy->surface), {}}, control);
    });
}

py::array carried(const Proxy& proxy, const py::object& values) {
    const auto array = real_array(values, "values");
    const py::ssize_t n = proxy.surface->n_vertices();
    if (array.ndim() < 1 || array.ndim() > 2 || array.shape(0) != n)
        throw py::value_error("values: must have a row for each of the " + std::to_string(n) +
                              " vertices of the proxy.");
    const py::ssize_t k = array.ndim() == 2 ? array.shape(1) : 1;
    const Eigen::Map<const Eigen::MatrixXd> columns(array.data(), k, n);
    Eigen::MatrixXd shown(k, proxy.shown->n_vertices());
    for (Eigen::Index i = 0; i < k; ++i) shown.row(i) = carried_values(proxy, columns.row(i).transpose()).transpose();
    if (array.ndim() == 2) return as_rows(shown);
    return as_numbers(Eigen::VectorXd(shown.row(0)));
}

void bind_defect(py::module_& module) {
    py::class_<Defect>(module, "Defect", "One kind of defect of a surface: how many, and where the first few are.")
        .def_property_readonly(
            "kind", [](const Defect& d) { return word(d.kind); }, "A word, as 'open-edges'.")
        .def_readonly("count", &Defect::count)
        .def_property_readonly("places", &places_of, "Of the first few: (k, 3), in the unit of length.")
        .def_readonly("repaired", &Defect::repaired)
        .def_readonly("fatal", &Defect::fatal, "No method can use the surface.")
        .def_readonly("fatal_for_fem", &Defect::fatal_for_fem)
        .def_readonly("text", &Defect::text, "The finding and a way forward.")
        .def("__repr__", [](const Defect& d) { return "<elastolab.Defect: " + d.text + ">"; });
}

void bind_report(py::module_& module) {
    py::class_<MeshReport>(module, "MeshReport", "What was found, and repaired, when a surface was checked.")
        .def_readonly("defects", &MeshReport::defects)
        .def_readonly("n_components", &MeshReport::n_components, "Connected surfaces.")
        .def_readonly("n_solids", &MeshReport::n_solids)
        .def_readonly("closed", &MeshReport::closed)
        .def_readonly("volume", &MeshReport::volume)
        .def_readonly("area", &MeshReport::area)
        .def_property_readonly("min_corner",
                               [](const MeshReport& r) { return as_numbers(Eigen::VectorXd(r.min_corner)); })
        .def_property_readonly("max_corner",
                               [](const MeshReport& r) { return as_numbers(Eigen::VectorXd(r.max_corner)); })
        .def_readonly("shortest_edge", &MeshReport::shortest_edge)
        .def_readonly("mean_edge", &MeshReport::mean_edge)
        .def_readonly("longest_edge", &MeshReport::longest_edge)
        .def_property_readonly("usable", &MeshReport::usable, "No defect is left that every method refuses.")
        .def_property_readonly("usable_for_fem", &MeshReport::usable_for_fem);
}

void bind_surface(py::module_& module) {
    py::class_<Surface, SurfacePointer>(module, "Surface",
                                        R"(A triangulated surface, checked and repaired when it is made.

vertices   (n, 3) positions in any unit of length
triangles  (m, 3) vertex numbers from 0, counter-clockwise seen from outside

Triangles that face the wrong way are turned round; vertex numbers never change. What was found is in `report`: a
surface with fatal defects can be looked at, but not simulated (make a Proxy of it).)")
        .def(py::init(&from_arrays), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
             py::arg("name") = "surface", py::arg("progress") = py::none())
        .def_static("load", &from_file, py::arg("file"), py::kw_only(), py::arg("progress") = py::none(),
                    "Reads a mesh file: OBJ, PLY, OFF and STL with all digits, others through assimp. Equal vertices "
                    "are merged.")
        .def_static("primitive", &from_primitive, py::arg("name"), py::arg("resolution"),
                    py::arg("size") = std::vector<double>{},
                    "'cube', 'box', 'sphere', 'cylinder', 'torus', 'beam' or 'hollow-sphere', as in scene files.")
        .def_readonly("name", &Surface::name)
        .def_property_readonly("vertices", &vertices_of, "(n, 3), read-only.")
        .def_property_readonly("triangles", &triangles_of, "(m, 3), read-only.")
        .def_property_readonly("n_vertices", [](const Surface& s) { return s.mesh->n_vertices(); })
        .def_property_readonly("n_triangles", [](const Surface& s) { return s.mesh->n_triangles(); })
        .def_readonly("report", &Surface::report)
        .def_readonly("warning", &Surface::warning, "Of the reader of a file: coordinates that were rounded; or empty.")
        .def("select", &select, py::arg("selector"),
             "Vertices of a selector as in scene files, such as {'box': {'min': [0, 0, 0], 'max': [0, 1, 1]}}, or of a "
             "list of selectors: their union.")
        .def(
            "save", [](const Surface& s, const fs::path& file) { save_surface(file, *s.mesh); }, py::arg("file"),
            "Writes OBJ, PLY or STL, by the ending of the name.")
        .def("__repr__", [](const Surface& s) {
            return "<elastolab.Surface '" + s.name + "': " + std::to_string(s.mesh->n_vertices()) + " vertices, " +
                   std::to_string(s.mesh->n_triangles()) + " triangles>";
        });
}

void bind_proxy(py::module_& module) {
    py::class_<Proxy, std::shared_ptr<Proxy>>(module, "Proxy",
                                              R"(A closed surface that is simulated in place of any triangles.

vertices  about how many it is to have
fill      close the holes of the surface itself, instead of wrapping it
taken_for an open surface is taken for a 'solid' with holes, or for a 'sheet'; 'auto' decides by the holes)")
        .def(py::init([](const Surface& surface, int n_vertices, bool fill, const std::string& taken_for,
                         const py::object& progress) {
                 return std::const_pointer_cast<Proxy>(proxy_of(surface, n_vertices, fill, taken_for, progress));
             }),
             py::arg("surface"), py::arg("vertices") = ProxyChoice{}.n_vertices, py::kw_only(), py::arg("fill") = false,
             py::arg("taken_for") = name(OpenSurface::automatic), py::arg("progress") = py::none())
        .def_property_readonly(
            "surface", [](const std::shared_ptr<Proxy>& proxy) { return surface_of(proxy); },
            "The surface to simulate.")
        .def_readonly("edge", &Proxy::edge, "Its mean edge, in the unit of length.")
        .def_property_readonly(
            "distance", [](const Proxy& p) { return as_numbers(Eigen::VectorXd(p.places.distance)); },
            "Of each vertex of the first surface from the proxy: (n,).")
        .def("carry", &carried, py::arg("values"),
             "Values at the vertices of the proxy, (n_proxy,) or (n_proxy, k), at those of the first surface.");
}

}  // namespace

void bind_surfaces(py::module_& module) {
    bind_defect(module);
    bind_report(module);
    bind_surface(module);
    bind_proxy(module);
}

}  // namespace elastolab::python
