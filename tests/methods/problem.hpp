#pragma once

#include <cstdio>
#include <Eigen/Core>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "deform/deformer.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"

namespace elastolab::test {

/// What lies this near to a face of a body of size 1 lies on it.
inline constexpr double kEdge = 1e-9;

inline Method make_method(MethodKind kind, Tractions tractions = Tractions::discontinuous, Mode mode = Mode::on_demand,
                          Update update = Update::reduced) {
    return {.kind = kind, .mode = mode, .tractions = tractions, .update = update};
}

/// All linear methods that have this mode and this update, linear BEM under each of its traction models.
inline std::vector<Method> method_variants(Mode mode = Mode::on_demand, Update update = Update::reduced) {
    std::vector<Method> methods;
    for (const MethodKind kind : all_methods()) {
        if (!kind->linear || !has(kind, mode) || !has(kind, update)) continue;
        methods.push_back(make_method(kind, Tractions::discontinuous, mode, update));
        if (!kind->chooses_tractions) continue;
        methods.push_back(make_method(kind, Tractions::restricted, mode, update));
        methods.push_back(make_method(kind, Tractions::continuous, mode, update));
    }
    return methods;
}

/// Prints a measured figure among the lines of the test run, for people and for docs/results.md.
inline void print_measured(const std::string& what, double value) {
    std::printf("[ measured ] %s: %.3g\n", what.c_str(), value);
}

inline std::string describe(const Method& method) {
    return std::string(name(method.kind)) + " " + std::string(name(method.tractions)) + " " +
           std::string(name(method.mode)) + " " + std::string(name(method.update));
}

inline Body make_body(SurfaceMesh surface, const Material& material = {1.0, 0.3}) {
    return {"body", std::make_shared<const SurfaceMesh>(std::move(surface)), material};
}

inline std::shared_ptr<const Model> precomputed(const Body& body, const Method& method) {
    Control control;
    return precompute(body, method, control);
}

/// Displacements of all vertices for one set and its values.
inline Eigen::VectorXd displaced(std::shared_ptr<const Model> model, const ConstrainedSet& set,
                                 const Eigen::VectorXd& values) {
    Control control;
    Deformer deformer(std::move(model));
    deformer.constrain(set, control);
    return deformer.displace(values);
}

/// The values of a whole field (3*n_vertices) at some vertices.
inline Eigen::VectorXd at(const Eigen::VectorXd& field, const std::vector<int>& vertices) {
    Eigen::VectorXd values(3 * std::ssize(vertices));
    for (std::size_t i = 0; i < vertices.size(); ++i)
        values.segment<3>(3 * static_cast<Eigen::Index>(i)) = field.segment<3>(3 * vertices[i]);
    return values;
}

template <class Predicate>
std::vector<int> vertices_where(const SurfaceMesh& mesh, Predicate&& predicate) {
    std::vector<int> vertices;
    for (int v = 0; v < mesh.n_vertices(); ++v)
        if (predicate(Eigen::Vector3d(mesh.vertices.col(v)))) vertices.push_back(v);
    return vertices;
}

template <class Field>
Eigen::VectorXd exact_displacements(const SurfaceMesh& mesh, const Field& field) {
    Eigen::VectorXd u(3 * mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v) u.segment<3>(3 * v) = field.displacement(mesh.vertices.col(v));
    return u;
}

}  // namespace elastolab::test
