#include "python/deformers.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "base/column_sum.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "deform/surface_stress.hpp"
#include "findings/solution.hpp"
#include "findings/words.hpp"
#include "python/arrays.hpp"
#include "python/loads.hpp"
#include "python/watch.hpp"

namespace elastolab::python {

namespace {

using DeformerPointer = std::shared_ptr<Deformer>;

Eigen::Index n_handles(const Deformer& deformer) { return std::ssize(deformer.set().handles); }
Eigen::Index n_vertices(const Deformer& deformer) { return deformer.model().facts().n_vertices; }

void require_different(const std::vector<int>& fixed, const std::vector<int>& handles, int n_vertices) {
    std::vector<char> seen(static_cast<std::size_t>(n_vertices), 0);
    for (const std::vector<int>* list : {&fixed, &handles})
        for (const int v : *list)
            if (std::exchange(seen[static_cast<std::size_t>(v)], 1) != 0)
                throw py::value_error("vertex " + std::to_string(v) + " is constrained twice. Give each number once.");
}

/// Of each load how many times it acts; None: once.
Eigen::VectorXd factors_of(const Deformer& deformer, const py::object& factors) {
    const Eigen::Index n = std::ssize(deformer.set().loads);
    return factors.is_none() ? Eigen::VectorXd(Eigen::VectorXd::Ones(n)) : numbers(factors, "factors", n);
}

/// A load on a triangle that does not move by itself means nothing.
void require_free(const ConstrainedSet& set, const SurfaceMesh& surface) {
    std::vector<char> is_constrained(static_cast<std::size_t>(surface.n_vertices()), 0);
    for (const std::vector<int>* list : {&set.fixed, &set.handles})
        for (const int v : *list) is_constrained[static_cast<std::size_t>(v)] = 1;
    for (const UnitLoad& load : set.loads)
        for (const int t : load.triangles)
            if ((surface.triangles.col(t).array().unaryExpr(
                     [&](int v) { return int{is_constrained[static_cast<std::size_t>(v)]}; }) == 1)
                    .all())
                throw py::value_error("loads: all vertices of triangle " + std::to_string(t) +
                                      " are constrained. Load triangles that are free to move.");
}

Eigen::VectorXd values_of(const Deformer& deformer, const py::object& values, const py::object& factors) {
    Eigen::VectorXd all(deformer.set().n_values());
    all << vectors(values, "values", n_handles(deformer)), factors_of(deformer, factors);
    return all;
}

/// The same for many values; loads act once in each, or (for motions) not at all.
Eigen::MatrixXd all_values_of(const Deformer& deformer, const py::object& values, const std::string& name,
                              double load) {
    const Eigen::MatrixXd motions = many_vectors(values, name, n_handles(deformer));
    Eigen::MatrixXd all = Eigen::MatrixXd::Constant(deformer.set().n_values(), motions.cols(), load);
    all.topRows(motions.rows()) = motions;
    return all;
}

/// On a worker where it may take long.
Eigen::VectorXd displaced(const Deformer& deformer, const Eigen::VectorXd& values) {
    if (!deformer.iterates() && deformer.linear()) {
        const WithoutLock others;
        return deformer.displace(values);
    }
    return watched(py::none(), [&](Control& control) { return deformer.displace(values, control); });
}

py::array copied(const Eigen::VectorXd& u, const py::object& out) {
    py::array_t<double> array = output(out, {u.size() / 3, 3});
    std::memcpy(array.mutable_data(), u.data(), sizeof(double) * static_cast<std::size_t>(u.size()));
    return array;
}

py::array displace(const Deformer& deformer, const py::object& values, const py::object& out,
                   const py::object& factors) {
    const Eigen::VectorXd given = values_of(deformer, values, factors);
    if (!out.is_none()) output(out, {n_vertices(deformer), 3});
    Eigen::VectorXd u = displaced(deformer, given);
    return out.is_none() ? as_vectors(std::move(u)) : copied(u, out);
}

py::array displace_all(const Deformer& deformer, const py::object& values, const py::object& progress) {
    const Eigen::MatrixXd given = all_values_of(deformer, values, "values", 1.0);
    return as_many_vectors(watched(progress, [&](Control& control) { return deformer.displace_all(given, control); }));
}

std::shared_ptr<DragResponse> drag_response(const Deformer& deformer, const py::object& values, const py::object& basis,
                                            const py::object& factors, const py::object& progress) {
    const Eigen::VectorXd given = values_of(deformer, values, factors);
    const Eigen::MatrixXd motions = all_values_of(deformer, basis, "basis", 0.0);
    return watched(progress, [&](Control& control) {
        return std::make_shared<DragResponse>(deformer.drag_response(given, motions, control));
    });
}

/// A capacitance system and its reactions may take as long as a solve: on a worker.
Deformer::Answer answer(const Deformer& deformer, const py::object& values, const py::object& factors,
                        const py::object& progress) {
    const Eigen::VectorXd given = values_of(deformer, values, factors);
    return watched(progress, [&](Control& control) { return deformer.answer(given, {}, control); });
}

std::vector<int> constrained_vertices(const Deformer& deformer) {
    std::vector<int> all = deformer.set().fixed;
    all.insert(all.end(), deformer.set().handles.begin(), deformer.set().handles.end());
    return all;
}

py::dict surface_fields(const Deformer& deformer, const py::object& values, const py::object& factors,
                        const py::object& progress) {
    const Deformer::Answer a = answer(deformer, values, factors, progress);
    const Body& body = deformer.model().body();
    const Eigen::VectorXd load_factors = factors_of(deformer, factors);
    Eigen::Matrix3Xd tractions;
    Eigen::MatrixXd stress;
    Eigen::VectorXd von_mises;
    {
        const WithoutLock others;
        tractions = vertex_tractions(*body.surface, constrained_vertices(deformer), a.reactions.forces);
        stress = surface_stress(*body.surface, body.material, a.displacements, tractions, !deformer.linear(),
                                load_tractions(*body.surface, deformer.set().loads, load_factors,
                                               deformer.linear() ? Eigen::VectorXd() : a.displacements));
        von_mises.resize(stress.cols());
        for (Eigen::Index v = 0; v < stress.cols(); ++v)
            von_mises[v] = measure(StressMeasure::von_mises, stress_tensor(stress.col(v)));
    }
    py::dict fields;
    fields["displacement"] = as_vectors(Eigen::VectorXd(a.displacements));
    fields["von_mises"] = as_numbers(std::move(von_mises));
    fields["traction"] = as_rows(tractions);
    fields["stress"] = as_rows(stress);
    return fields;
}

py::tuple inside(const Deformer& deformer, const py::object& values, const py::object& places,
                 const py::object& factors, const py::object& progress) {
    const Eigen::VectorXd given = values_of(deformer, values, factors);
    const Positions at = points(places, "points");
    const InteriorValues found = watched(progress, [&](Control& control) {
        const auto field = deformer.interior_field(given, control);
        control.begin_stage("inside");
        return field->at(at, control);
    });
    return py::make_tuple(as_vectors(Eigen::VectorXd(found.displacements.col(0))),
                          as_rows(found.stresses.reshaped(6, at.cols())));
}

struct NamedReactions {
    std::vector<int> vertices;
    Reactions reactions;
};

NamedReactions reactions(const Deformer& deformer, const py::object& values, const py::object& factors,
                         const py::object& progress) {
    return {constrained_vertices(deformer), answer(deformer, values, factors, progress).reactions};
}

double residual(const Deformer& deformer, const py::object& values, const py::object& factors,
                const py::object& progress) {
    const Eigen::VectorXd given = values_of(deformer, values, factors);
    return watched(progress, [&](Control& control) { return deformer.residual(given, control); });
}

std::optional<DiscretisationCheck> error_estimate(const Deformer& deformer, const py::object& values,
                                                  const py::object& factors, const py::object& progress) {
    const Eigen::VectorXd given = values_of(deformer, values, factors);
    return watched(progress, [&](Control& control) { return deformer.discretisation_check(given, control); });
}

/// What a frame costs. Small bodies: without giving the lock away, which costs as much.
py::array drag(const DragResponse& response, const py::object& parameters, const py::object& out) {
    constexpr Eigen::Index kManyNumbers = 100'000;
    const Eigen::VectorXd given = numbers(parameters, "parameters", response.X.cols());
    py::array_t<double> array = output(out, {response.rest.size() / 3, 3});
    Eigen::VectorXd u;
    if (response.X.size() < kManyNumbers) {
        response.displace(given, u);
    } else {
        const WithoutLock others;
        response.displace(given, u);
    }
    std::memcpy(array.mutable_data(), u.data(), sizeof(double) * static_cast<std::size_t>(u.size()));
    return array;
}

/// Seconds that a frame takes without Python, the least of several rounds: for scripts/measure_python.py.
double frame_seconds(const DragResponse& response) {
    constexpr int kRounds = 20, kFrames = 1000;
    Eigen::VectorXd u, parameters = Eigen::VectorXd::Constant(response.X.cols(), 0.1);
    double least = std::numeric_limits<double>::max();
    for (int round = 0; round < kRounds; ++round) {
        const Stopwatch timer;
        for (int i = 0; i < kFrames; ++i) {
            parameters[0] += 1e-6;
            response.displace(parameters, u);
        }
        least = std::min(least, timer.seconds() / kFrames);
    }
    return least;
}

void bind_answers(py::module_& module) {
    py::class_<NamedReactions>(module, "Reactions", "What the supports exert on the body.")
        .def_property_readonly(
            "vertices", [](const NamedReactions& r) { return as_integers(r.vertices); },
            "Constrained vertices, fixed ones first: (k,).")
        .def_property_readonly(
            "forces", [](const NamedReactions& r) { return as_rows(r.reactions.forces); }, "(k, 3) [force].")
        .def_property_readonly(
            "moments", [](const NamedReactions& r) { return as_rows(r.reactions.moments); },
            "About the origin: (k, 3) [force * length].");
    py::class_<DiscretisationCheck>(module, "ErrorEstimate", "How far an answer may be off because the mesh is coarse.")
        .def_readonly("displacement", &DiscretisationCheck::relative_error,
                      "Of the worst vertex, over the largest displacement.")
        .def_readonly("vertex", &DiscretisationCheck::vertex, "The worst.")
        .def_readonly("force", &DiscretisationCheck::relative_force_error,
                      "Of the reactions of the worst patch; nan where the body may still move.")
        .def("__repr__", [](const DiscretisationCheck& c) {
            return "<elastolab.ErrorEstimate: displacement " + std::to_string(c.relative_error) + ", force " +
                   std::to_string(c.relative_force_error) + ">";
        });
    py::class_<DragResponse, std::shared_ptr<DragResponse>>(
        module, "DragResponse", "Displacements as an affine function of a few parameters: rest + parameters @ columns.")
        .def_property_readonly(
            "rest", [](const DragResponse& r) { return as_vectors(Eigen::VectorXd(r.rest)); },
            "Displacements where all parameters are zero: (n, 3).")
        .def_property_readonly(
            "columns", [](const DragResponse& r) { return as_many_vectors(Eigen::MatrixXd(r.X)); },
            "Displacements for each parameter: (k, n, 3).")
        .def("displace", &drag, py::arg("parameters"), py::arg("out") = py::none(),
             "Displacements for k parameters: (n, 3), into `out` if it is given; microseconds.")
        .def("_frame_seconds", &frame_seconds);
}

void bind_deformer(py::module_& module) {
    py::class_<Deformer, DeformerPointer>(
        module, "Deformer",
        R"(A body with some of its vertices constrained: what `Model.constrain` returns.

`values` are the displacements of the handles' vertices: (k, 3) in their order, or (3,) for all. `factors` say how many
times each of the loads acts, (n_loads,): once, unless they are given. Any thread may use it.)")
        .def_property_readonly("fixed", [](const Deformer& d) { return as_integers(d.set().fixed); })
        .def_property_readonly("handles", [](const Deformer& d) { return as_integers(d.set().handles); })
        .def_property_readonly("n_vertices", &n_vertices)
        .def_property_readonly("n_loads", [](const Deformer& d) { return d.set().loads.size(); })
        .def_property_readonly(
            "held", [](const Deformer& d) { return d.quality().held && !constrained_vertices(d).empty(); },
            "False: the body is free to move, and the smallest motion is taken.")
        .def_property_readonly(
            "condition_estimate", [](const Deformer& d) { return d.quality().condition_estimate; },
            "Of the set's matrix; 1 where it is not estimated.")
        .def_property_readonly("warnings", [](const Deformer& d) { return words(findings_of_set(d)); })
        .def("displace", &displace, py::arg("values"), py::arg("out") = py::none(), py::kw_only(),
             py::arg("factors") = py::none(), "Displacements of all vertices: (n, 3), into `out` if it is given.")
        .def("displace_all", &displace_all, py::arg("values"), py::kw_only(), py::arg("progress") = py::none(),
             "The same for many values at once: (m, k, 3) to (m, n, 3).")
        .def("drag_response", &drag_response, py::arg("values"), py::arg("basis"), py::kw_only(),
             py::arg("factors") = py::none(), py::arg("progress") = py::none(),
             R"(Displacements as a function of a few parameters, from `values` on. By nonlinear FEM that is
its tangent there, right for small parameters only.

basis  (m, k, 3): how the handles' vertices move for each of m parameters)")
        .def("reactions", &reactions, py::arg("values"), py::kw_only(), py::arg("factors") = py::none(),
             py::arg("progress") = py::none(), "Forces and moments at the constrained vertices.")
        .def("residual", &residual, py::arg("values"), py::kw_only(), py::arg("factors") = py::none(),
             py::arg("progress") = py::none(),
             "Relative residual of the full system: rounding, unless the answer is wrong.")
        .def("error_estimate", &error_estimate, py::arg("values"), py::kw_only(), py::arg("factors") = py::none(),
             py::arg("progress") = py::none(),
             "How far the answer may be off because the mesh is coarse; None where the method cannot tell.")
        .def("surface_fields", &surface_fields, py::arg("values"), py::kw_only(), py::arg("factors") = py::none(),
             py::arg("progress") = py::none(),
             R"(Fields at the vertices: 'displacement' (n, 3), 'von_mises' (n,), 'traction' (n, 3), and 'stress' (n, 6)
in the order xx yy zz xy yz xz [force / length^2].)")
        .def("inside", &inside, py::arg("values"), py::arg("points"), py::kw_only(), py::arg("factors") = py::none(),
             py::arg("progress") = py::none(),
             R"(Displacements (m, 3) and stresses (m, 6), in the order xx yy zz xy yz xz, at points inside the body,
(m, 3). Farther outside than by rounding they mean nothing.)");
}

}  // namespace

DeformerPointer constrained(const std::shared_ptr<Model>& model, const py::object& fixed, const py::object& handles,
                            const py::object& loads, const py::object& progress) {
    const int n = model->facts().n_vertices;
    const auto list = [n](const py::object& object, const char* name) {
        return object.is_none() ? std::vector<int>() : vertex_list(object, name, n);
    };
    ConstrainedSet set{
        .fixed = list(fixed, "fixed"), .handles = list(handles, "handles"), .loads = loads_of(loads, *model)};
    require_different(set.fixed, set.handles, n);
    require_free(set, *model->body().surface);
    return watched(progress, [&](Control& control) {
        auto deformer = std::make_shared<Deformer>(model);
        deformer->constrain(std::move(set), control);
        return deformer;
    });
}

void bind_deformers(py::module_& module) {
    bind_answers(module);
    bind_deformer(module);
}

}  // namespace elastolab::python
