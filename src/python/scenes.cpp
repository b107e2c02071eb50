#include "python/scenes.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/input/export.hpp"
#include "methods/choices.hpp"
#include "python/arrays.hpp"
#include "python/method_words.hpp"
#include "python/surfaces.hpp"
#include "python/watch.hpp"
#include "scene/field_export.hpp"
#include "scene/figure/figure.hpp"
#include "scene/figure/gltf.hpp"
#include "scene/file/scene_file.hpp"
#include "scene/solve.hpp"

namespace elastolab::python {

namespace {

namespace fs = std::filesystem;
using SolutionPointer = std::shared_ptr<Solution>;

/// The words of a scene where nothing else is asked for.
SolveRequest request_of(const std::string& text, const fs::path& file, const std::string& method,
                        const std::string& mode, const std::string& tractions, const std::string& update,
                        const std::string& elements, int rims, bool checks) {
    SolveRequest request{.scene_file = file, .document = parse_scene(text, file.string()), .method = {}};
    request.method = method_of(method.empty() ? std::string(name(request.document.method)) : method, mode, tractions,
                               update, elements, rims);
    if (const std::string why = refusal(request.method, request.document.material.poisson_ratio); !why.empty())
        throw py::value_error(why);
    request.solve_once = update.empty() && request.method.mode == Mode::on_demand;
    request.with_checks = checks;
    return request;
}

SolutionPointer solve_scene(const std::string& text, const fs::path& file, const std::string& method,
                            const std::string& mode, const std::string& tractions, const std::string& update,
                            const std::string& elements, int rims, bool checks, const py::object& progress) {
    const SolveRequest request = request_of(text, file, method, mode, tractions, update, elements, rims, checks);
    SolutionPointer solution =
        watched(progress, [&](Control& control) { return std::make_shared<Solution>(solve(request, control)); });
    for (Finding& left_aside :
         choices_left_aside({!tractions.empty(), !elements.empty(), rims > 0}, request.method.kind, ""))
        solution->findings.push_back(std::move(left_aside));
    return solution;
}

std::string normal_text(const std::string& text, const std::string& file) {
    return print_scene(parse_scene(text, file));
}

void save_text(const std::string& text, const std::string& name, const fs::path& file) {
    save_scene(file, parse_scene(text, name));
}

py::dict fields_of(const Solution& solution) {
    std::vector<MeshField> fields;
    {
        const WithoutLock others;
        fields = surface_fields(solved_body(solution));
    }
    py::dict result;
    for (MeshField& field : fields)
        result[py::str(field.name)] =
            field.values.rows() == 1 ? as_numbers(Eigen::VectorXd(field.values.row(0))) : as_rows(field.values);
    return result;
}

void save(const Solution& solution, const fs::path& file, bool deformed, const py::object& progress) {
    run_watched(progress, [&](Control& control) {
        if (is_figure_file(file) || is_glb_file(file))
            return save_figure(
                file, make_figure(solved_body(solution), solution.groups, solution.vertical, use_of(file), control));
        if (is_field_file(file))
            return save_field_file(file, solved_body(solution), control,
                                   deformed ? VtkPoints::moved : VtkPoints::at_rest);
        const std::string extension = lower_case(file.extension().string());
        if (extension != ".obj" && extension != ".ply" && extension != ".stl")
            throw Error(one_line(file.string()) +
                        ": a solution is written as .obj, .ply, .stl, .vtp, .vtu, .csv, .html or .glb. Choose one of "
                        "these extensions.");
        SurfaceMesh mesh = *solution.surface;
        mesh.vertices += solution.displacement;
        save_surface(file, mesh);
    });
}

py::dict stage_seconds(const Solution& solution) {
    py::dict seconds;
    for (const auto& [stage, time] : solution.stages) seconds[py::str(stage)] = time;
    return seconds;
}

void bind_reaction(py::module_& module) {
    py::class_<GroupReaction>(module, "Reaction", "What a handle, or the fixed part, exerts on the body in all.")
        .def_readonly("name", &GroupReaction::name)
        .def_property_readonly(
            "force", [](const GroupReaction& r) { return as_numbers(Eigen::VectorXd(r.force)); }, "(3,) [force].")
        .def_property_readonly(
            "moment", [](const GroupReaction& r) { return as_numbers(Eigen::VectorXd(r.moment)); },
            "About the origin: (3,) [force * length].");
}

template <class Value>
std::optional<Value> of_equilibrium(const Solution& solution, Value EquilibriumFacts::*fact) {
    return solution.facts ? std::optional<Value>((*solution.facts).*fact) : std::nullopt;
}

void bind_solution(py::module_& module) {
    py::class_<Solution, SolutionPointer>(module, "Solution", "The answer to a scene.")
        .def_property_readonly(
            "vertices", [](const Solution& s) { return as_rows(s.surface->vertices); }, "At rest: (n, 3).")
        .def_property_readonly("triangles", [](const Solution& s) { return as_integers(s.surface->triangles); })
        .def_property_readonly(
            "displacement", [](const Solution& s) { return as_rows(s.displacement); }, "(n, 3).")
        .def_readonly("reactions", &Solution::reactions, "Of the fixed part, then of each handle.")
        .def_readonly("loads", &Solution::loads, "Total force and moment of gravity and of each load.")
        .def_property_readonly(
            "values",
            [](const Solution& s) {
                return as_vectors(
                    Eigen::VectorXd(s.values.head(s.values.size() - std::ssize(s.deformer->set().loads))));
            },
            "What `deformer` is given: displacements of its handles, (k, 3).")
        .def_property_readonly(
            "factors",
            [](const Solution& s) {
                return as_numbers(Eigen::VectorXd(s.values.tail(std::ssize(s.deformer->set().loads))));
            },
            "What `deformer` is given: factors of its loads, (n_loads,).")
        .def_readonly("compliance", &Solution::compliance,
                      "Work of the loads on the displacements [force * length]; None without loads.")
        .def_readonly("linear_theory_error", &Solution::linear_theory_error,
                      "How far linear theory is off for this motion; None where that is not known.")
        .def_readonly("fixed_reactions", &Solution::fixed_reactions, "Of each fixed set.")
        .def_property_readonly("force_imbalance", [](const Solution& s) { return s.imbalance.force; })
        .def_property_readonly("moment_imbalance", [](const Solution& s) { return s.imbalance.moment; })
        .def_readonly("error_estimate", &Solution::error_estimate,
                      "Of the displacement of the worst vertex, over the largest; None where there is none.")
        .def_readonly("force_error_estimate", &Solution::force_error_estimate)
        .def_readonly("residual", &Solution::residual)
        .def_readonly("condition_estimate", &Solution::condition_estimate, "1 where it is not estimated.")
        .def_property_readonly(
            "iterations", [](const Solution& s) { return of_equilibrium(s, &EquilibriumFacts::iterations); },
            "Of Newton's method; None but for nonlinear FEM, as for the next two.")
        .def_property_readonly(
            "energy", [](const Solution& s) { return of_equilibrium(s, &EquilibriumFacts::energy); },
            "That of the strains [force * length].")
        .def_property_readonly(
            "largest_stretch", [](const Solution& s) { return of_equilibrium(s, &EquilibriumFacts::largest_stretch); },
            "Length over length at rest, at most.")
        .def_property_readonly("warnings", [](const Solution& s) { return s.warnings(); })
        .def_property_readonly("seconds", &stage_seconds, "Of each stage.")
        .def_property_readonly("model", [](const Solution& s) { return std::const_pointer_cast<Model>(s.model); })
        .def_property_readonly(
            "deformer", [](const Solution& s) { return std::const_pointer_cast<Deformer>(s.deformer); },
            "Of the surface that was simulated.")
        .def_property_readonly(
            "proxy", [](const Solution& s) { return std::const_pointer_cast<Proxy>(s.proxy); },
            "What was simulated in place of the surface, or None.")
        .def("fields", &fields_of, "'displacement', 'von_mises', 'traction' and 'stress' at the vertices.")
        .def("save", &save, py::arg("file"), py::kw_only(), py::arg("deformed") = false,
             py::arg("progress") = py::none(),
             "Writes the deformed mesh (.obj, .stl, .ply), files for ParaView at rest (.vtp, .vtu; deformed=True: "
             "moved), "
             "a table (.csv), a figure to be pulled in a browser (.html), or glTF with morph targets (.glb).")
        .def("__repr__", [](const Solution& s) {
            return "<elastolab.Solution of '" + s.mesh_name + "': " + std::string(name(s.model->method().kind)) + ">";
        });
}

}  // namespace

void bind_scenes(py::module_& module) {
    bind_reaction(module);
    bind_solution(module);
    module.def("_normal_text", &normal_text, py::arg("text"), py::arg("name"));
    module.def("_save_text", &save_text, py::arg("text"), py::arg("name"), py::arg("file"));
    module.def("_solve_text", &solve_scene, py::arg("text"), py::arg("file"), py::arg("method"), py::arg("mode"),
               py::arg("tractions"), py::arg("update"), py::arg("elements"), py::arg("rims"), py::arg("checks"),
               py::arg("progress"));
}

}  // namespace elastolab::python
