#include "python/models.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "findings/cost.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "methods/choices.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "python/arrays.hpp"
#include "python/deformers.hpp"
#include "python/method_words.hpp"
#include "python/surfaces.hpp"
#include "python/watch.hpp"

namespace elastolab::python {

namespace {

using ModelPointer = std::shared_ptr<Model>;

template <class Each>
std::string listed(const Each& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

template <class Value, class Parse, class All>
void choose(Value& value, const char* what, const std::string& word, const Parse& parse, const All& all) {
    if (word.empty()) return;
    const auto found = parse(word);
    if (!found)
        throw py::value_error(std::string(what) + " '" + one_line(word) + "' is unknown. Use one of: " + listed(all) +
                              ".");
    value = *found;
}

template <class All>
std::vector<std::string_view> names_of(const All& all) {
    std::vector<std::string_view> names;
    for (const auto one : all) names.push_back(name(one));
    return names;
}

Body body_of(const Surface& surface, const Material& material, const Method& method) {
    require_material(material);
    require_usable(surface.report, surface.name, method.kind->has_inside);
    if (const std::string why = refusal(method, material.poisson_ratio); !why.empty()) throw py::value_error(why);
    return {.name = surface.name, .surface = surface.mesh, .material = material};
}

/// Throws where the person has made errors of warnings.
void warn_of_choices(const ChoicesForSome& given, MethodKind kind) {
    for (const std::string& text : words(choices_left_aside(given, kind, "")))
        if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

ModelPointer precompute_model(const Surface& surface, const Material& material, const std::string& method,
                              const std::string& mode, const std::string& tractions, const std::string& update,
                              const std::string& elements, int rims, const py::object& progress) {
    const Method chosen = method_of(method, mode, tractions, update, elements, rims);
    const Body body = body_of(surface, material, chosen);
    warn_of_choices({!tractions.empty(), !elements.empty(), rims > 0}, chosen.kind);
    return watched(progress,
                   [&](Control& control) { return std::const_pointer_cast<Model>(precompute(body, chosen, control)); });
}

ModelPointer changed(const Model& before, const std::optional<Material>& material, const std::string& method,
                     const std::string& mode, const std::string& tractions, const std::string& update,
                     const std::string& elements, std::optional<int> rims, const py::object& progress) {
    const Method& old = before.method();
    const auto word = [](const std::string& given, std::string_view kept) {
        return given.empty() ? std::string(kept) : given;
    };
    const Method chosen =
        method_of(word(method, name(old.kind)), word(mode, name(old.mode)), word(tractions, name(old.tractions)),
                  word(update, name(old.update)), word(elements, name(old.elements)), rims.value_or(old.rims));
    const Material other = material.value_or(before.body().material);
    require_material(other);
    if (const std::string why = refusal(chosen, other.poisson_ratio); !why.empty()) throw py::value_error(why);
    warn_of_choices({!tractions.empty(), !elements.empty(), rims.value_or(0) > 0}, chosen.kind);
    return watched(progress, [&](Control& control) {
        return std::const_pointer_cast<Model>(precompute_again(before, other, chosen, control));
    });
}

py::dict seconds_of(const Model& model) {
    py::dict seconds;
    for (const auto& [stage, time] : model.facts().stages) seconds[py::str(stage)] = time;
    return seconds;
}

py::dict matrices_of(const Model& model) {
    std::vector<std::pair<std::string, Eigen::MatrixXd>> copies = watched(py::none(), [&](Control& control) {
        std::vector<std::pair<std::string, Eigen::MatrixXd>> all;
        model.visit_matrices([&](const NamedMatrix& m) {
            control.checkpoint();
            all.emplace_back(m.name, m.values);
        });
        return all;
    });
    py::dict matrices;
    for (auto& [name, values] : copies) matrices[py::str(name)] = as_matrix(std::move(values));
    return matrices;
}

/// In compressed columns: (values, rows, ends, shape), what scipy.sparse.csc_matrix takes.
py::dict stiffness_of(const Model& model) {
    const std::vector<std::pair<std::string, SparseStiffness>> copies = watched(py::none(), [&](Control& control) {
        std::vector<std::pair<std::string, SparseStiffness>> all;
        model.visit_sparse_stiffness([&](const std::string& name, const SparseStiffness& given) {
            control.checkpoint();
            all.emplace_back(name, given);
            all.back().second.makeCompressed();
        });
        return all;
    });
    py::dict matrices;
    for (const auto& [name, K] : copies) {
        const auto integers = [](const int* data, Eigen::Index n) {
            return as_integers(std::vector<int>(data, data + n));
        };
        matrices[py::str(name)] =
            py::make_tuple(as_numbers(Eigen::Map<const Eigen::VectorXd>(K.valuePtr(), K.nonZeros())),
                           integers(K.innerIndexPtr(), K.nonZeros()), integers(K.outerIndexPtr(), K.cols() + 1),
                           py::make_tuple(K.rows(), K.cols()));
    }
    return matrices;
}

void bind_material(py::module_& module) {
    py::class_<Material>(module, "Material",
                         "Linear-elastic and isotropic: Young's modulus [force / length^2] > 0, Poisson's ratio in "
                         "(-1, 1/2].")
        .def(py::init([](double young_modulus, double poisson_ratio) {
                 const Material material{young_modulus, poisson_ratio};
                 require_material(material);
                 return material;
             }),
             py::arg("young_modulus") = Material{}.young_modulus, py::arg("poisson_ratio") = Material{}.poisson_ratio)
        .def_readonly("young_modulus", &Material::young_modulus)
        .def_readonly("poisson_ratio", &Material::poisson_ratio)
        .def_property_readonly("shear_modulus", &Material::shear_modulus)
        .def("__eq__",
             [](const Material& a, const py::object& other) {
                 if (!py::isinstance<Material>(other)) return false;
                 const auto& b = other.cast<const Material&>();
                 return a.young_modulus == b.young_modulus && a.poisson_ratio == b.poisson_ratio;
             })
        .def("__hash__", [](const Material& m) { return py::hash(py::make_tuple(m.young_modulus, m.poisson_ratio)); })
        .def("__repr__", [](const Material& m) {
            return "elastolab.Material(young_modulus=" + py::repr(py::float_(m.young_modulus)).cast<std::string>() +
                   ", poisson_ratio=" + py::repr(py::float_(m.poisson_ratio)).cast<std::string>() + ")";
        });
}

py::dict describe(const MethodTraits& traits) {
    py::dict row;
    row["name"] = traits.name;
    row["label"] = traits.label;
    row["modes"] = names_of(traits.modes);
    row["updates"] = names_of(traits.updates);
    row["tractions"] = traits.chooses_tractions ? names_of(kAllTractions) : std::vector<std::string_view>{};
    row["elements"] = traits.chooses_elements ? names_of(kAllElements) : std::vector<std::string_view>{};
    row["chooses_rims"] = traits.chooses_rims;
    row["linear"] = traits.linear;
    row["has_inside"] = traits.has_inside;
    row["takes_incompressible"] = traits.takes_incompressible;
    return row;
}

py::list all_described() {
    py::list rows;
    for (const MethodKind kind : all_methods()) rows.append(describe(*kind));
    return rows;
}

py::dict predicted(const Surface& surface, const std::string& method, const std::string& mode) {
    const Method chosen = method_of(method, mode, "", "", "", 0);
    constexpr double kAnyMaterial = 0.3;  // costs do not depend on it
    if (const std::string why = refusal(chosen, kAnyMaterial); !why.empty()) throw py::value_error(why);
    require_usable(surface.report, surface.name, chosen.kind->has_inside);
    const Cost cost = predict_cost(*surface.mesh, chosen);
    py::dict row;
    row["degrees_of_freedom"] = cost.degrees_of_freedom;
    row["memory_bytes"] = cost.memory_bytes;
    row["seconds"] = cost.seconds();
    return row;
}

/// The name of a choice, or nothing where a method has none.
template <class Choice>
std::optional<std::string> named_if(bool chooses, Choice choice) {
    return chooses ? std::optional<std::string>(name(choice)) : std::nullopt;
}

void bind_model(py::module_& module) {
    py::class_<Model, ModelPointer>(module, "Model",
                                    "A body that is ready to be constrained: what `precompute` returns. Immutable; any "
                                    "thread may use it.")
        .def_property_readonly(
            "vertices", [](const Model& m) { return as_rows(m.body().surface->vertices); }, "At rest: (n, 3).")
        .def_property_readonly("triangles", [](const Model& m) { return as_integers(m.body().surface->triangles); })
        .def_property_readonly("material", [](const Model& m) { return m.body().material; })
        .def_property_readonly("method", [](const Model& m) { return name(m.method().kind); })
        .def_property_readonly("mode", [](const Model& m) { return name(m.method().mode); })
        .def_property_readonly(
            "tractions",
            [](const Model& m) { return named_if(m.method().kind->chooses_tractions, m.method().tractions); },
            "None where the method has no choice of them.")
        .def_property_readonly("update", [](const Model& m) { return name(m.method().update); })
        .def_property_readonly(
            "elements", [](const Model& m) { return named_if(m.method().kind->chooses_elements, m.method().elements); },
            "None where the method has no choice of them.")
        .def_property_readonly("rims", [](const Model& m) { return m.method().rims; })
        .def_property_readonly("n_vertices", [](const Model& m) { return m.facts().n_vertices; })
        .def_property_readonly("n_tetrahedra", [](const Model& m) { return m.facts().n_tetrahedra; })
        .def_property_readonly("degrees_of_freedom", [](const Model& m) { return m.facts().n_degrees_of_freedom; })
        .def_property_readonly("memory_bytes", [](const Model& m) { return m.facts().memory_bytes; })
        .def_property_readonly(
            "condition_estimate", [](const Model& m) { return m.facts().condition_estimate; },
            "Of the matrix that is inverted; 0 where nothing is.")
        .def_property_readonly("seconds", &seconds_of, "Of each stage of the precomputation.")
        .def_property_readonly("warnings", [](const Model& m) { return words(findings_of_model(m)); })
        .def("matrices", &matrices_of, "The dense matrices that the mode keeps, by name ('H', 'G', 'K', 'Kinv' ...).")
        .def("stiffness", &stiffness_of,
             "The sparse stiffness over all nodes, by name: (values, rows, ends, shape) for scipy.sparse.csc_matrix.")
        .def("constrain", &constrained, py::arg("fixed") = py::none(), py::arg("handles") = py::none(), py::kw_only(),
             py::arg("loads") = py::none(), py::arg("progress") = py::none(),
             R"(A Deformer for these vertices.

fixed    numbers of vertices that stay at rest
handles  numbers of vertices whose displacements are prescribed
loads    what acts besides: a list of Loads

A number may occur only once.)")
        .def("again", &changed, py::arg("material") = std::nullopt, py::kw_only(), py::arg("method") = "",
             py::arg("mode") = "", py::arg("tractions") = "", py::arg("update") = "", py::arg("elements") = "",
             py::arg("rims") = py::none(), py::arg("progress") = py::none(),
             "The same body with another material or method; takes over what does not change.")
        .def("__repr__", [](const Model& m) {
            return "<elastolab.Model of '" + m.body().name + "': " + std::string(name(m.method().kind)) + ", " +
                   std::to_string(m.facts().n_degrees_of_freedom) + " degrees of freedom>";
        });
}

}  // namespace

Method method_of(const std::string& method, const std::string& mode, const std::string& tractions,
                 const std::string& update, const std::string& elements, int rims) {
    Method chosen;
    chosen.kind = default_method();
    choose(
        chosen.kind, "method", method, [](const std::string& w) { return parse_method_kind(w); }, method_names());
    choose(
        chosen.mode, "mode", mode, [](const std::string& w) { return parse_mode(w); }, names_of(kAllModes));
    choose(
        chosen.tractions, "tractions", tractions, [](const std::string& w) { return parse_tractions(w); },
        names_of(kAllTractions));
    choose(
        chosen.update, "update", update, [](const std::string& w) { return parse_update(w); }, names_of(kAllUpdates));
    choose(
        chosen.elements, "elements", elements, [](const std::string& w) { return parse_elements(w); },
        names_of(kAllElements));
    if (rims < 0 || rims > kMostRims)
        throw py::value_error("rims: must be 0 to " + std::to_string(kMostRims) +
                              ", rows of thin triangles along the rims.");
    if (chosen.kind->chooses_rims) chosen.rims = rims;
    return chosen;
}

void require_material(const Material& material) {
    if (!(material.young_modulus > 0.0) || !std::isnormal(material.young_modulus))
        throw py::value_error(
            "young_modulus: must be positive and finite, and not below 2.3e-308. Give a force per length squared, such "
            "as 1e5.");
    if (!(material.poisson_ratio > -1.0 && material.poisson_ratio <= 0.5))
        throw py::value_error("poisson_ratio: must lie above -1 and not above 0.5. Give a number such as 0.3.");
}

void bind_models(py::module_& module) {
    bind_material(module);
    bind_model(module);
    module.def("methods", &all_described,
               "Every method that there is, with what it offers: name, label, modes, updates, tractions ...");
    module.def("predict", &predicted, py::arg("surface"), py::arg("method") = "", py::arg("mode") = "",
               "What a precomputation would take: degrees_of_freedom, memory_bytes, seconds.");
    module.def("precompute", &precompute_model, py::arg("surface"), py::arg("material") = Material{}, py::kw_only(),
               py::arg("method") = "", py::arg("mode") = "", py::arg("tractions") = "", py::arg("update") = "",
               py::arg("elements") = "", py::arg("rims") = 0, py::arg("progress") = py::none(),
               R"(Makes a Model of a body; milliseconds to minutes, Ctrl-C ends it.

surface   without fatal defects
method    'fem', 'constant-bem', 'linear-bem', 'galerkin-bem', 'quadratic-fem' ... (see methods())
mode      'on-demand', 'full' or 'full-volume';  tractions  'discontinuous', 'restricted' or 'continuous'
update    'direct', 'eqn9' or 'reduced'
elements  of 'nonlinear-fem': 'quadratic' or 'linear'
rims      of 'galerkin-bem': rows of thin triangles along the rims of constrained patches, 0 to 3
progress  called with a stage and a fraction; what it raises ends the precomputation)");
}

}  // namespace elastolab::python
